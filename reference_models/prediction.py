"""Run a scenario on the reference model instead of a framework: the first permitted outcome of each operation happens.

Used to derive scenarios from the life-cycle table, never to judge.
"""

from __future__ import annotations

from typing import get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import DeclaredError, Enter, Raise, Reference, Return
from ucm_cts.reference_models.adoption import adopt
from ucm_cts.reference_models.duties import Listener, pattern
from ucm_cts.reference_models.life_cycle import LifeCycleTable
from ucm_cts.reference_models.runtime import Member, Runtime, Window
from ucm_cts.reference_models.situations import Situations, undone_by


class Prediction:
    """A runtime of the model that carries out steps itself."""

    def __init__(self, table: LifeCycleTable, components: dict[str, s.Declaration]) -> None:
        self._situations = Situations(table)
        self.runtime = Runtime(s.Scenario(components, ()))
        self._next_id = 0
        self._made: dict[str, int] = {}

    def look(self, step: s.ContainerCall) -> Window:
        """The window ``step`` would open now; nothing changes."""
        return self._situations.open(self.runtime, 0, step)

    def perform(self, step: s.ContainerCall) -> Window:
        """Carry ``step`` out in the first way that suits every instance concerned."""
        window = self.look(step)
        answers = [a for o in window.roles[0][1].outcomes for a in o.answer] if window.roles else ["return"]
        answer = next(
            (a for a in answers if all(any(a in o.answer for o in row.outcomes) for _, row in window.roles)), answers[0]
        )
        for member, row in window.roles:
            outcome = next((o for o in row.outcomes if answer in o.answer), row.outcomes[0])
            connectable = member.declaration.connectable if member else self._declares_connectable(step)
            component, instance = self._body(step, member)
            undone = len(undone_by(window, member)) if member else 0
            for hook, optional in pattern(outcome, Listener(connectable, False, undone)):
                if not optional and component:
                    window.hear(Enter(0, 0, 0, component, instance, hook))  # type: ignore[arg-type]
        adopt(self.runtime, window, self._end(step, window, answer))
        return window

    def _end(self, step: s.ContainerCall, window: Window, answer: str) -> Return | Raise:
        if answer in get_args(DeclaredError):
            return Raise(0, 0, 0, 0, answer)  # type: ignore[arg-type]
        if isinstance(step, s.AddComponent | s.Connect):
            self._next_id += 1
            return Return(0, 0, 0, 0, self._next_id)
        if isinstance(step, s.GetPortElement) and window.subject is not None:
            member: Member = window.subject
            return Return(0, 0, 0, 0, Reference(member.component, member.instance or 1, step.port))
        return Return(0, 0, 0, 0)

    def _declares_connectable(self, step: s.ContainerCall) -> bool:
        declaration = self.runtime.scenario.components.get(step.component) if isinstance(step, s.AddComponent) else None
        return declaration is not None and declaration.connectable

    def _body(self, step: s.ContainerCall, member: Member | None) -> tuple[str, int]:
        if member is not None:
            return member.component, member.instance or 1
        if isinstance(step, s.AddComponent):
            self._made[step.component] = self._made.get(step.component, 0) + 1
            return step.component, self._made[step.component]
        return "", 0
