"""Before an operation: which row of the life-cycle table stands for each instance concerned (11.2.3, 12.10)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.reference_models.model.execution_policies import (
    has_second_active,
    has_unknown_policy,
    is_contradictory,
    is_plainest,
    may_refuse_values,
)
from ucm_cts.reference_models.model.executions import without_policy
from ucm_cts.reference_models.model.expected_callbacks import Listener, listener
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, State
from ucm_cts.reference_models.model.links import differ, is_misfit
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.runtime import Connection, Container, Member, has_meaningless_values, raises
from ucm_cts.reference_models.model.service_policies import has_second_timers, has_several_clocks

_FAILING_END: tuple[s.Hook, ...] = ("on_shutdown", "on_disconnect", "on_remove")

_OF_THE_MANAGER = frozenset(("create_container", "remove_container", "destroy"))


class MissingRow(Exception):
    """The life-cycle table has no row for a situation: an error of this suite, never of a framework."""


class RowSelection:
    """Looks up rows for each operation. Holds the table; all state lives in the ``ObservedRuntime``."""

    def __init__(self, table: LifeCycleTable) -> None:
        self._rows = {(r.state, r.operation, r.condition): r for r in table.rows}
        self._select: dict[str, Callable[[ObservedRuntime, OperationInProgress, Any], None]] = {
            "add_component": self._add,
            "remove_component": self._remove,
            "get_port_element": self._get_port_element,
            "connect": self._connect,
            "disconnect": self._disconnect,
            "start": self._start,
            "stop": self._stop,
            "get_components": lambda runtime, ongoing, step: self._role(ongoing, None, "absent", ""),
            "create_container": self._create_container,
            "remove_container": self._remove_container,
            "destroy": self._destroy,
        }

    def open(self, runtime: ObservedRuntime, number: int, step: s.ContainerCall, call: int = 0) -> OperationInProgress:
        """The operation of scenario step ``number``, with the rows that apply; ``call`` is the event that begins it."""
        operation = s.operation(step)
        name = s.MANAGER if operation in _OF_THE_MANAGER else step.container  # type: ignore[union-attr]
        container = runtime.containers.get(name) or Container(name, removed=True)
        ongoing = OperationInProgress(number, step, operation, container, call)
        ongoing.is_after_removal = runtime.destroyed or (container.removed and operation != "remove_container")
        if ongoing.is_after_removal or container.doubtful:
            ongoing.judged = False
            return ongoing
        self._select[operation](runtime, ongoing, step)
        if ongoing.subject is not None and ongoing.subject.container is not container:
            ongoing.judged = False
        if len(runtime.containers) > 1 and not ongoing.forgiving:
            ongoing.forgiving = None
        for member, _ in ongoing.roles:
            if member is not None and member.suspended:
                ongoing.judged = False
                break
        return ongoing

    def _role(
        self, ongoing: OperationInProgress, member: Member | None, state: State, condition: str, operation: str = ""
    ) -> None:
        key = (state, operation or ongoing.operation, condition)
        row = self._rows.get(key)
        if row is None:
            raise MissingRow("/".join(key))
        ongoing.roles.append((member, row))

    def _member_role(self, ongoing: OperationInProgress, member: Member, condition: str, operation: str = "") -> None:
        self._role(ongoing, member, member.state, condition, operation)

    def _add(self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.AddComponent) -> None:
        declaration = runtime.scenario.components.get(step.component)
        container = ongoing.container
        late = container.started is not False
        if declaration is None:
            condition = "unknown implementation"
            ongoing.judged = container.started is not None
        elif raises(declaration, "on_init"):
            condition = "on_init fails, container started" if late else "on_init fails"
        else:
            needs = "ports" if declaration.requires else "nothing"
            beside = ", beside the other kind" if container.present.has_other_kind(declaration.fragment) else ""
            condition = f"container started, requires {needs}" if late else f"requires {needs}{beside}"
        unforeseen: tuple[s.Hook, ...] = (
            ("set_container_interface", "on_startup") if late else ("set_container_interface",)
        )
        ongoing.unclear_if(container.started is None or (declaration is not None and raises(declaration, *unforeseen)))
        if declaration is not None and declaration.policies:
            ongoing.unclear_if(
                is_contradictory(declaration) or has_several_clocks(declaration) or has_unknown_policy(declaration)
            )
        if declaration is not None and not is_plainest(declaration, runtime.knows_policies, runtime.ics):
            ongoing.forgiving = (
                True  # whether it may be refused is the matter of policy_supported and execution_policy_given
            )
        if declaration is not None and has_meaningless_values(declaration, step):
            ongoing.forgiving = True
        self._role(ongoing, None, "absent", condition)

    def _remove(self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.RemoveComponent) -> None:
        member, why = runtime.find_member(ongoing.container, step.id)
        ongoing.subject = member
        if member is None:
            self._role(ongoing, None, "absent", why + _late(ongoing))
            return
        clients = runtime.clients_of([member])
        failing = member.raises(*_FAILING_END)
        attached = bool(runtime.interactions.links_of(member))
        if member.state == "ready":
            ongoing.judged = not failing
            self._member_role(ongoing, member, "")
        elif failing:
            ongoing.judged = (
                not (clients or attached) and not member.live_connections() and not member.raises("on_shutdown")
            )
            self._member_role(ongoing, member, "on_remove fails" if ongoing.judged else "not connected")
        elif attached:
            self._member_role(ongoing, member, "attached")
        elif clients:
            self._member_role(ongoing, member, "provider in use")
        else:
            self._member_role(ongoing, member, "connected" if member.live_connections() else "not connected")
        concerned = (*member.connections, *runtime.remembered.leading_to([member]))
        ongoing.unclear_if(any(c.live is None or c.ambiguous for c in concerned))
        for client, _ in clients:
            self._member_role(ongoing, client, "attached" if attached else "", "remove_provider")
            ongoing.unclear_if(_raises_when_disconnected(client))

    def _get_port_element(self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.GetPortElement) -> None:
        member, why = runtime.find_member(ongoing.container, step.id)
        ongoing.subject = member
        if member is None:
            self._role(ongoing, None, "absent", why)
        elif step.port in member.declaration.provides:
            self._member_role(ongoing, member, "provided")
        else:
            self._member_role(
                ongoing, member, "required" if step.port in member.declaration.requires else "unknown name"
            )

    def _connect(self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.Connect) -> None:
        member, why = runtime.find_member(ongoing.container, step.id)
        ongoing.subject = member
        _, provider = runtime.reference(step.to)
        unusable = step.to == s.NIL or (provider is not None and provider.gone)
        if member is None:
            self._role(ongoing, None, "absent", why + _late(ongoing))
            ongoing.judged = not unusable  # two things are wrong, and it is open which is reported
            return
        wrong = ""
        if step.port not in member.declaration.requires:
            wrong = "provided name" if step.port in member.declaration.provides else "unknown name"
        elif step.to == s.NIL:
            wrong = "null reference"
        late = ongoing.container.started is not False
        if member.state == "ready":
            self._member_role(ongoing, member, "wrong argument" if wrong else "")
        elif wrong:
            ongoing.judged = not late and provider is not member
            self._member_role(ongoing, member, wrong)
        elif late:
            ongoing.judged = ongoing.container.started is not None
            self._member_role(ongoing, member, "container started")
        else:
            self._member_role(ongoing, member, self._kind_of_connection(member, step, provider))
        ongoing.unclear_if(
            member.raises("on_connect", "on_disconnect") or (late and member.raises("on_startup", "on_shutdown"))
        )
        ongoing.unclear_if(
            provider is not None and provider.gone and ongoing.roles[-1][1].condition != "provider already removed"
        )
        ongoing.unclear_if(provider is not None and provider.doubtful)
        provided = runtime.ports.get(step.to, "")
        ongoing.unclear_if(provider is not None and differ(member, step.port, provider, provided))
        is_second_to_itself = provider is member and bool(member.live_connections(step.port))
        if is_second_to_itself and runtime.ics.permits("self-connection", "refuse"):
            ongoing.open_if_refused = ("second-connect",)

    def _kind_of_connection(self, member: Member, step: s.Connect, provider: Member | None) -> str:
        if member.live_connections(step.port):
            return "already connected"
        if provider is member:
            alone = len(member.declaration.requires) == 1
            return "provider is itself" if alone else "provider is itself, one of several ports"
        if provider is not None and provider.gone:
            return "provider already removed"
        missing = [p for p in member.declaration.requires if not member.live_connections(p)]
        if len(missing) > 1:
            return "one of several ports"
        if provider is not None and provider.container is not member.container:
            return "provider in another container"
        if provider is not None and provider.declaration.fragment:
            return "provider is a fragment"
        if step.port in member.once_connected:
            return "last port, again"
        return "last port" if member.declaration.connectable else "last port, not Connectable"

    def _disconnect(self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.Disconnect) -> None:
        connection, why = runtime.find_connection(ongoing.container, step.connection)
        if connection is None:
            self._role(ongoing, None, "absent", why + _late(ongoing))
            return
        ongoing.connection = connection
        member = ongoing.subject = connection.client
        if member.gone:  # it is open whether its connection was left
            ongoing.judged = False
            return
        ongoing.unclear_if(_raises_when_disconnected(member) or connection.live is None or connection.ambiguous)
        if member.state == "ready":
            condition = ""
        elif ongoing.container.started is not False:
            condition = "container started"
            ongoing.judged = ongoing.judged and ongoing.container.started is not None
        elif member.state == "configured" and len(member.live_connections(connection.port)) > 1:
            condition = "another connection remains"
        else:
            condition = ""
        self._member_role(ongoing, member, condition)

    def _start(self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.Start) -> None:
        container = ongoing.container
        cascades = container.name == s.MANAGER
        members = container.live_members()
        started = container.started
        reached = [m for c in runtime.containers.values() for m in c.live_members()] if cascades else members
        connections = (c for m in reached for c in m.connections if c.live is not False)
        if runtime.interactions.improper(None if cascades else container) or any(map(is_misfit, connections)):
            ongoing.forgiving = True
        elif without_policy(runtime, container):
            ongoing.forgiving = True  # whether it may be refused is execution_policy_given's matter
        elif any(_may_be_refused(runtime, m.declaration) for m in members):
            ongoing.forgiving = True  # properties about policies judge whether it may be
        ongoing.unclear_if(started is None or any(m.suspended for m in members))
        if not members:
            self._role(ongoing, None, "absent", "no members, already started" if started else "no members")
        unready = {m for m in members if m.state == "initialized"}
        if unready and runtime.ics.reading("start-unconfigured") == "refuse":
            # a connector may count as what a client is connected to, also while that has no server
            ongoing.open_options = ("start-unconfigured",) if all(_is_attached(runtime, m) for m in unready) else ()
        failing = {m for m in members if m.raises("on_startup")}
        ongoing.unclear_if(any(not m.operational for m in failing) if started else bool(unready and failing))
        for member in members:
            if started is not False:
                condition = "already started" if member.operational else "added later"
            elif member.operational:
                ongoing.judged = False
                condition = "already started"
            elif unready:
                condition = "unconfigured" if member in unready else "a peer is unconfigured"
            elif failing:
                condition = "on_startup fails" if member in failing else "a peer's on_startup fails"
            elif member.startups:
                condition = "all configured, again"
            elif any(connection.live is False for connection in member.connections):
                condition = "all configured after reconnecting"
            else:
                condition = "all configured"
            self._member_role(ongoing, member, condition)
        self._reach_below(runtime, ongoing)

    def _stop(self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.Stop) -> None:
        container = ongoing.container
        members = container.live_members()
        ongoing.unclear_if(container.started is None or any(m.suspended for m in members))
        if not members:
            self._role(ongoing, None, "absent", "no members")
        failing = [m for m in members if m.raises("on_shutdown") and m.operational]
        for member in members:
            if not member.operational:
                self._member_role(ongoing, member, "not started")
            elif failing:
                alone = failing == [member]  # of several that fail, each may be the first, and the last reported
                self._member_role(ongoing, member, "on_shutdown fails" if alone else "a peer's on_shutdown fails")
            else:
                self._member_role(ongoing, member, "")
        self._reach_below(runtime, ongoing)

    def _reach_below(self, runtime: ObservedRuntime, ongoing: OperationInProgress) -> None:
        """The manager's start and stop may reach into sub-containers, and fail for what they find there."""
        if ongoing.container.name != s.MANAGER:
            return
        for container in runtime.containers.values():
            if container is ongoing.container or container.removed:
                continue
            if container.started is not False and not container.live_members():
                # an empty container may be reached, which nobody sees
                ongoing.open_options = (*ongoing.open_options, "stop-when-stopped")
            for member in container.live_members():
                if member.suspended:
                    ongoing.forgiving = True
                    continue
                self._member_role(ongoing, member, "the manager's")
                if member.state != "configured" or member.raises("on_startup", "on_shutdown"):
                    ongoing.forgiving = True

    def _create_container(
        self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.CreateContainer
    ) -> None:
        started = ongoing.container.started
        ongoing.forgiving = (
            ongoing.forgiving or started is None
        )  # then it is open whether the manager counts as started
        condition = "manager started" if started else "first" if len(runtime.containers) == 1 else "another"
        self._role(ongoing, None, "absent", condition)

    def _destroy(self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.Destroy) -> None:
        self._removal_of_all(ongoing, [m for c in runtime.containers.values() for m in c.live_members()])

    def _remove_container(
        self, runtime: ObservedRuntime, ongoing: OperationInProgress, step: s.RemoveContainer
    ) -> None:
        if step.container == s.NIL:
            self._role(ongoing, None, "absent", "null reference")
            return
        container = runtime.containers.get(step.container)
        if container is None or container.name == s.MANAGER or container.doubtful:
            ongoing.judged = False
            return
        if container.removed:
            self._role(ongoing, None, "absent", "already removed")
            return
        ongoing.container = container
        members = container.live_members()
        clients = [client for client, _ in runtime.clients_of(members) if client.container is not container]
        in_use = bool(clients) or any(map(runtime.interactions.is_used_elsewhere, members))
        self._removal_of_all(ongoing, members, "in use elsewhere" if in_use else "")
        ongoing.unclear_if(any(c.live is None for c in runtime.remembered.leading_to(members)))
        for client in clients:
            self._member_role(ongoing, client, "with its container", "remove_provider")
            ongoing.unclear_if(_raises_when_disconnected(client))

    def _removal_of_all(self, ongoing: OperationInProgress, members: Sequence[Member], condition: str = "") -> None:
        if not members:
            self._role(ongoing, None, "absent", "no members")
        for member in members:
            self._member_role(ongoing, member, condition)
            ongoing.unclear_if(member.raises(*_FAILING_END) or any(c.live is None for c in member.connections))


