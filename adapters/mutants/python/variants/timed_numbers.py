"""Conformant frameworks, clause 10.3.2: what happens when a number is started whose timer waits."""

from __future__ import annotations

from typing import Any

from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.registry import TIMED, variant_of
from ucm_cts.adapters.reference.python.timers import Timer, Timers


@variant_of(*TIMED, readings={"number-in-use": "keep"})
class keeps_the_old_timer(Timers):
    """Starting a number whose timer waits has no effect."""

    def _start(self, timer: Timer) -> None:
        if timer.number not in self._waiting:
            super()._start(timer)


@variant_of(*TIMED, readings={"number-in-use": "refuse"})
class refuses_numbers_in_use(Timers):
    """Starting a number whose timer waits raises."""

    def _start(self, timer: Timer) -> None:
        if timer.number in self._waiting:
            raise UcmError("the number is in use")
        super()._start(timer)


@variant_of(*TIMED, readings={"number-in-use": "both"})
class runs_both_timers(Timers):
    """A number may have several timers."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._several: dict[int, list[Timer]] = {}

    def _start(self, timer: Timer) -> None:
        with self._changed:
            if timer.number in self._waiting:
                self._several.setdefault(timer.number, []).append(timer)
                known = [self._waiting[timer.number], *self._several[timer.number]]
                first, *rest = sorted(known, key=lambda one: one.due)
                self._waiting[timer.number], self._several[timer.number] = first, rest
                self._changed.notify()
                return
        super()._start(timer)

    def take(self, timer: Timer) -> bool:
        taken = super().take(timer)
        with self._changed:
            rest = self._several.pop(timer.number, [])
            if taken and rest:
                first, *others = sorted([*self._of(timer.number), *rest], key=lambda one: one.due)
                self._waiting[timer.number], self._several[timer.number] = first, others
            elif rest:
                self._several[timer.number] = rest
        return taken

    def _of(self, number: int) -> list[Timer]:
        return [self._waiting[number]] if number in self._waiting else []

    def cancel_timer(self, number: int) -> None:
        super().cancel_timer(number)
        self._several.pop(number, None)
