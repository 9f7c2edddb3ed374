"""Properties about operations of containers that overlap, which a vendor may declare to be possible (operations-at-once).

The text does not say in which order they take effect, so what is compared is what all orders have in common.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Call, Enter, Event, Raise, Return
from ucm_cts.reference_models.conclusions import Conclusions
from ucm_cts.reference_models.model.designation import designation, error_name
from ucm_cts.reference_models.model.independent_steps import succeed_in_any_order
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
    if not succeed_in_any_order(runtime.scenario, begun):
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
