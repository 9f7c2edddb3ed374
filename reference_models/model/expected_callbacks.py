"""The callbacks an instance must receive: patterns of the life-cycle table, and the requirement a deviation breaks."""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ucm_cts.reference_models.model.life_cycle import CallbackDuty, LifeCycleTable, Outcome, Row

CONNECTABLE_HOOKS = ("on_connect", "on_disconnect")
LIFE_CYCLE_HOOKS = ("on_init", "on_startup", "on_shutdown", "on_remove", *CONNECTABLE_HOOKS)

_UNSOLICITED = ("on_init", "on_startup", "on_shutdown")
_MOST_REMEMBERED = 20_000

Token = tuple[str, bool]
"""A callback of an outcome's pattern, and whether it may be left out."""


class Listener(NamedTuple):
    """The properties of an instance that decide its callbacks: its interfaces and how many connections are undone."""

    connectable: bool
    fragment: bool
    undone: int


listener = functools.lru_cache(1024)(Listener)
"""The one listener with these properties: each role of each operation asks for one."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A way for an operation to go that ``row`` permits: the requirements it exercises, and the readings that permit it, one
    of which has been taken. There are none where it is permitted under every reading.
    """

    row: Row
    readings: tuple[str, ...]
    exercised: tuple[str, ...]


_NOT_KNOWN = Fit(Row("", "absent", "", "", ()), (), ())


@dataclass(frozen=True)
class Deviation:
    """A deviation: the callback at fault (none if only the order is wrong), and the pattern that comes nearest."""

    requirement: str
    hook: str
    missing: bool
    wanted: tuple[str, ...]


class ExpectedCallbacks:
    """The life-cycle table as far as callbacks go. What it has worked out once it remembers.

    ``answers``: those that each row permits, by the row's ``id()``.
    """

    def __init__(self, table: LifeCycleTable) -> None:
        self._table = table
        self._duties: dict[tuple[str, str], CallbackDuty] = {}
        self.answers = {id(row): frozenset(a for o in row.outcomes for a in o.answer) for row in table.rows}
        self._always: dict[tuple[int, str], bool] = {}
        self._fits: dict[tuple[int, str, Listener, tuple[str, ...]], Fit | None] = {}

    def of(self, callback: str, operation: str) -> CallbackDuty:
        """The first duty of ``callback`` that names ``operation``, or the one for all others."""
        duty = self._duties.get((callback, operation))
        if duty is None:
            candidates = (d for d in self._table.duties if d.callback == callback)
            duty = next(d for d in candidates if not d.operations or operation in d.operations)
            self._duties[callback, operation] = duty
        return duty

    def always_calls(self, row: Row, hook: str) -> bool:
        """Does the instance receive ``hook`` in whichever way ``row`` lets the operation return?"""
        known = self._always.get((id(row), hook))
        if known is None:
            known = all(hook in outcome.callbacks for outcome in row.outcomes if "return" in outcome.answer)
            self._always[id(row), hook] = known
        return known

    def fit(self, row: Row, answer: str, listener: Listener, hooks: tuple[str, ...]) -> Fit | None:
        """How ``hooks`` fits an outcome of ``row`` with this ``answer``; None if it does not."""
        key = (id(row), answer, listener, hooks)
        known = self._fits.get(key, _NOT_KNOWN)
        if known is not _NOT_KNOWN:
            return known
        fit = self._fit(row, answer, listener, hooks)
        if len(self._fits) < _MOST_REMEMBERED:
            self._fits[key] = fit
        return fit

    def _fit(self, row: Row, answer: str, listener: Listener, hooks: tuple[str, ...]) -> Fit | None:
        fitting = [o for o in row.outcomes if answer in o.answer and fits(pattern(o, listener), hooks)]
        if not fitting:
            return None
        readings = tuple(dict.fromkeys(o.reading for o in fitting))
        return Fit(row, () if "" in readings else readings, tuple(self._exercised(row, answer, listener, hooks)))

    def _exercised(self, row: Row, answer: str, listener: Listener, hooks: tuple[str, ...]) -> list[str]:
        exercised = []
        for hook in dict.fromkeys(hooks):
            exercised.append(self.of(hook, row.operation).missing)
            if listener.fragment and hook in ("on_init", "on_startup"):
                exercised.append(self._table.fragments)
        if len(hooks) > 1 and "on_remove" in hooks and answer == "return":
            exercised.append(self._table.order)
        if row.operation == "connect" and listener.connectable and not hooks:
            exercised.append(self.of("on_connect", "connect").unexpected)
        if row.state != "absent":
            for hook in _UNSOLICITED:
                duty = self.of(hook, row.operation)
                if hook not in hooks and duty.missing != duty.unexpected:
                    exercised.append(duty.unexpected)
        return exercised

    def deviation(self, row: Row, answer: str, listener: Listener, hooks: tuple[str, ...]) -> Deviation:
        """What is wrong with ``hooks``, which fits no outcome of ``row`` with this ``answer``."""
        patterns = [pattern(o, listener) for o in row.outcomes if answer in o.answer]
        nearest = min(patterns, key=lambda tokens: sum(map(Counter.total, _difference(tokens, hooks))))
        missing, surplus = _difference(nearest, hooks)
        wanted = tuple(hook for hook, optional in nearest if not optional)
        if missing:
            hook = next(h for h in wanted if h in missing)
            requirement = row.missing or self.of(hook, row.operation).missing
            if listener.fragment and hook in ("on_init", "on_startup") and not row.missing:
                requirement = self._table.fragments
            return Deviation(requirement, hook, True, wanted)
        if surplus:
            hook = next(h for h in hooks if h in surplus)
            return Deviation(self.of(hook, row.operation).unexpected, hook, False, wanted)
        return Deviation(self._table.order, "", False, wanted)


def pattern(outcome: Outcome, listener: Listener) -> list[Token]:
    """The callbacks that ``outcome`` asks for from such an instance."""
    tokens: list[Token] = []
    for text in outcome.callbacks:
        hook = text.rstrip("?*")
        if hook not in CONNECTABLE_HOOKS or listener.connectable:
            tokens.extend([(hook, text.endswith("?"))] * (listener.undone if text.endswith("*") else 1))
    return tokens


def fits(tokens: Sequence[Token], hooks: Sequence[str]) -> bool:
    """Is ``hooks`` a sequence that ``tokens`` permits?"""
    if not tokens:
        return not hooks
    hook, optional = tokens[0]
    if hooks and hooks[0] == hook and fits(tokens[1:], hooks[1:]):
        return True
    return optional and fits(tokens[1:], hooks)


def _difference(tokens: Sequence[Token], hooks: Sequence[str]) -> tuple[Counter[str], Counter[str]]:
    """Callbacks that should be there and are not, and those that are there and should not."""
    required = Counter(hook for hook, optional in tokens if not optional)
    permitted = Counter(hook for hook, _ in tokens)
    seen = Counter(hooks)
    return required - seen, seen - permitted
