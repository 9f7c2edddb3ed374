"""A host that plays the reference framework and does not tell the truth: every third answer is changed as ``$LIES`` says.

``$LIES`` is JSON: a list of lies, each a kind and two numbers. With ``$DIES`` the host tells its lies event by event and
ends, as if the framework had crashed.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from typing import Any

from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine

KINDS = ("drop", "repeat", "swap", "cut", "field", "step", "thread", "instance", "stuck")
ODD: tuple[Any, ...] = (None, -1, 0, 10**18, 10**30, "x", "", [], {}, True, "opaque", 1.5, [1], "\x1b[31m\x00")

_ENGINE = Engine(ReferenceAdapter)


def answer(line: bytes, emit: Callable[[bytes], object]) -> bytes:
    message = json.loads(line)
    if message["type"] == "hello" or message["id"] % 3:
        return _ENGINE.answer(line, emit)
    trace = json.loads(_ENGINE.answer(line))
    if "events" not in trace:
        return json.dumps(trace).encode()
    _tell(json.loads(os.environ["LIES"]), trace)
    if message.get("stream") or "DIES" in os.environ:
        for event in trace["events"] if message.get("stream") else ():
            emit(json.dumps({"type": "event", "id": message["id"], "event": event}).encode() + b"\n")
        if "DIES" in os.environ:
            os._exit(3)
    return json.dumps(trace).encode()


def _tell(lies: list[tuple[str, int, int]], trace: dict[str, Any]) -> None:
    events: list[Any] = trace["events"]
    for kind, one, other in lies:
        if not events:
            return
        first, second = one % len(events), other % len(events)
        if kind == "drop":
            del events[first]
        elif kind == "repeat":
            events.insert(second, dict(events[first]))
        elif kind == "swap":
            events[first], events[second] = events[second], events[first]
        elif kind == "cut":
            del events[first:]
        elif kind == "field":
            names = sorted(events[first])
            events[first][names[other % len(names)]] = ODD[other % len(ODD)]
        elif kind == "stuck":
            trace["stuck"] = ["w"]
        elif kind in events[first]:
            events[first][kind] = other
    for number, event in enumerate(events, 1):
        if lies[0][1] % 8 and {"n", "t"} <= event.keys():
            event["n"] = event["t"] = number
