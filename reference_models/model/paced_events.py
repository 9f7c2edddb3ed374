"""What was executed at the pace of a policy of 10.5: operational phases, with their executions and the invocations behind them.

All times are those of events (``t``), in nanoseconds of the recorder's clock. The instant from which an offset passes is not
seen, only two instants between which it lies.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter
from ucm_cts.reference_models.model.executions import BusinessCall, Execution
from ucm_cts.reference_models.model.method_calls import NEVER, MethodCall
from ucm_cts.reference_models.model.runtime import Member

MILLISECOND = 1_000_000
MICROSECOND = 1_000
"""In nanoseconds."""


@dataclass(slots=True, eq=False)
class Invocation:
    """A call of a managed port element, or a message that was pushed to one.

    ``n``, ``t``: when it was made. ``call``, ``message``: one of both.
    ``over``: the event that ended the call; later than all if none did.
    """

    n: int
    t: int
    port: str
    call: BusinessCall
    message: MethodCall | None = None
    over: int = NEVER
    executions: list[Execution] = field(default_factory=list)


@dataclass(slots=True, eq=False)
class PacedExecution:
    """A run, or an execution through a managed port element.

    ``invocation``: what asked for it; None for a run, and for an execution that nobody asked for.
    ``left``: when it ended; the end of the trace if it did not.
    """

    execution: Execution
    left: int
    invocation: Invocation | None = None

    @property
    def enter(self) -> Enter:
        """How the body was entered."""
        return self.execution.enter

    @property
    def t(self) -> int:
        """When the body was entered."""
        return self.execution.enter.t

    @property
    def asked(self) -> int:
        """When it was asked for."""
        return self.invocation.t if self.invocation is not None else self.t


@dataclass(slots=True, eq=False)
class PacedPhase:
    """One operational phase of one component with a policy of 10.5, up to the first step that may end it.

    ``number``: which phase of the instance it is, from 0.
    ``origins``: the earliest and the latest instant from which the offset may count, by the vendor's reading.
    ``begin``, ``until``: its first event and the event that ends it (``n``); ``ended_at``: when that was.
    ``closed``: the event by which that step returned; later than all if it did not, or if none was made.
    ``at_its_end``: executions at its pace that began while that step was carried out.
    ``executions``: those at its pace, in order. Executions that lead back into the component through its own calls have none.
    ``others``: the other executions of the component that may keep them out.
    ``invocations``: what was asked for in it.
    """

    member: Member
    policy: s.Policy
    number: int
    origins: tuple[int, int]
    begin: int
    until: int
    ended_at: int
    closed: int
    at_its_end: list[PacedExecution] = field(default_factory=list)
    executions: list[PacedExecution] = field(default_factory=list)
    others: list[Execution] = field(default_factory=list)
    invocations: list[Invocation] = field(default_factory=list)

    @property
    def offset(self) -> int:
        """The configured offset in nanoseconds; 0 for policies without one."""
        return self._time(s.OFFSET)

    @property
    def period(self) -> int:
        """The configured period, or least distance, in nanoseconds."""
        return self._time(s.PERIOD)

    @property
    def priority(self) -> int:
        """The configured priority."""
        return self.policy.settings.get(s.PRIORITY[self.policy.definition], 0)

    def _time(self, names: Mapping[str, str]) -> int:
        return self.policy.settings.get(names.get(self.policy.definition, ""), 0) * MICROSECOND

    @property
    def overrun(self) -> int:
        """The number of the first execution that lasted for a period or longer, or after which another one of the component did; that of
        executions if there is none.
        """
        lasting = (k for k, one in enumerate(self.executions) if one.left - one.t >= self.period)
        kept_out = [one.enter.t for one in self.others if not one.over or one.left - one.enter.t >= self.period]
        before = (sum(one.t < moment for one in self.executions) for moment in kept_out)
        return min(next(lasting, len(self.executions)), *before, len(self.executions))

    @property
    def may_catch_up(self) -> bool:
        """Had a period or more passed after the first instant when the component became operational? Then what was due may come at once."""
        return self.origins[1] - self.first(latest=False) >= self.period

    def first(self, latest: bool) -> int:
        """The earliest instant, or the latest one, at which the offset has passed."""
        return self.origins[latest] + self.offset

    def busy_since(self, moment: int, within: int) -> int:
        """When the executions began that kept the component busy until ``moment``, with no gap longer than ``within``."""
        spans = [(e.t, e.left) for e in self.executions] + [
            (e.enter.t, e.left if e.over else moment) for e in self.others
        ]
        for begin, end in sorted(spans, reverse=True):
            if begin < moment and end >= moment - within and end - begin >= self.period // 2:
                moment = begin
        return moment

    def busy_until(self, moment: int, port: str = "") -> int:
        """When the execution ended that was in the component last before ``moment``: nothing could enter until then."""
        ends = [e.left if e.over else moment for e in self.others if e.enter.t < moment]
        ends += [e.left for e in self.executions if e.t < moment]
        return min(moment, max(ends, default=0))
