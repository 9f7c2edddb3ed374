"""The clock and the log of a component's container: the policies by which it gets them, and the port elements that it calls."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Policy

CLOCK, TRACE = "clock.clock_api", "trace.trace_api"

HAS_CLOCK = Policy(s.CLOCK, element=CLOCK)
HAS_TRACE = Policy(s.COMPONENT_TRACE, element=TRACE)
