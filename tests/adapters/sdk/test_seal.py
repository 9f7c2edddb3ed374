"""An adapter that changes the Python SDK, or what the SDK uses, is refused with the name of what it changed; others are not."""

from __future__ import annotations

import builtins
import contextlib
import os
import threading
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import msgspec
import pytest
from performing import SINK, answer, scenario

from ucm_cts.adapters.contract import messages, trace
from ucm_cts.adapters.contract.messages import Refused, Traced
from ucm_cts.adapters.contract.programming_model import Implementation
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python import data, engine, gates, probe, probe_parts, recorder, seal

SDK = "ucm_cts.adapters.sdk.python"


def put(where: Any, name: str, value: Any) -> Callable[[], Callable[[], None]]:
    """A change, which returns how it is undone; it passes by what SDK classes refuse."""

    def change() -> Callable[[], None]:
        set_it: Any = type.__setattr__ if isinstance(where, type) else setattr
        if name in vars(where):
            before = vars(where)[name]
            undo: Callable[[], None] = lambda: set_it(where, name, before)
        else:
            delete: Any = type.__delattr__ if isinstance(where, type) else delattr
            undo = lambda: delete(where, name)
        set_it(where, name, value)
        return undo

    return change


def put_item(where: dict[Any, Any], key: Any, value: Any) -> Callable[[], Callable[[], None]]:
    def change() -> Callable[[], None]:
        before = where[key]
        where[key] = value
        return lambda: where.update({key: before})

    return change


def refusal_of(change: Callable[[], Callable[[], None]], times: int = 1) -> str | None:
    """Why a scenario in which ``change`` is made, and undone when it has ended, has no trace; the last of ``times``."""

    class Changes(ReferenceAdapter):
        def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
            self.undo = change()
            return super().create_runtime(implementations)

        def close(self) -> None:
            self.undo()

    for _ in range(times):
        reply = answer(scenario({"s": SINK}, ["add_component component=s", "start", "stop"]), Changes)
        if isinstance(reply, Refused):
            return reply.reason.partition("SDK: ")[2].partition(",")[0]
    assert isinstance(reply, Traced)
    return None


def _other_code() -> Callable[[], None]:
    before = recorder.Recorder.stop.__code__
    recorder.Recorder.stop.__code__ = (lambda self: ()).__code__
    return lambda: setattr(recorder.Recorder.stop, "__code__", before)


def _other_default() -> Callable[[], None]:
    before = gates.Gates.reach.__defaults__
    gates.Gates.reach.__defaults__ = (1, 1)
    return lambda: setattr(gates.Gates.reach, "__defaults__", before)


def _another_base() -> Callable[[], None]:
    before = probe_parts.ProbePort.__bases__
    type.__setattr__(probe_parts.ProbePort, "__bases__", (type("Before", before, {}),))
    return lambda: type.__setattr__(probe_parts.ProbePort, "__bases__", before)


@pytest.mark.parametrize(
    ("change", "name"),
    [
        (put(recorder.Recorder, "record", lambda *given, **fields: None), f"{SDK}.recorder.Recorder.record"),
        (put(probe, "is_integer", lambda value: True), f"{SDK}.probe.is_integer"),
        (put(recorder, "now", lambda: 1), f"{SDK}.recorder.now"),
        (put(engine, "isinstance", lambda one, kind: isinstance(one, kind)), f"{SDK}.engine.isinstance"),
        (put(engine, "_describe", len), f"{SDK}.engine._describe"),
        (put(seal.Seal, "_broken_object", lambda self, objects: None), f"{SDK}.seal.Seal._broken_object"),
        (put_item(probe._KINDS, (False, False), probe.FragmentProbe), f"{SDK}.probe._KINDS.(False"),
        (put(probe.Probe, "__del__", lambda self: None), f"{SDK}.probe.Probe.__del__"),
        (_another_base, f"{SDK}.probe_parts.ProbePort.__bases__"),
        (_other_code, f"{SDK}.recorder.Recorder.stop"),
        (_other_default, f"{SDK}.gates.Gates.reach"),
        (put(messages, "encode", msgspec.json.encode), "ucm_cts.adapters.contract.messages.encode"),
        (put(trace, "Enter", trace.Exit), "ucm_cts.adapters.contract.trace.Enter"),
        (put(builtins, "getattr", partial(getattr)), "builtins.getattr"),
        (put(threading.Condition, "wait_for", threading.Condition.wait_for.__get__(0)), "threading.Condition.wait_for"),
        (put(threading, "get_ident", lambda: 1), "threading.get_ident"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_is_changed_is_named(change: Callable[[], Callable[[], None]], name: str) -> None:
    assert refusal_of(change, 8) == name
    assert refusal_of(lambda: lambda: None, 8) is None


def test_code_that_takes_the_name_of_the_sdk_is_refused() -> None:
    kept = recorder.Recorder()
    scope = {"__name__": f"{SDK}.recorder", "kept": kept}
    with pytest.raises(TypeError, match="must not change"):
        exec("kept.recording = False", scope)  # noqa: S102 - what cheats do
    seal._refused.clear()


@pytest.mark.parametrize(
    "change",
    [
        put(contextlib, "contextmanager", len),
        put(time, "sleep", lambda seconds: None),
        put(time, "monotonic_ns", lambda: 1),
        put(time, "monotonic", lambda: 1.0),
        put(os, "write", lambda *given: 0),
        put(threading, "_profile_hook", lambda *given: None),
        put(data, "__warningregistry__", {}),
        put(builtins, "_", "a console sets it"),
    ],
)
def test_what_the_sdk_does_not_use_may_change(change: Callable[[], Callable[[], None]]) -> None:
    assert refusal_of(change, 8) is None


def test_what_python_itself_changes_says_what_to_do() -> None:
    assert "let the adapter, or what it loads, leave it as it is" in seal.replaces("threading.get_ident")