def _may_be_refused(runtime: ObservedRuntime, declaration: s.Declaration) -> bool:
    """May a container that has such a component not start?"""
    may = may_refuse_values(declaration, runtime.ics) or has_second_timers(declaration)
    return may or (has_second_active(declaration) and runtime.ics.permits("second-active-policy", "refuse"))


def _is_attached(runtime: ObservedRuntime, member: Member) -> bool:
    """Is each required port element of ``member`` connected, to another component or to a connector?"""
    ends = [e for k in runtime.interactions.links.values() for e in k.ends if e.member is member and e.until is None]
    attached = {end.port for end in ends}
    return all(port in attached or member.live_connections(port) for port in member.declaration.requires)


def _late(ongoing: OperationInProgress) -> str:
    return ", container started" if ongoing.container.started is not False else ""


def _raises_when_disconnected(member: Member) -> bool:
    return member.raises("on_disconnect") or (member.operational and member.raises("on_shutdown"))


def undone_by(ongoing: OperationInProgress, member: Member) -> list[Connection]:
    """The connections of ``member`` that the operation undoes if it succeeds."""
    if ongoing.connection is not None:
        return [ongoing.connection]
    live = member.live_connections()
    if ongoing.operation in ("remove_component", "remove_container") and member is not ongoing.subject:
        removed = [ongoing.subject] if ongoing.operation == "remove_component" else ongoing.container.live_members()
        if member not in removed:
            gone = {id(m) for m in removed if m is not None}
            return [c for c in live if c.leads_to(gone)]
    return live


def listener_of(ongoing: OperationInProgress, member: Member | None) -> Listener:
    """The listener that stands for ``member`` in the operation; without interfaces if it is None."""
    if member is None:
        return listener(False, False, 0)
    undone = len(undone_by(ongoing, member)) if member.connections else 0
    return listener(member.declaration.connectable, member.declaration.fragment, undone)
