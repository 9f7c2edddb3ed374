"""The protocol and the words of scenarios are those of their pages."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any, get_args

import jsonschema
import msgspec
import pytest
from command_line import ucm_cts
from files import ROOT
from pages import (
    column,
    commands,
    marked,
    shell,
    text_of,
    write_files,
)

from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.probes import load_probe_types
from ucm_cts.harness.purposes.scripts import read_scripts, to_scenario
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.usefixtures("here")
SCHEMA = ROOT / "adapters" / "contract" / "protocol.schema.json"


def test_protocol_is_that_of_the_types() -> None:
    assert shell("python -m ucm_cts.adapters.contract.messages") == SCHEMA.read_text()
    there = {(way, tag) for way, types in (("to", m.ToHost), ("from", m.FromHost)) for tag in tags(types)}
    assert set(column("docs/protocol.md", r"(to|from) host \| `(\w+)`")) == there


def tags(types: Any) -> set[str]:
    return {t.__struct_config__.tag for t in get_args(types) or types}


def answer(message: m.ToHost) -> Any:
    """What a host says, without the times."""
    line = Engine(ReferenceAdapter).answer(m.encode(message))
    return m.from_host_decoder().decode(re.sub(rb'"t":\d+', b'"t":0', line))


def test_conversation_is_one_that_takes_place() -> None:
    lines = marked("docs/protocol.md", "conversation").splitlines()
    for line in lines:
        jsonschema.validate(json.loads(line), json.loads(SCHEMA.read_text()))
    hello, run = (m.to_host_decoder().decode(line) for line in lines[::2])
    assert isinstance(run, m.Run)
    traced: Any
    welcome, traced = (m.from_host_decoder().decode(line) for line in lines[1::2])
    assert contradiction(run.scenario, traced.events) is None
    verdicts = Monitor(load_life_cycle()).judge(run.scenario, traced.events)
    assert verdicts.exercises
    assert not verdicts.findings
    assert hello == m.Hello(m.PROTOCOL)
    assert welcome == msgspec.structs.replace(answer(hello), product="example", version="1.0")
    assert [msgspec.structs.replace(event, t=0) for event in traced.events] == list(answer(run).events)


def test_example_scenario(here: Path) -> None:
    write_files("docs/scenarios.md")
    (command,) = [c for c in commands("ucm-cts replay") if "example.yaml" in c]
    outcome = ucm_cts(*command.split()[1:])
    assert (outcome.status, outcome.err) == (0, "")
    assert "\nno findings" in outcome.out
    (script,) = read_scripts(here / "example.yaml")
    scenario = to_scenario(script)
    trace = answer(m.Run(1, scenario)).events
    assert set(script.exercises) <= set(Monitor(load_life_cycle()).judge(scenario, trace).exercises)


def test_words_of_scenarios() -> None:
    page = " ".join(text_of("docs/scenarios.md").split())
    (probes,) = re.findall(r"probes\.xml` \((.+?)\)", page)
    (hooks,) = re.findall(r"entered at a hook \((.+?)\)", page)
    assert set(probes.split(", ")) == set(load_probe_types())
    assert set(re.findall(r"\w+", hooks)) == set(get_args(s.Hook))
    assert set(re.findall(r"`{do: (\w+)", page)) == tags(s.Action)
    others = set(re.findall(r"`(\w+)`", page.partition("**steps**")[2].partition("`bind`")[0]))
    assert others == tags([step for step in get_args(s.Step) if not issubclass(step, s.ContainerCall)])
