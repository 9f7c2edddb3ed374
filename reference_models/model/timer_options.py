"""Options that hold for both kinds of timers, unless they are declared apart for object timers (10.3.1, 10.3.2)."""

from __future__ import annotations

from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.timer_events import Kind

SAME = "as-index-timers"
"""The value by which object timers do as index timers."""


def option_of(runtime: ObservedRuntime, kind: Kind, option: str) -> str:
    """The option that decides for timers of ``kind`` what ``option`` decides for index timers."""
    apart = f"object-{option}"
    is_apart = kind == "object" and runtime.ics.readings.get(apart, SAME) != SAME
    return apart if is_apart else option


def reading_of(runtime: ObservedRuntime, kind: Kind, option: str) -> str:
    """The value that holds of ``option`` for timers of ``kind``."""
    return runtime.ics.reading(option_of(runtime, kind, option))
