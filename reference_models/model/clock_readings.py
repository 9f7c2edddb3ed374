"""Readings of the clocks of bodies, compared with the host's own clocks (10.1.4.1).

The instant at which a clock was read is not known. It lies between the body's question and the answer. Conclusions hold
for each instant between them, so that a slow machine makes conclusions weaker and never wrong.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Paused, Return
from ucm_cts.reference_models.model.clock_reading import ClockReading
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.service_policies import policy_elements

LOCAL, SYNCHRONIZED = "get_local_time", "get_synchronized_time"
CLOCK_METHODS = (LOCAL, SYNCHRONIZED)

SECOND, MILLISECOND, MICROSECOND = 1_000_000_000, 1_000_000, 1_000
"""In nanoseconds."""

_MOST = 200
_WRAP = 2**32 * SECOND
"""Seconds are 32 bits without sign."""


def clock_call(runtime: ObservedRuntime, call: MethodCall) -> str:
    """The method of its clock that a body calls; empty if it calls something else."""
    request = call.request
    if request.method not in CLOCK_METHODS:
        return ""
    is_clock = request.port in policy_elements(runtime.scenario.components.get(request.component), s.CLOCK)
    return request.method if is_clock else ""


def time_given(call: MethodCall) -> tuple[int, int] | None:
    """The seconds and microseconds that a call of the clock gave; None if it gave no time."""
    reply = call.reply
    if reply is None or reply.failed or not reply.results:
        return None
    value = reply.results[0]
    if len(reply.results) != 1 or not isinstance(value, list | tuple) or len(value) != 2:
        return None
    seconds, microseconds = value
    if any(isinstance(part, bool) or not isinstance(part, int) for part in value):
        return None
    return seconds, microseconds


def readings_of(runtime: ObservedRuntime, method: str) -> list[ClockReading]:
    """The times that ``method`` gave to bodies, in the order in which they asked; of very many some are left out."""
    advances = [
        (o, o.step.milliseconds * MILLISECOND)
        for o in runtime.interactions.operations
        if isinstance(o.step, s.Advance) and isinstance(o.end, Return)
    ]
    readings = []
    for call in runtime.interactions.calls:
        given = time_given(call) if clock_call(runtime, call) == method else None
        if given is not None and call.reply is not None:
            request, reply = call.request, call.reply
            if any(o.overlaps(request.n, reply.n) for o, _ in advances):
                continue  # it is open which came first
            advanced = sum(virtual for o, virtual in advances if o.begin.n < request.n)
            time = given[0] * SECOND + given[1] * MICROSECOND
            readings.append(ClockReading(call, request.n, reply.n, request.t, reply.t, time, advanced))
    return readings[:: len(readings) // _MOST + 1]


def passed(earlier: int, later: int) -> int:
    """Nanoseconds from one time to another, negative if the clock went back. Seconds may wrap in between."""
    return (later - earlier + _WRAP // 2) % _WRAP - _WRAP // 2


def calendar_at(pauses: Sequence[Paused], begin: int, end: int) -> tuple[int, int] | None:
    """What the calendar clock showed at ``begin`` (both by the monotonic clock), and by how much it left the pace of the
    monotonic clock until ``end``. None if it was not read before and after.
    """
    before = max((index for index, pause in enumerate(pauses) if pause.t <= begin), default=None)
    after = min((index for index, pause in enumerate(pauses) if pause.t >= end), default=None)
    if before is None or after is None:
        return None
    seen = pauses[before : after + 1]
    drift = sum(abs((b.calendar - a.calendar) - (b.t - a.t)) for a, b in itertools.pairwise(seen))
    return seen[0].calendar + begin - seen[0].t, drift
