"""What a body was given before, for the plans that name it (``Remembered``)."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.scenario import Action, Hook
from ucm_cts.adapters.sdk.python.seal import KeptClass


@dataclass(frozen=True)
class Entry:
    """A body was entered at ``method`` with these ``arguments`` and the object timer of this number, or at ``exchange`` with ``value``."""

    method: str = ""
    arguments: tuple[Datum, ...] = ()
    value: int | None = None
    timer: int | None = None


class Memory(metaclass=KeptClass):
    """The arguments of the methods that ``plan`` wants remembered, and all object timers that came to the body."""

    def __init__(self, plan: Mapping[Hook, Sequence[Action]]) -> None:
        actions = [action for actions in plan.values() for action in actions]
        self._methods = {
            one.method for action in actions if isinstance(action, s.CallMethod) for one in action.remembered
        }
        self._seen: list[Entry] = []
        self._timers: list[tuple[str, Any]] = []
        self._lock = threading.Lock()

    def entry(
        self, method: str, arguments: tuple[Datum, ...], record: Callable[[Entry], None], timer: Any = None
    ) -> Entry:
        """Record and remember an entry, and the object ``timer`` that came with it, in one and the same order."""
        if timer is None and method not in self._methods:
            entry = Entry(method, arguments)
            record(entry)
            return entry
        with self._lock:
            entry = Entry(method, arguments, timer=self._number(method, timer) if timer is not None else None)
            record(entry)
            if method in self._methods:
                self._seen.append(entry)
        return entry

    def take_timer(self, method: str, timer: Any, record: Callable[[int], None]) -> None:
        """Number an object timer that came back from ``method``, and record that, in one and the same order."""
        with self._lock:
            record(self._number(method, timer))

    def _number(self, method: str, timer: Any) -> int:
        """The number of an object timer that came by ``method``."""
        self._timers.append((method, timer))
        return len(self._timers)

    def timer(self, of: s.TimerFrom, entry: Entry) -> tuple[int, Any] | None:
        """The number of an object timer, and itself; None if the body was not given it yet."""
        with self._lock:
            if of.nth == 0:
                number = entry.timer if entry.method == of.method else None
            else:
                matching = [index for index, (method, _) in enumerate(self._timers, 1) if method == of.method]
                number = matching[of.nth - 1] if 1 <= of.nth <= len(matching) else None
            return (number, self._timers[number - 1][1]) if number is not None else None

    def arguments(self, call: s.CallMethod, entry: Entry) -> tuple[Datum, ...] | None:
        """The arguments of ``call``, made in ``entry``; None if it is not to be made: the body was entered with another value, or
        was not given one of them yet.
        """
        if call.given is not None and call.given != entry.value:
            return None
        if not call.remembered:
            return call.arguments
        made = list(call.arguments)
        for one in call.remembered:
            found = self._find(one, entry)
            if found is None or not (one.position < len(found.arguments) and one.argument < len(made)):
                return None
            made[one.argument] = found.arguments[one.position]
        return tuple(made)

    def _find(self, one: s.Remembered, entry: Entry) -> Entry | None:
        if one.nth == 0:
            return entry if entry.method == one.method else None
        with self._lock:
            matching = [seen for seen in self._seen if seen.method == one.method]
        return matching[one.nth - 1] if one.nth <= len(matching) else None
