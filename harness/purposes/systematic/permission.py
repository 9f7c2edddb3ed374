"""The outcomes that the reference model permits for an operation, under the vendor's readings."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import ucm_cts.reference_models.monitor  # noqa: F401 - registers the rules, in their order
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.harness.purposes.systematic.machine import LISTS, Observation
from ucm_cts.reference_models.model.expected_callbacks import Duties, Listener, pattern
from ucm_cts.reference_models.model.ics import Claims
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, Row
from ucm_cts.reference_models.model.prediction import Way
from ucm_cts.reference_models.model.row_selection import undone_by
from ucm_cts.reference_models.model.runtime import Member, Runtime, Window
from ucm_cts.reference_models.verdicts import RULES, Ledger


class Permission:
    """The life-cycle table, and the readings that the vendor declares."""

    def __init__(self, table: LifeCycleTable, claims: Claims) -> None:
        self._duties = Duties(table)
        self._claims = claims

    def ways(self, runtime: Runtime, window: Window) -> Iterator[Way]:
        """Every way in which the operation that is about to begin may go."""
        answers = dict.fromkeys(a for _, row in window.roles for outcome in row.outcomes for a in outcome.answer)
        for answer in answers:
            choices = [list(_sequences(row, answer, listener_of(window, member))) for member, row in window.roles]
            for callbacks in itertools.product(*choices):
                way = Way(answer, callbacks)
                if self.permits(runtime, window, way):
                    yield way

    def permits(self, runtime: Runtime, window: Window, way: Way) -> bool:
        """Does each instance go a way that its row permits, and none one that its vendor has ruled out?"""
        ledger = Ledger(runtime.scenario, self._duties, claims=self._claims)
        window.fitted = []
        for (member, row), heard in zip(window.roles, way.callbacks, strict=True):
            fit = self._duties.fit(row, way.answer, listener_of(window, member), heard)
            if fit is None:
                return False
            window.fitted.append((member, row, fit))
        end = Return(0, 0, 0, 0) if way.answer == "return" else Raise(0, 0, 0, 0, way.answer)  # type: ignore[arg-type]
        RULES["declared_choices"].check(ledger, runtime, window, end)
        return not ledger.findings

    def seen(self, runtime: Runtime, window: Window, way: Way) -> Iterator[Observation]:
        """The output of the operation if it goes this ``way``; a list may be shorter or longer."""
        told = sorted(
            (_name(window, member), heard)
            for (member, _), heard in zip(window.roles, way.callbacks, strict=True)
            if heard
        )
        for answer in self._answers(runtime, window, way.answer):
            yield Observation(answer, tuple(told))

    def _answers(self, runtime: Runtime, window: Window, answer: str) -> Iterator[str]:
        if answer != "return" or not isinstance(window.step, s.GetComponents):
            yield answer
            return
        own = sorted(m.name for m in window.container.live_members())
        every = sorted(m.name for c in runtime.containers.values() for m in c.live_members())
        below = window.container.name == s.MANAGER and every != own
        if not below or self._claims.permits("manager-get-components", "own"):
            yield " ".join((LISTS, *own))
        if below and self._claims.permits("manager-get-components", "recursive"):
            yield " ".join((LISTS, *every))


def listener_of(window: Window, member: Member | None) -> Listener:
    """The key that decides which callbacks an instance in a role of the operation gets."""
    if member is not None:
        declaration = member.declaration
        return Listener(declaration.connectable, declaration.fragment, len(undone_by(window, member)))
    return Listener(False, False, 0)


def _name(window: Window, member: Member | None) -> str:
    if member is None and isinstance(window.step, s.AddComponent):
        return window.step.bind or window.step.component
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
