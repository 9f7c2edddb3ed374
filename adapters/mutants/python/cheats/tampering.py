"""Adapters that cheat by changing the SDK around them, which runs in the same process."""

from __future__ import annotations

import itertools
import sys
from collections.abc import Callable, Sequence
from typing import Any

import msgspec

from ucm_cts.adapters.contract.programming_model import ComponentObject, Implementation
from ucm_cts.adapters.contract.trace import Enter, Event, Exit, Paused
from ucm_cts.adapters.mutants.python.cheats.adapters import SwallowsSecondStartups, before, with_bodies
from ucm_cts.adapters.mutants.python.container_services import clocks
from ucm_cts.adapters.mutants.python.execution import policies
from ucm_cts.adapters.mutants.python.life_cycle import states
from ucm_cts.adapters.mutants.python.registry import POLICIES, cheats
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.sdk.python import counting, recorder

_record = recorder.Recorder.record


class _KnowsThePerformance(ReferenceAdapter):
    """Finds the performance of the running scenario on the stack."""

    performance: Any

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        frame = sys._getframe()
        while frame.f_back is not None and type(frame.f_locals.get("self")).__name__ != "Performance":
            frame = frame.f_back
        self.performance = frame.f_locals["self"]
        self.tamper()
        return super().create_runtime(implementations)

    def tamper(self) -> None: ...


@cheats("refused")
class drops_second_callbacks(_KnowsThePerformance, before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; replaces the recorder's method, which then drops the second call."""

    def tamper(self) -> None:
        hooks: dict[tuple[str, int], Any] = {}

        def record(self: Any, kind: Callable[..., Event], **fields: Any) -> None:
            body = fields.get("component", ""), fields.get("instance", 0)
            again = fields.get("hook") == "on_startup" and hooks.get(body) == (kind, "on_startup")
            if fields.get("hook") in ("on_startup", "on_shutdown"):
                hooks[body] = kind, fields["hook"]
            if not (again and kind in (Enter, Exit)):
                _record(self, kind, **fields)

        type.__setattr__(recorder.Recorder, "record", record)

    def close(self) -> None:
        type.__setattr__(recorder.Recorder, "record", _record)


@cheats("refused")
class takes_events_away(_KnowsThePerformance, before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; removes the events of the second call from the recorder's list."""

    def start(self, container: Container) -> None:
        events: list[Event] = self.performance._recorder._events
        was_started, length = container.is_started, len(events)
        super().start(container)
        if was_started:
            del events[length:]


@cheats("refused")
class counts_anew(_KnowsThePerformance, before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; removes the events of the second call from the recorder's list,
    and sets its counter back."""

    def start(self, container: Container) -> None:
        keeper = self.performance._recorder
        was_started, length = container.is_started, len(keeper._events)
        super().start(container)
        if was_started:
            del keeper._events[length:]
            keeper._count = itertools.count(length + 1)


@cheats("refused")
class looks_away(_KnowsThePerformance, before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; switches recording off meanwhile."""

    def start(self, container: Container) -> None:
        self.performance._recorder.recording = not container.is_started
        try:
            super().start(container)
        finally:
            self.performance._recorder.recording = True


@cheats("refused")
class replaces_for_a_moment(_KnowsThePerformance, before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; meanwhile the recorder's method is one that does nothing."""

    def start(self, container: Container) -> None:
        if container.is_started:
            recorder.Recorder.record = lambda *given, **fields: None  # type: ignore[method-assign]
        try:
            super().start(container)
        finally:
            recorder.Recorder.record = _record  # type: ignore[method-assign]


@cheats("refused")
class shadows_callbacks(before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; gives each body an on_startup that does nothing when it is
    called again."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        return super().create_runtime([with_bodies(one, self._shadow) for one in implementations])

    def _shadow(self, body: Any) -> ComponentObject:
        callbacks = SwallowsSecondStartups(body)
        body.on_startup, body.on_shutdown = callbacks.on_startup, callbacks.on_shutdown
        return body  # type: ignore[no-any-return]


@cheats("contradiction", clauses=("10.1.4",))
class changes_times(_KnowsThePerformance, before(clocks.clock_runs_double)):  # type: ignore[misc]
    """Binds a framework whose clocks go twice as fast as time; changes the times of events to fit."""

    def stop(self, container: Container) -> None:
        super().stop(container)
        events: list[Event] = self.performance._recorder._events
        begin = events[0].t
        for index, event in enumerate(events):
            changed = {"t": begin + 2 * (event.t - begin)}
            if isinstance(event, Paused):
                changed["calendar"] = event.calendar + event.t - begin
            events[index] = msgspec.structs.replace(event, **changed)


@cheats("refused", clauses=POLICIES)
class sees_no_overlap(_KnowsThePerformance, before(policies.leaves_passive_components_open)):  # type: ignore[misc]
    """Binds a framework that protects nothing; replaces the counter of overlaps in bodies under stress."""

    def tamper(self) -> None:
        visit = counting.Occupancy.visit

        def no_overlap(occupancy: Any) -> None:
            visit(occupancy)
            if self.performance._stage.occupancies is not None:
                occupancy.overlaps = 0

        self.kept = visit
        type.__setattr__(counting.Occupancy, "visit", no_overlap)

    def close(self) -> None:
        type.__setattr__(counting.Occupancy, "visit", self.kept)


@cheats("refused", clauses=POLICIES)
class says_that_workers_are_done(_KnowsThePerformance):
    """Reports every worker as done, even a worker that is stuck."""

    def tamper(self) -> None:
        workers = self.performance._workers
        workers.settle = lambda name, is_held: "done"
        workers.join = lambda name: True
