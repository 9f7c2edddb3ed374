"""Adapters that cheat by exchanging parts of the SDK, or of Python under it, for whole runs or in ways that Python hides."""

from __future__ import annotations

import builtins
import ctypes
import gc
import os
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import msgspec

from ucm_cts.adapters.contract import messages
from ucm_cts.adapters.contract.programming_model import ComponentObject, Implementation
from ucm_cts.adapters.contract.trace import Enter, Event, Exit
from ucm_cts.adapters.mutants.python.cheats.adapters import before, with_bodies
from ucm_cts.adapters.mutants.python.cheats.tampering import _KnowsThePerformance
from ucm_cts.adapters.mutants.python.container_services import clocks
from ucm_cts.adapters.mutants.python.life_cycle import states
from ucm_cts.adapters.mutants.python.registry import cheats
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.sdk.python import engine, probe, recorder

_LEN = len


class _Exchanges(before(states.starts_twice)):  # type: ignore[misc]
    """Does something once, before its first scenario in a host."""

    is_exchanged = False

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        if not _Exchanges.is_exchanged:
            _Exchanges.is_exchanged = True
            self.exchange()
        runtime: ContainerManager = super().create_runtime(implementations)
        return runtime

    def exchange(self) -> None: ...


def _without_second_startups(events: Iterable[Any]) -> list[Any]:
    """``events`` without those of an on_startup that follows an on_startup of the same body."""
    up: dict[tuple[str, int], int] = {}
    kept = []
    for event in events:
        if isinstance(event, Enter | Exit):
            body = event.component, event.instance
            if event.hook == "on_startup":
                up[body] = up.get(body, 0) + 1
                if up[body] > 2:
                    continue
            elif event.hook == "on_shutdown":
                up[body] = 0
        kept.append(event)
    return kept


@cheats("refused")
class replaces_the_encoder(_Exchanges):
    """Binds a framework that calls on_startup twice; replaces the encoder of messages for the whole run, which drops the second
    call."""

    def exchange(self) -> None:
        encode = messages.encode

        def without(message: Any) -> bytes:
            if isinstance(message, messages.Traced):
                message = msgspec.structs.replace(message, events=tuple(_without_second_startups(message.events)))
            return encode(message)

        messages.encode = without


@cheats("refused")
class replaces_the_seal(_Exchanges):
    """Binds a framework that calls on_startup twice; replaces the recorder's method, and the seal by one that sees nothing."""

    def exchange(self) -> None:
        class Blind:
            def broken(self, *objects: object) -> None: ...

        engine.SEAL = engine.CONTRACT = Blind()  # type: ignore[assignment]
        _replace_record()


@cheats("refused")
class empties_the_seal(_Exchanges):
    """Binds a framework that calls on_startup twice; replaces the recorder's method, and empties the tables of the seal."""

    def exchange(self) -> None:
        for name in ("_tables", "_traits", "_cells", "_lineages"):
            object.__setattr__(engine.SEAL, name, ())
        _replace_record()


def _replace_record() -> None:
    record = recorder.Recorder.record
    starts: dict[tuple[str, int], int] = {}

    def without(self: Any, kind: Callable[..., Event], **fields: Any) -> None:
        body = fields.get("component", ""), fields.get("instance", 0)
        if fields.get("hook") == "on_startup":
            starts[body] = starts.get(body, 0) + 1
            if starts[body] > 2:
                return
        elif fields.get("hook") == "on_shutdown" or kind.__name__ == "Create":
            starts[body] = 0
        record(self, kind, **fields)

    type.__setattr__(recorder.Recorder, "record", without)


@cheats("refused")
class replaces_the_output(_Exchanges):
    """Binds a framework that calls on_startup twice; replaces os.write, which then drops the second call from answers."""

    def exchange(self) -> None:
        write = os.write

        def without(target: int, data: Any) -> int:
            try:
                message = messages.from_host_decoder().decode(bytes(data))
            except msgspec.MsgspecError:
                return write(target, data)
            if isinstance(message, messages.Traced):
                message = msgspec.structs.replace(message, events=tuple(_without_second_startups(message.events)))
            write(target, messages.encode(message) + b"\n")
            return len(data)

        os.write = without


