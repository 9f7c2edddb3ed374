"""An operation of Container or ContainerManager: in progress, and how it ended (11.2.2, 12.10)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ucm_cts.adapters.contract.scenario import Hook, Step
from ucm_cts.adapters.contract.trace import Enter, Raise, Return
from ucm_cts.reference_models.model.changing import Changing
from ucm_cts.reference_models.model.designation import designation
from ucm_cts.reference_models.model.expected_callbacks import Deviation, Fit
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.model.runtime import Connection, Container, Member

DECLARED_ERRORS: dict[str, tuple[str, ...]] = {
    "add_component": ("UCM_ERROR",),
    "remove_component": ("NOT_FOUND", "UCM_ERROR"),
    "get_port_element": ("NOT_FOUND", "UCM_ERROR"),
    "connect": ("NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR"),
    "disconnect": ("NOT_FOUND", "UCM_ERROR"),
    "start": ("UCM_ERROR",),
    "stop": ("UCM_ERROR",),
    "get_components": ("UCM_ERROR",),
    "create_container": ("UCM_ERROR",),
    "remove_container": ("NOT_FOUND", "UCM_ERROR"),
    "destroy": ("UCM_ERROR",),
}
"""The exceptions that 12.10 declares for each operation."""


Result = Return | Raise

Fitted = tuple[Member | None, Row, Fit]
"""The instance that a row stands for, None if it does not exist, or not yet; and how its callbacks fit the row."""


class Deviating(NamedTuple):
    """An instance received callbacks that its row does not permit.

    ``member``: the instance; None where the row is about one that does not exist, or not yet.
    ``who``: the name of its body, for findings.
    ``events``: the life-cycle callbacks it received.
    """

    member: Member | None
    row: Row
    who: str
    events: list[Enter]
    deviation: Deviation


class Intrusion(NamedTuple):
    """A ``member`` that the operation does not concern received the callbacks ``events``, which breaks ``requirement``."""

    member: Member
    events: list[Enter]
    requirement: str
    elsewhere: bool


class OperationEnd(Changing):
    """How the end of an operation and its callbacks fit the life-cycle table.

    ``answer``: ``return`` or the error.
    ``permitting``: the rows that permit the answer, up to the one that does not.
    ``forbidding``: the role that does not permit the answer, with the answers it permits.
    ``permitted``: whether the operation was judged and every row permits the answer.
    ``initialised``: the on_init of bodies that add_component has made, and whether it was the ``right_body``.
    ``intrusions``: instances that were not concerned and received callbacks.
    ``others_undisturbed``: whether an instance of another container was not concerned and received nothing.
    ``reached_own``: whether a start or stop of the manager reached its own members; None if it had none to reach.
    ``not_reached``: the manager's own members if it reached none of them.
    ``fitted``, ``deviating``: how it went for each role; both empty if that cannot be judged.
    ``is_plain``: whether there is nothing to say about callbacks but how they fit.
    ``has_choices``: whether one of ``fitted`` is permitted under some readings only.
    """

    answer: str
    permitting: Sequence[Row] = ()
    forbidding: tuple[Member | None, Row, frozenset[str]] | None = None
    permitted: bool = False
    initialised: Sequence[Enter] = ()
    right_body: bool = False
    intrusions: Sequence[Intrusion] = ()
    others_undisturbed: bool = False
    reached_own: bool = False
    not_reached: Sequence[Member] = ()
    fitted: Sequence[Fitted] = ()
    deviating: Sequence[Deviating] = ()
    is_plain: bool = True
    has_choices: bool = False

    def is_unknown(self, member: Member) -> bool:
        """Is the state of ``member`` not known, or not any more because of what it received?"""
        return (
            member.suspended
            or member in self.not_reached
            or any(intrusion.member is member for intrusion in self.intrusions)
            or any(role.member is member for role in self.deviating)
        )


class OperationInProgress(Changing):
    """One operation of Container or ContainerManager, from call to return.

    ``step_number``, ``step``: of the scenario.
    ``call``: the ``n`` of the call event.
    ``roles``: each instance concerned with the row of the life-cycle table that stands for it (the instance is None where
    the row is about one that does not exist).
    ``judged``: False where the model cannot predict.
    ``is_after_removal``: its container, or the runtime, has been removed: the text says nothing about it.
    ``forgiving``: it may end in UCM_ERROR for a reason that the rows do not show; None while nobody has looked at other containers
    for one (``is_forgiving``).
    ``open_options``: those whose reading it does not show; with an exception only, those in ``open_if_refused``.
    ``lost``: the state that it leaves is not known.
    ``callbacks``: the entries meanwhile, with their ``hooks``, and the same ``by_body``.
    ``inside``: those of ``callbacks`` that have not been left.
    ``created``: the bodies made meanwhile.
    ``subject``, ``connection``: the instance or connection that the step designates.
    ``end``: the event that ended it; ``outcome``: how it ended. Neither is there before.
    """

    step_number: int
    step: Step
    operation: str
    container: Container
    call: int = 0
    roles: list[tuple[Member | None, Row]] = []
    judged: bool = True
    is_after_removal: bool = False
    forgiving: bool | None = False
    open_options: tuple[str, ...] = ()
    open_if_refused: tuple[str, ...] = ()
    lost: bool = False
    callbacks: list[Enter] = []
    hooks: set[Hook] = set()
    by_body: dict[tuple[str, int], list[Enter]] = {}
    inside: list[Enter] = []
    created: list[tuple[str, int]] = []
    subject: Member | None = None
    connection: Connection | None = None
    end: Result = None  # type: ignore[assignment]
    outcome: OperationEnd = None  # type: ignore[assignment]

    @property
    def what(self) -> str:
        """The operation and what it is applied to, as findings name it."""
        return designation(self.step)

    def unclear_if(self, condition: bool) -> None:
        """The model cannot predict it if ``condition`` holds."""
        if condition:
            self.judged = False

    def leave(self, body: tuple[str, int], hook: Hook) -> None:
        """A body was left that had been entered while the operation was in progress."""
        inside = self.inside
        if len(inside) == 1:  # the common case
            if inside[0].hook == hook and inside[0].body == body:
                inside.clear()
        elif inside:
            self.inside = [callback for callback in inside if callback.hook != hook or callback.body != body]

    def add(self, callback: Enter, body: tuple[str, int]) -> None:
        """A ``body`` was entered while the operation was in progress."""
        self.callbacks.append(callback)
        self.inside.append(callback)
        self.hooks.add(callback.hook)
        known = self.by_body.get(body)
        if known is None:
            self.by_body[body] = [callback]
        else:
            known.append(callback)

    def received(self, member: Member, hook: Hook) -> list[Enter]:
        """The ``hook`` callbacks that the body of ``member`` received meanwhile."""
        if hook not in self.hooks or member.body not in self.by_body:
            return []
        return [c for c in self.by_body[member.body] if c.hook == hook]

    def not_undone(self, member: Member) -> tuple[str, ...]:
        """The ports of ``member`` whose connections stood, and whose end on_disconnect has not reported so far."""
        left = [*member.not_undone] or [connection.port for connection in member.live_connections()]
        for callback in self.received(member, "on_disconnect") if member.declaration.connectable else ():
            if left:
                left.remove(callback.port if callback.port in left else left[0])  # a wrong name is another matter
        return tuple(left) if member.declaration.connectable and not member.declaration.fragment else ()

    def not_shut_down(self, member: Member) -> bool:
        """Was ``member`` operational, and has not received on_shutdown so far?"""
        was_operational = member.not_shut_down or (member.operational and not member.suspended)
        return was_operational and member.phase == "on_startup"


Ongoing = OperationInProgress | None
"""The operation in progress, if there is one."""
