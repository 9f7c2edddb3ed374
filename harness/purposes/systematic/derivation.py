"""Derives machines from the life-cycle table, where it and the vendor's readings determine the next state."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.harness.purposes.systematic.machine import Machine, Move, Permitted
from ucm_cts.harness.purposes.systematic.permission import Permission
from ucm_cts.harness.purposes.systematic.settings import Input, Setting
from ucm_cts.reference_models.model.hindrance import is_forgiving
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.prediction import Prediction, Way
from ucm_cts.reference_models.model.row_selection import RowSelection

State = tuple[object, ...]
"""The part of a runtime that decides its further behaviour: phases, members, connections."""


def derive(table: LifeCycleTable, setting: Setting, readings: Mapping[str, str]) -> Machine:
    """The machine of ``setting`` for a vendor who declares ``readings``.

    An input is defined in a state if the monitor gives a verdict on it there, and all its permitted ways lead to one known state.
    Where an operation may fail half-way and leave an unknown state, that is permitted, and the machine goes on
    as if it had not been so.
    """
    return _Derivation(table, Ics(readings), setting).machine()


class _Derivation:
    def __init__(self, table: LifeCycleTable, ics: Ics, setting: Setting) -> None:
        self.setting = setting
        self.first = Prediction(RowSelection(table), dict(setting.components))
        self.permission = Permission(table, ics)
        self.outputs: dict[Permitted, int] = {}

    def machine(self) -> Machine:
        """Searches the states breadth first."""
        first = state_of(self.first.runtime)
        assert first is not None
        numbers = {first: 0}
        waiting = deque([(first, self.first)])
        moves: list[dict[int, Move]] = []
        while waiting:
            state, now = waiting.popleft()
            moves.append({})
            for number, meant in enumerate(self.setting.inputs):
                given = _named(now.runtime, meant)
                ongoing = now.begin(given.step)
                after = self.after(now, state, given, ongoing) if is_defined(now, ongoing) else None
                if after is None:
                    continue
                reached, then, way = after
                if reached not in numbers:
                    numbers[reached] = len(numbers)
                    waiting.append((reached, then))
                permitted = self.permitted(now.runtime, ongoing, way)
                moves[-1][number] = Move(numbers[reached], self.outputs.setdefault(permitted, len(self.outputs)))
        return Machine(tuple(i.name for i in self.setting.inputs), tuple(self.outputs), tuple(moves))

    def after(
        self, now: Prediction, state: State, given: Input, ongoing: OperationInProgress
    ) -> tuple[State, Prediction, Way] | None:
        """The one known state that ``given`` leads to, the model in that state, and a way there; None unless there is
        just one.
        """
        reached: dict[State, tuple[Prediction, Way]] = {}
        for way in now.ways(ongoing):
            if not self.permission.permits(now.runtime, ongoing, way):
                continue
            if way.answer == "UCM_ERROR" and is_forgiving(now.runtime, ongoing):
                return None  # perhaps for a reason that the table does not know: the monitor loses track
            if _changes_nothing(given.step, way):
                reached.setdefault(state, (now, way))
                continue
            then = now.fork()
            then.carry_out(given.step, way)
            after = state_of(then.runtime)
            if after is None and not _is_half_done(way):
                return None
            if after is None or after in reached:
                continue
            for step in given.follow if way.answer == "return" else ():
                then.perform(step)
            reached[after] = then, way
        if len(reached) != 1:
            return None
        [(after, (then, way))] = reached.items()
        return after, then, way

    def permitted(self, runtime: ObservedRuntime, ongoing: OperationInProgress, usual: Way) -> Permitted:
        """The possible observations of the next operation, the ``usual`` one first."""
        ways = (usual, *self.permission.ways(runtime, ongoing))
        seen = dict.fromkeys(o for way in ways for o in self.permission.seen(runtime, ongoing, way))
        return Permitted(tuple(seen), is_forgiving(runtime, ongoing))


def _named(runtime: ObservedRuntime, given: Input) -> Input:
    """A container that does not exist is a null reference."""
    if isinstance(given.step, s.RemoveContainer):
        container = runtime.containers.get(given.step.container)
        if container is None or container.removed:
            return Input(given.name, s.RemoveContainer(s.NIL))
    return given


def is_defined(now: Prediction, ongoing: OperationInProgress) -> bool:
    """Can the operation's step be taken now, and would it be judged?"""
    step = ongoing.step
    if isinstance(step, s.Connect) and step.to != s.NIL:
        _, provider = now.runtime.reference(step.to)
        if provider is None or provider.gone:
            return False
    if isinstance(step, s.AddComponent) and step.component in now.runtime.scenario.components:
        member = now.runtime.members.get(step.bind or step.component)
        if member is not None and not member.gone:
            return False  # its name would be another's
    if isinstance(step, s.CreateContainer):
        container = now.runtime.containers.get(step.bind)
        if container is not None and not container.removed:
            return False
    return ongoing.judged


def _changes_nothing(step: s.ContainerCall, way: Way) -> bool:
    """Whether an operation is refused without callbacks. Starts and stops are always observed."""
    if isinstance(step, s.GetPortElement | s.GetComponents):
        return True
    return way.answer != "return" and not any(way.callbacks) and not isinstance(step, s.Start | s.Stop)


def _is_half_done(way: Way) -> bool:
    """An operation that fails after a body got a callback."""
    return way.answer != "return" and any(way.callbacks)


def state_of(runtime: ObservedRuntime) -> State | None:
    """The state: phases, members, connections. None if a part of it is not known."""
    if runtime.destroyed:
        return ("destroyed",)
    containers = [c for c in runtime.containers.values() if not c.removed]
    members = [m for c in containers for m in c.live_members()]
    connections = [c for m in members for c in m.connections]
    if any(c.started is None or c.doubtful for c in containers) or any(m.suspended or m.doubtful for m in members):
        return None
    if any(c.live is None or c.ambiguous for c in connections):
        return None
    return (
        tuple(sorted((c.name, bool(c.started)) for c in containers)),
        tuple(sorted((m.name, m.operational) for m in members)),
        tuple(sorted((c.name, c.provider.name if c.provider else "") for c in connections if c.live)),
    )