@cheats("refused")
class replaces_builtins(_KnowsThePerformance, before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; takes the events of the second call away, and replaces ``len``, which then
    counts them."""

    missing = 0

    def start(self, container: Container) -> None:
        events: list[Event] = self.performance._recorder._events
        was_started, length = container.is_started, len(events)
        super().start(container)
        if was_started:
            self.missing += len(events) - length
            del events[length:]
            builtins.len = lambda one: _LEN(one) + (self.missing if one is events else 0)


@cheats("refused")
class exchanges_a_table(_Exchanges):
    """Binds a framework that calls on_startup twice; enters bodies of its own in the SDK's table, which pass over the second
    call."""

    def exchange(self) -> None:
        for key, kind in probe._KINDS.items():
            probe._KINDS[key] = _deaf(kind)


@cheats("refused")
class derives_from_bodies(before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; makes each body one of a derived class, which passes over the second call."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        return super().create_runtime([with_bodies(one, self._derive) for one in implementations])

    def _derive(self, body: Any) -> ComponentObject:
        body.__class__ = _deaf(type(body))
        return body  # type: ignore[no-any-return]


def _deaf(kind: type[Any]) -> type[Any]:
    ups: set[int] = set()

    def on_startup(self: Any, dependencies: Any) -> None:
        if id(self) not in ups:
            ups.add(id(self))
            kind.on_startup(self, dependencies)

    def on_shutdown(self: Any) -> None:
        ups.discard(id(self))
        kind.on_shutdown(self)

    metaclass: Any = type(kind)
    derived: type[Any] = metaclass(kind.__name__, (kind,), {"on_startup": on_startup, "on_shutdown": on_shutdown})
    return derived


@cheats("refused")
class changes_the_lineage_of_bodies(_Exchanges):
    """Binds a framework that calls on_startup twice; puts a class of its own before the bodies' base classes, which ends them
    quietly."""

    def exchange(self) -> None:
        bases = probe.ConnectableProbe.__bases__
        type.__setattr__(probe.ConnectableProbe, "__bases__", (_deaf(probe.Probe), *bases[1:]))


@cheats("refused")
class patches_through_gc(_Exchanges):
    """Binds a framework that calls on_startup twice; finds the recorder's real dictionary with ``gc`` and exchanges its method."""

    def exchange(self) -> None:
        (attributes,) = (one for one in gc.get_referents(vars(recorder.Recorder)) if isinstance(one, dict))
        keep = SwallowsRecords(attributes["record"])
        attributes["record"] = lambda *given, **fields: keep.record(*given, **fields)


@cheats("refused")
class patches_through_ctypes(_Exchanges):
    """Binds a framework that calls on_startup twice; exchanges the recorder's method by its address in memory."""

    def exchange(self) -> None:
        read_only = vars(recorder.Recorder)
        place = id(read_only) + 2 * ctypes.sizeof(ctypes.c_void_p)
        attributes: dict[str, Any] = ctypes.cast(place, ctypes.POINTER(ctypes.py_object)).contents.value
        keep = SwallowsRecords(attributes["record"])
        attributes["record"] = lambda *given, **fields: keep.record(*given, **fields)
        ctypes.pythonapi.PyType_Modified(ctypes.py_object(recorder.Recorder))


class SwallowsRecords:
    """Records all but a second on_startup."""

    def __init__(self, record: Callable[..., None]) -> None:
        self._record = record
        self._ups: dict[Any, int] = {}

    def record(self, kept: Any, kind: Callable[..., Event], **fields: Any) -> None:
        body = id(kept), fields.get("component"), fields.get("instance")
        hook = fields.get("hook")
        self._ups[body] = (
            self._ups.get(body, 0) + 1
            if hook == "on_startup"
            else 0
            if hook == "on_shutdown"
            else self._ups.get(body, 0)
        )
        if hook != "on_startup" or self._ups[body] <= 2:
            self._record(kept, kind, **fields)


@cheats("refused")
class takes_the_name_of_the_sdk(_KnowsThePerformance, before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; code under the name of the recorder's module switches recording off
    meanwhile."""

    def start(self, container: Container) -> None:
        scope = {"__name__": recorder.__name__, "kept": self.performance._recorder}
        try:
            exec(f"kept.recording = {not container.is_started}", scope)  # noqa: S102
            super().start(container)
        finally:
            exec("kept.recording = True", scope)  # noqa: S102


@cheats("refused")
class traces_calls(_Exchanges):
    """Binds a framework that calls on_startup twice; ``sys.settrace`` has the recorder's method forget a second one."""

    def exchange(self) -> None:
        keep: dict[Any, int] = {}

        def trace(frame: Any, event: str, argument: Any) -> Any:
            if frame.f_code is recorder.Recorder.record.__code__:
                fields = frame.f_locals.get("fields", {})
                keep[fields.get("component")] = keep.get(fields.get("component"), 0) + 1
            return None

        sys.settrace(trace)


@cheats("refused")
class finalizes_bodies(_Exchanges):
    """Binds a framework that calls on_startup twice; gives bodies a ``__del__`` that could tidy up what was recorded."""

    def exchange(self) -> None:
        type.__setattr__(probe.Probe, "__del__", lambda body: None)


@cheats("refused")
class changes_defaults(_Exchanges):
    """Binds a framework that calls on_startup twice; changes the default of a function of the SDK, by which gates count as
    reached."""

    def exchange(self) -> None:
        from ucm_cts.adapters.sdk.python.gates import Gates

        Gates.reach.__defaults__ = (0, -1)


@cheats("R-10.1.4.1-09", clauses=("10.1.4",))
class replaces_clocks(before(clocks.clock_runs_double)):  # type: ignore[misc]
    """Binds a framework whose clocks go twice as fast as time; replaces the functions of the module ``time`` to fit."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        begin, now = time.monotonic_ns(), time.monotonic_ns
        time.monotonic_ns = lambda: 2 * now() - begin
        return super().create_runtime(implementations)
