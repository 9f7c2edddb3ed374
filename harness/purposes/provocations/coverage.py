"""Which provocations a trace really shows: bodies that acted in a callback, by the operation that led there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import Hook, Scenario, Step, operation
from ucm_cts.harness.purposes.provocations.dimensions import NamedAction, load_dimensions

CALLED = "a call"
"""Stands for the operation where a body is entered by a business call or by its container on its own account."""

_OF_METHODS = {"call": ("call_method",), "return": ("answer",)}

_BUSINESS = frozenset(("exchange", "method", "run"))


class Provocation(NamedTuple):
    """A body was in callback ``hook``, which ``by`` led into, and did ``action`` (its tag in plans) there."""

    hook: str
    by: str
    action: str

    @property
    def name(self) -> str:
        """As reports count it."""
        return f"{self.hook} by {self.by}: {self.action}"


def provocations(scenario: Scenario, trace: Iterable[t.Event]) -> Iterator[Provocation]:
    """Each entry of a body in which it was to act, once for each kind of action."""
    planned = {
        (component, hook): dict.fromkeys(str(action.__struct_config__.tag) for action in actions)
        for component, declaration in scenario.components.items()
        for hook, actions in declaration.plan.items()
        if actions
    }
    if not planned:
        return
    ongoing: dict[int, Step] = {}
    for event in trace:
        if type(event) is t.Enter:
            for action in planned.get((event.component, event.hook), ()):
                yield Provocation(event.hook, _leading(event.hook, ongoing.values()), action)
        elif type(event) is t.Call:
            ongoing[event.step] = scenario.steps[event.step]
        elif type(event) is t.Return or type(event) is t.Raise:
            ongoing.pop(event.step, None)


@dataclass(frozen=True)
class ProvocationRow:
    """A callback and an operation that leads there, with the cells of all actions.

    ``cells``: of each action its name, how often it was seen, and why it cannot be, empty if it can.
    """

    hook: str
    by: str
    cells: tuple[tuple[str, int, str], ...]


def rows(counted: Mapping[str, int]) -> tuple[ProvocationRow, ...]:
    """All callbacks, operations and actions of the suite's dimensions, with what a run has ``counted`` of each."""
    dimensions = load_dimensions()
    entrances = dict.fromkeys(
        (e.hook, CALLED if e.hook in _BUSINESS else e.by, e.by) for e in dimensions.entrances if e.hook
    )
    own = tuple(
        ProvocationRow(
            hook,
            by,
            tuple(
                (
                    action.name,
                    counted.get(Provocation(hook, by, action.tag).name, 0),
                    dimensions.why_never(hook, step, action.name),
                )
                for action in dimensions.actions
            ),
        )
        for hook, by, step in entrances
    )
    others = (
        ProvocationRow(
            other.hook,
            CALLED,
            tuple(
                (
                    action.name,
                    sum(counted.get(Provocation(other.hook, CALLED, tag).name, 0) for tag in _tags(action)),
                    other.empty.get(action.name, other.reason),
                )
                for action in dimensions.actions
            ),
        )
        for other in dimensions.elsewhere
    )
    return (*own, *(row for row in others if _is_provoked(row)))


def _is_provoked(row: ProvocationRow) -> bool:
    """Has the run scenarios for ``row``, or a reason why there are none? Profile container has neither run nor methods."""
    return any(times for _, times, _ in row.cells) or all(reason for _, _, reason in row.cells)


def _tags(action: NamedAction) -> tuple[str, ...]:
    """The action as plans spell it, also where it is about a method."""
    return (action.tag, *_OF_METHODS.get(action.tag, ()))


def _leading(hook: Hook, ongoing: Iterable[Step]) -> str:
    """The operation of the container that is in progress; there is one at a time."""
    if hook in _BUSINESS:
        return CALLED
    operations = [operation(step) for step in ongoing]
    return next((name for name in operations if name not in ("invoke", "stress")), CALLED)
