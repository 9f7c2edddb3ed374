"""Dimensions of ``suite/provocations.yaml``, and the cells of their product that have scenarios."""

from __future__ import annotations

import functools
from collections.abc import Sequence

from ucm_cts.adapters.contract.scenario import Action, ContainerCall, Hook
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE

COVERING = SUITE / "provocations_covering.json"
"""The cells that have scenarios, by entrance and action: aftermath, place, position and kind of each. ``covering`` makes it."""


class Entrance(Value, frozen=True):
    """A way into a body, or an operation that is refused and enters none.

    ``by``: the operation that leads there; of a refusal what is refused, in words.
    ``after``: what the application has been through before.
    ``exercises``: ids of requirements.
    ``hook``: the callback; None of a refusal.
    ``step``: the step that is refused; its container is that of the application.
    """

    by: str
    after: str
    exercises: tuple[str, ...]
    hook: Hook | None = None
    step: ContainerCall | None = None

    @property
    def name(self) -> str:
        """For ids of purposes and scenarios."""
        return f"{self.hook} by {self.by} after {self.after}" if self.hook else f"{self.by} after {self.after}"


class Refusal(Value, frozen=True):
    """An operation that is refused: ``name`` in words, ``step``, and the ``exercises`` of each of the pasts in ``after``."""

    name: str
    step: ContainerCall
    exercises: tuple[str, ...]
    after: tuple[str, ...]


class NamedAction(Value, frozen=True):
    """What a body does: ``name`` in words, ``plan`` as hosts read it."""

    name: str
    plan: tuple[Action, ...]

    @property
    def tag(self) -> str:
        """The action as plans spell it."""
        return str(self.plan[0].__struct_config__.tag)


NOTHING = NamedAction("nothing", ())
"""What a body does while an operation is refused that does not enter it."""


class Excluded(Value, frozen=True):
    """Cells that stay empty: those in which each dimension that is named here has one of these values; and the ``reason``."""

    reason: str
    hooks: tuple[Hook, ...] = ()
    by: tuple[str, ...] = ()
    actions: tuple[str, ...] = ()
    aftermaths: tuple[str, ...] = ()
    places: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()

    def holds(self, cell: Cell) -> bool:
        """Does it exclude ``cell``?"""
        return (
            self.holds_at(cell.entrance)
            and _is_one_of(cell.action.name, self.actions)
            and _is_one_of(cell.aftermath, self.aftermaths)
            and _is_one_of(cell.place, self.places)
            and _is_one_of(cell.kind, self.kinds)
        )

    def holds_always(self, hook: Hook, by: str, action: str) -> bool:
        """Does it exclude this, whatever the other dimensions are?"""
        others = (*self.aftermaths, *self.places, *self.kinds)
        named = _is_one_of(hook, self.hooks) and _is_one_of(by, self.by) and _is_one_of(action, self.actions)
        return named and not others

    def holds_at(self, entrance: Entrance) -> bool:
        """Does it exclude cells of ``entrance``?"""
        return _is_one_of(entrance.hook, self.hooks) and _is_one_of(entrance.by, self.by)


class Elsewhere(Value, frozen=True):
    """An entrance whose scenarios are in other tables: ``hook``, or another operation of bodies; why actions, by name, are ``empty``; and
    the ``reason`` if all are.
    """

    hook: str
    empty: dict[str, str] = {}
    reason: str = ""


def _is_one_of(value: str | None, values: Sequence[str]) -> bool:
    """No values mean any value."""
    return not values or value in values


class Cell(Value, frozen=True):
    """One value of each dimension."""

    entrance: Entrance
    action: NamedAction
    aftermath: str
    place: str
    position: str
    kind: str

    @property
    def name(self) -> str:
        """For ids of scenarios."""
        return f"{self.kind}, {self.position}, {self.place}, then {self.aftermath}"


class Dimensions(Value, frozen=True):
    """``suite/provocations.yaml``; that file says what the fields are."""

    entrances: tuple[Entrance, ...]
    refusals: tuple[Refusal, ...]
    actions: tuple[NamedAction, ...]
    aftermaths: tuple[str, ...]
    places: tuple[str, ...]
    positions: tuple[str, ...]
    kinds: tuple[str, ...]
    excluded: tuple[Excluded, ...]
    elsewhere: tuple[Elsewhere, ...]

    def entrances_and_refusals(self) -> dict[str, Entrance]:
        """All that a cell may begin with, by name."""
        refusals = (Entrance(r.name, past, r.exercises, step=r.step) for r in self.refusals for past in r.after)
        return {entrance.name: entrance for entrance in (*self.entrances, *refusals)}

    def why_empty(self, cell: Cell) -> str:
        """The reason why there is no scenario for ``cell``; empty if there may be one."""
        return next((excluded.reason for excluded in self.excluded if excluded.holds(cell)), "")

    def why_never(self, hook: Hook, by: str, action: str) -> str:
        """The reason why no body does ``action`` in ``hook`` when ``by`` leads there; empty if one may."""
        return next((excluded.reason for excluded in self.excluded if excluded.holds_always(hook, by, action)), "")


@functools.cache
def load_dimensions() -> Dimensions:
    """The dimensions of the suite."""
    return read(SUITE / "provocations.yaml", Dimensions)


@functools.cache
def load_cells() -> tuple[Cell, ...]:
    """The cells that have scenarios."""
    dimensions = load_dimensions()
    entrances, actions = dimensions.entrances_and_refusals(), {a.name: a for a in (*dimensions.actions, NOTHING)}
    chosen = read(COVERING, dict[str, dict[str, list[tuple[str, str, str, str]]]])
    return tuple(
        Cell(entrances[entrance], actions[action], *others)
        for entrance, by_action in chosen.items()
        for action, cells in by_action.items()
        for others in cells
    )
