"""The timers of both kinds (10.3)."""

from __future__ import annotations

from ucm_cts.reference_models.model.index_timers import timer_phases
from ucm_cts.reference_models.model.object_timers import object_timer_phases
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.timer_events import Timer, TimerPhase


def all_timer_phases(runtime: ObservedRuntime) -> list[TimerPhase]:
    """The phases of components with timers, once for each kind that a component has."""
    return [*timer_phases(runtime), *object_timer_phases(runtime)]


def all_timers(runtime: ObservedRuntime) -> list[Timer]:
    """The timers of all these phases."""
    return [timer for phase in all_timer_phases(runtime) for timer in phase.timers]
