"""The outcomes that the reference model permits for an operation, under the vendor's readings."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.harness.purposes.systematic.machine import LISTS, Observation
from ucm_cts.reference_models.model.expected_callbacks import ExpectedCallbacks, Listener, pattern
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, Row
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.prediction import Way
from ucm_cts.reference_models.model.row_selection import listener_of
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.properties.declared_choices import undeclared_choice


class Permission:
    """The life-cycle table, and the readings that the vendor declares."""

    def __init__(self, table: LifeCycleTable, ics: Ics) -> None:
        self._expected = ExpectedCallbacks(table)
        self._ics = ics

    def ways(self, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Iterator[Way]:
        """Every way in which the operation that is about to begin may go."""
        answers = dict.fromkeys(a for _, row in ongoing.roles for outcome in row.outcomes for a in outcome.answer)
        for answer in answers:
            choices = [list(_sequences(row, answer, listener_of(ongoing, member))) for member, row in ongoing.roles]
            for callbacks in itertools.product(*choices):
                way = Way(answer, callbacks)
                if self.permits(runtime, ongoing, way):
                    yield way

    def permits(self, runtime: ObservedRuntime, ongoing: OperationInProgress, way: Way) -> bool:
        """Does each instance go a way that its row permits, and none one that its vendor has ruled out?"""
        fitted = []
        for (member, row), hooks in zip(ongoing.roles, way.callbacks, strict=True):
            fit = self._expected.fit(row, way.answer, listener_of(ongoing, member), hooks)
            if fit is None:
                return False
            fitted.append((member, row, fit))
        end = Return(0, 0, 0, 0) if way.answer == "return" else Raise(0, 0, 0, 0, way.answer)  # type: ignore[arg-type]
        return undeclared_choice(self._ics, ongoing, end, fitted) is None

    def seen(self, runtime: ObservedRuntime, ongoing: OperationInProgress, way: Way) -> Iterator[Observation]:
        """The output of the operation if it goes this ``way``; a list may be shorter or longer."""
        received = sorted(
            (_name(ongoing, member), hooks)
            for (member, _), hooks in zip(ongoing.roles, way.callbacks, strict=True)
            if hooks
        )
        for answer in self._answers(runtime, ongoing, way.answer):
            yield Observation(answer, tuple(received))

    def _answers(self, runtime: ObservedRuntime, ongoing: OperationInProgress, answer: str) -> Iterator[str]:
        if answer != "return" or not isinstance(ongoing.step, s.GetComponents):
            yield answer
            return
        own = sorted(m.name for m in ongoing.container.live_members())
        every = sorted(m.name for c in runtime.containers.values() for m in c.live_members())
        below = ongoing.container.name == s.MANAGER and every != own
        if not below or self._ics.permits("manager-get-components", "own"):
            yield " ".join((LISTS, *own))
        if below and self._ics.permits("manager-get-components", "recursive"):
            yield " ".join((LISTS, *every))


def _name(ongoing: OperationInProgress, member: Member | None) -> str:
    if member is None and isinstance(ongoing.step, s.AddComponent):
        return ongoing.step.bind or ongoing.step.component
    return member.name if member is not None else ""


def _sequences(row: Row, answer: str, listener: Listener) -> Iterator[tuple[str, ...]]:
    """Each sequence of callbacks that ``row`` permits together with ``answer``, once."""
    found: set[tuple[str, ...]] = set()
    for outcome in row.outcomes:
        if answer in outcome.answer:
            tokens = pattern(outcome, listener)
            for kept in itertools.product(*((True, False) if optional else (True,) for _, optional in tokens)):
                sequence = tuple(hook for (hook, _), keep in zip(tokens, kept, strict=True) if keep)
                if sequence not in found:
                    found.add(sequence)
                    yield sequence
