"""Runs scenarios on a Python adapter in this process and writes the trace in short lines."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import msgspec

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.messages import FromHost, Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Event
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.execution.confirmation import is_timed
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.verdicts import Verdicts

SINK = {"provides": ["in"]}
SOURCE = {"requires": ["out"], "connectable": True}


def gist(findings: Sequence[Finding]) -> list[object]:
    """What findings say, but for names."""
    return [(f.requirement, f.rule, f.events, f.step) for f in findings]


def scenario(components: dict[str, Any], steps: list[str], patience: int = 2000) -> Scenario:
    """Steps are written ``operation key=value ...``."""
    read = []
    for step in steps:
        op, *fields = step.split()
        pairs = [field.split("=") for field in fields]
        values: dict[str, int | str] = {key: int(value) if key == "value" else value for key, value in pairs}
        read.append({"op": op, **values})
    return msgspec.convert({"components": components, "steps": read, "patience": patience}, Scenario)


def answer(asked: Scenario, adapter: type[Adapter] = ReferenceAdapter) -> FromHost:
    return from_host_decoder().decode(Engine(adapter).answer(encode(Run(7, asked))))


def judged(monitor: Monitor, asked: Scenario) -> Verdicts:
    """What ``monitor`` says of the reference framework. A scenario whose only findings are of 10.5 and depend on time is run
    again, three times at most, as a run of the suite does.
    """
    for _ in range(3):
        traced = answer(asked)
        assert isinstance(traced, Traced), traced
        assert contradiction(asked, traced.events, traced.stuck) is None
        verdicts = monitor.judge(asked, traced.events)
        if not verdicts.findings or not all(
            is_timed(f) and f.requirement.startswith("R-10.5") for f in verdicts.findings
        ):
            break
    return verdicts


def play(
    components: dict[str, Any], steps: list[str], adapter: type[Adapter] = ReferenceAdapter, patience: int = 2000
) -> list[str]:
    asked = scenario(components, steps, patience)
    traced = answer(asked, adapter)
    assert isinstance(traced, Traced), traced
    assert contradiction(asked, traced.events, traced.stuck) is None
    return [line_of(event) for event in traced.events] + [f"stuck {name}" for name in traced.stuck]


def line_of(event: Event) -> str:
    fields = msgspec.to_builtins(event)
    kind = fields.pop("kind")
    thread = fields.pop("thread")
    for name in ("n", "t", "detail"):
        fields.pop(name, None)
    words = [kind if not thread else f"{thread}:{kind}"]
    if "component" in fields:
        words.append(f"{fields.pop('component')}#{fields.pop('instance')}")
    return " ".join([*words, *(f"{name}={_text_of(value)}" for name, value in fields.items())])


def _text_of(value: Any) -> str:
    if isinstance(value, dict) and "component" in value:
        return f"{value['component']}#{value['instance']}.{value['port']}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_text_of(v["references"]) + "@" + v["port"] if isinstance(v, dict) and "references" in v else _text_of(v) for v in value) + "]"  # fmt: skip
    return str(value)


def outcomes(trace: list[str]) -> list[str]:
    return [line for line in trace if re.match(r"return|raise|skip", line)]


def hooks(trace: list[str]) -> list[str]:
    return [m[1] + "." + m[2] for line in trace if (m := re.match(r"enter (\w+)#\d+ hook=(\w+)", line))]
