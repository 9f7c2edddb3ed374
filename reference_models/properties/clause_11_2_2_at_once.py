"""Properties about operations of containers that overlap, which a vendor may declare to be possible (operations-at-once).

The text does not say in which order they take effect, so what is compared is what all orders have in common.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Call, Enter, Event, Raise, Return
from ucm_cts.reference_models.conclusions import Conclusions
from ucm_cts.reference_models.model.designation import designation, error_name
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.properties.declaration import Property, property_at

_UNIQUE, _LISTED = "R-11.2.2.1-03", "R-11.2.2.1-14"
_CALLBACKS: dict[s.Hook, tuple[str, str]] = {
    "on_init": ("add_component", "R-11.2.3-05"),
    "on_remove": ("remove_component", "R-11.2.1.2-06"),
    "on_connect": ("connect", "R-11.2.1.3-02"),
    "on_disconnect": ("disconnect", "R-11.2.1.3-05"),
}
"""By callback: the operation that brings one, and the requirement that says so."""

_CONFIGURE = (s.AddComponent, s.RemoveComponent, s.Connect, s.Disconnect)


@dataclass(frozen=True)
class _Done:
    """A configuring operation: its ``step``, and the events that begin and end it; no end if it has none."""

    step: s.Step
    begin: Call
    end: Return | Raise | None


@dataclass
class _Observed:
    """What a trace of overlapping operations holds.

    ``done``: the operations that change the configuration; ``listings``: get_components, after all of them.
    ``callbacks``: how often bodies were entered, by hook.
    """

    done: list[_Done] = field(default_factory=list)
    listings: list[tuple[s.GetComponents, Return]] = field(default_factory=list)
    callbacks: Counter[str] = field(default_factory=Counter)


@property_at("overlapped", _LISTED, _UNIQUE, *(requirement for _, requirement in _CALLBACKS.values()))
def operations_at_once(check: Property, runtime: ObservedRuntime, trace: Sequence[Event]) -> Conclusions:
    """Components are added, connected and removed at once as if it were done one by one: nothing is lost or done twice."""
    if runtime.ics.reading("container-operations") != "at-once":
        return
    seen = _observe(runtime.scenario, trace)
    refused = min((event.n for event in trace if isinstance(event, Raise)), default=math.inf)
    begun = [runtime.scenario.steps[event.step] for event in trace if isinstance(event, Call) and event.n < refused]
    if not _succeed_in_any_order(runtime.scenario, begun):
        return  # some operations overlap because another one takes long
    if any(done.end is None for done in seen.done):
        return  # what hangs is reported by the host
    yield from _refused(check, seen)
    if any(isinstance(done.end, Raise) for done in seen.done):
        return
    yield from _identified(check, seen)
    yield from _listed(check, seen)
    for hook, (operation, requirement) in _CALLBACKS.items():
        wanted = sum(s.operation(done.step) == operation for done in seen.done)
        if hook in ("on_connect", "on_disconnect") and not seen.callbacks[hook]:
            continue  # bodies that are not Connectable
        if wanted and seen.callbacks[hook] == wanted:
            yield check.kept(requirement)
        elif wanted:
            yield check.fail(
                f"{hook} at once",
                expected=f"{wanted} {hook} by so many {operation} at once",
                observed=f"there were {seen.callbacks[hook]}",
                at=tuple(d.begin.n for d in seen.done if s.operation(d.step) == operation)[:2],
                requirement=requirement,
            )


def _succeed_in_any_order(scenario: s.Scenario, steps: Sequence[s.Step]) -> bool:
    """Do ``steps`` only add, connect and remove plain components, and none twice or of another thread, so that each succeeds
    whatever the other threads do?
    """
    actions = (action for one in scenario.components.values() for plan in one.plan.values() for action in plan)
    if scenario.interfaces or not all(isinstance(action, s.HoldAtGate) for action in actions):
        return False
    world = _World(scenario.components)
    return all(world.take(step) for step in steps)


@dataclass
class _World:
    """What the steps so far have made, each with the thread that made it.

    ``added``: the components; ``used``: those that steps have looked up, or connected.
    ``references``, ``links``: what port elements and connections were bound to; ``connected``: the port elements that are connected.
    """

    declared: Mapping[str, s.Declaration]
    homes: set[str] = field(default_factory=lambda: {s.MANAGER})
    added: dict[str, tuple[s.Declaration, str | None]] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    references: dict[str, str | None] = field(default_factory=dict)
    links: dict[str, tuple[tuple[str, str], str | None]] = field(default_factory=dict)
    connected: set[tuple[str, str]] = field(default_factory=set)

    def take(self, step: s.Step) -> bool:
        """Does ``step`` succeed, whatever other threads do? It is done then."""
        if not isinstance(step, s.AddComponent | s.RemoveComponent | s.GetPortElement | s.Connect | s.Disconnect):
            return isinstance(step, s.GetComponents) or self._is_new_home(step)
        if step.container not in self.homes:
            return False
        match step:
            case s.AddComponent():
                name, declaration = step.bind or step.component, self.declared.get(step.component)
                if declaration is None or name in self.added or step.attributes:
                    return False
                self.added[name] = declaration, step.thread
            case s.RemoveComponent():
                return step.id not in self.used and self._declaration(step.id, step.thread, removes=True) is not None
            case s.GetPortElement():
                declaration = self._declaration(step.id, step.thread)
                if declaration is None or step.port not in declaration.provides or step.bind in self.references:
                    return False
                self.references[step.bind] = step.thread
            case s.Connect():
                declaration, end = self._declaration(step.id, step.thread), (step.id, step.port)
                is_known = step.to in self.references and self.references[step.to] in (None, step.thread)
                if declaration is None or step.port not in declaration.requires or not is_known:
                    return False
                if step.bind in self.links or end in self.connected:
                    return False
                self.links[step.bind] = end, step.thread
                self.connected.add(end)
            case s.Disconnect():
                end, thread = self.links.get(step.connection, (("", ""), None))
                if end not in self.connected or thread != step.thread:
                    return False
                self.connected.remove(end)
        return True

    def _is_new_home(self, step: s.Step) -> bool:
        if not isinstance(step, s.CreateContainer) or step.bind in self.homes or step.thread is not None:
            return False
        self.homes.add(step.bind)
        return True

    def _declaration(self, name: str, thread: str | None, removes: bool = False) -> s.Declaration | None:
        """The component ``name``, if it is certainly there when ``thread`` asks; it is gone afterwards if that ``removes`` it."""
        declaration, maker = self.added.get(name, (None, None))
        if declaration is None or maker not in (None, thread):
            return None
        if removes:
            del self.added[name]
        else:
            self.used.add(name)
        return declaration


def _observe(scenario: s.Scenario, trace: Sequence[Event]) -> _Observed:
    begun = {event.step: event for event in trace if isinstance(event, Call)}
    ended = {event.step: event for event in trace if isinstance(event, Return | Raise)}
    seen = _Observed(callbacks=Counter(event.hook for event in trace if isinstance(event, Enter)))
    for number, begin in begun.items():
        if isinstance(scenario.steps[number], _CONFIGURE):
            seen.done.append(_Done(scenario.steps[number], begin, ended.get(number)))
    last = max((done.end.n for done in seen.done if done.end is not None), default=0)
    for number, begin in begun.items():
        step, end = scenario.steps[number], ended.get(number)
        if isinstance(step, s.GetComponents) and isinstance(end, Return) and begin.n > last:
            seen.listings.append((step, end))
    return seen


def _refused(check: Property, seen: _Observed) -> Conclusions:
    for done in seen.done:
        if isinstance(done.end, Raise):
            hook = next(hook for hook, (operation, _) in _CALLBACKS.items() if operation == s.operation(done.step))
            yield check.refused(
                designation(done.step),
                done.end,
                expected=f"{s.operation(done.step)} succeeds beside others, as declared",
                cause=f"{error_name(done.end.error)} at once",
                requirement=_CALLBACKS[hook][1],
            )
            return


def _identified(check: Property, seen: _Observed) -> Conclusions:
    """Numbers of components that nobody removes are given once."""
    removed = {done.step.id for done in seen.done if isinstance(done.step, s.RemoveComponent)}
    given = [
        (done.step.container, done.end.value, done.end.n)
        for done in seen.done
        if isinstance(done.step, s.AddComponent) and isinstance(done.end, Return)
        if (done.step.bind or done.step.component) not in removed
    ]
    twice = [one for one in given if sum(other[:2] == one[:2] for other in given) > 1]
    if twice:
        yield check.fail(
            "the same id at once",
            expected="each add_component returns an id of its own",
            observed=f"{len(twice)} of {len(given)} that were added at once have ids of others, such as {twice[0][1]}",
            at=tuple(n for _, _, n in twice[:2]),
            requirement=_UNIQUE,
        )
    elif given:
        yield check.kept(_UNIQUE)


def _listed(check: Property, seen: _Observed) -> Conclusions:
    for step, end in seen.listings:
        wanted = sorted(_members(seen, step.container))
        listed = sorted(end.value) if isinstance(end.value, tuple) else []
        if listed == wanted:
            yield check.kept(_LISTED)
            continue
        yield check.fail(
            "lost at once",
            expected=f"get_components lists the {len(wanted)} components that were added and not removed",
            observed=f"it lists {len(listed)}, {len(set(listed) & set(wanted))} of them",
            event=end,
            requirement=_LISTED,
        )


def _members(seen: _Observed, container: str) -> Iterator[int]:
    """The ids of what was added to ``container`` and never removed."""
    removed = {done.step.id for done in seen.done if isinstance(done.step, s.RemoveComponent)}
    for done in seen.done:
        step, end = done.step, done.end
        if not isinstance(step, s.AddComponent) or step.container != container or not isinstance(end, Return):
            continue
        if (step.bind or step.component) not in removed and isinstance(end.value, int):
            yield end.value
