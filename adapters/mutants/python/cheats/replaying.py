"""Hosts that cheat: they record an honest framework in one run, and send its traces again with new names in later runs.

A host that answers messages itself is a module with a function ``answer``; those of this cheat are the modules
``replays_*.py`` beside this one.
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar, Literal

from ucm_cts.adapters import contract
from ucm_cts.adapters.mutants.python.cheats.adapters import before
from ucm_cts.adapters.mutants.python.life_cycle import containers
from ucm_cts.adapters.mutants.python.registry import CHEATS, CONTAINER, Cheat
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine

_SCHEMA = Path(contract.__file__).with_name("protocol.schema.json")
_PROTOCOL = frozenset(re.findall(r'"([^"]*)"', _SCHEMA.read_text()))
"""All words of the protocol: what else is between quotes are names, which differ in each run."""

_DISGUISED = re.compile(r'(?<=")[^"\\]{5,}(?=")|-?\b\d{10}\b')
"""Names and payloads that differ in each run, and words of the protocol."""

Times = Literal["old", "new", "lived through"]


class Player:
    """Answers messages as a host does. While ``rehearsing`` it runs the reference framework and keeps the traces; later it
    sends these again. For unknown scenarios it runs a framework that stops in the wrong order.

    Events have their ``old`` times or ``new`` ones; or the host waits until as much time has passed (``lived through``).
    """

    memory: ClassVar[dict[str, str]] = {}

    def __init__(self, times: Times) -> None:
        self.times = times
        self.rehearsing = True
        self._honest = Engine(ReferenceAdapter)
        self._wrong = Engine(before(containers.stops_in_startup_order))

    def answer(self, line: bytes, emit: Callable[[bytes], object]) -> bytes:
        """The answer to one message."""
        message = json.loads(line)
        if message["type"] != "run" or message.get("stream"):
            return self._wrong.answer(line, emit)
        shape, names = _template(json.dumps(message["scenario"]), [])
        if self.rehearsing:
            answer = self._honest.answer(line, emit)
            if json.loads(answer)["type"] == "trace":
                self.memory[shape] = _template(answer.decode(), names, tuple(names))[0]
            return answer
        known = self.memory.get(shape)
        if known is None:
            return self._wrong.answer(line, emit)
        trace: dict[str, Any] = {**json.loads(_filled(known, names)), "id": message["id"]}
        self._set_times(trace["events"])
        return json.dumps(trace).encode()

    def _set_times(self, events: list[dict[str, Any]]) -> None:
        if self.times == "old" or not events:
            return
        later = time.monotonic_ns() - events[0]["t"]
        if self.times == "lived through":
            time.sleep((events[-1]["t"] - events[0]["t"]) / 1e9)
        for event in events:
            event["t"] += later


def _template(text: str, names: list[str], known: tuple[str, ...] | None = None) -> tuple[str, list[str]]:
    """``text`` with numbers in place of names and payloads that differ in each run, and these names. If ``known`` names are
    given, no others are replaced.
    """

    def number(found: re.Match[str]) -> str:
        name, sign = found.group(), ""
        if name in _PROTOCOL:
            return name
        if name.lstrip("-").isdigit():
            value = int(name)
            name, sign = str(max(value, ~value)), "~" if value < 0 else ""
        if known is not None and name not in known:
            return found.group()
        if name not in names:
            names.append(name)
        return f"<{sign}{names.index(name)}>"

    inside = "|".join(sorted(map(re.escape, known or ()), key=len, reverse=True))
    return re.sub(f"{_DISGUISED.pattern}|{inside}" if inside else _DISGUISED, number, text), names


def _filled(template: str, names: list[str]) -> str:
    def name(found: re.Match[str]) -> str:
        own = names[int(found.group(2))]
        return str(~int(own)) if found.group(1) else own

    return re.sub(r"<(~?)(\d+)>", name, template)


def plays(
    name: str, lie: str, *detected_by: str, clauses: tuple[str, ...] = CONTAINER, or_else: tuple[str, ...] = ()
) -> None:
    """Register the module ``name`` of this package as a cheat."""
    lie = " ".join(lie.split())
    CHEATS[name] = Cheat(name, f"{__package__}.{name}", lie, detected_by, clauses, rehearsals=1, or_else=or_else)
