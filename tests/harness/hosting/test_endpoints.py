"""A framework has the same traces and verdicts through every endpoint."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest
from endpoint_runs import Seen, in_a_process_of_its_own, sample, through

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Refused, from_host_decoder
from ucm_cts.adapters.contract.trace import Return, Siblings, Trace
from ucm_cts.adapters.reference.cpp import COMMAND

pytestmark = [pytest.mark.native, pytest.mark.usefixtures("here")]

PYTHON = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"


def plain(name: str, trace: Trace) -> list[Any]:
    """Events without what no two runs share: times, and identifiers beyond which is which.

    Where several threads race, the order is left out as well.
    """
    scenario = dict(sample())[name]
    known: dict[int, int] = {}

    def same(identifier: int) -> int:
        return known.setdefault(identifier, len(known))

    events: list[Any] = []
    for event in trace:
        if isinstance(event, Return) and isinstance(scenario.steps[event.step], s.AddComponent | s.Connect):
            assert isinstance(event.value, int)
            event = msgspec.structs.replace(event, value=same(event.value))
        elif isinstance(event, Return) and isinstance(event.value, tuple):
            event = msgspec.structs.replace(event, value=tuple(map(same, event.value)))
        elif isinstance(event, Siblings):
            event = msgspec.structs.replace(event, ids=tuple(map(same, event.ids)))
        fields = msgspec.to_builtins(event)
        for own in ("n", "t", "thread", "detail", "calendar"):
            fields.pop(own, None)
        events.append(fields)
    if any(step.thread for step in scenario.steps):
        events.sort(key=repr)
    return events


def assert_same(one: Seen, other: Seen) -> None:
    assert other.broken == one.broken
    assert other.exercised == one.exercised


def assert_same_traces(one: Seen, other: Seen) -> None:
    assert_same(one, other)
    for name, trace in one.traces.items():
        assert plain(name, other.traces[name]) == plain(name, trace), name


@pytest.fixture(params=["tcp://127.0.0.1:0", "unix"])
def listening(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """The reference framework's executable, already running somewhere."""
    address = f"unix:{tmp_path / 'socket'}" if request.param == "unix" else request.param
    command = [str(COMMAND), "--listen", address]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout
        yield server.stdout.readline().removeprefix("listening on ").strip()
        server.terminate()


STEP = '{"type":"run","id":7,"scenario":{"components":{},"steps":[%s]}}'
PART = '{"type":"run","id":7,"scenario":{"components":{"A":{%s}},"steps":[]}}'
REFUSED: dict[str, int | None] = {
    '{"type":"hello","protocol":3}': None,
    '{"type":"hello","protocol":18446744073709551616}': None,
    '{"type":"run","id":18446744073709551616,"scenario":{"components":{},"steps":[]}}': None,
    '{"type":"run","id":7}': 7,
    '{"type":"run","id":7,"scenario":{"components":{},"steps":[],"patience":18446744073709551616}}': 7,
    STEP % '{"op":"dance"}': 7,
    STEP % '{"op":"invoke","ref":"nil","value":2147483648}': 7,
    PART % '"provides":["p","p"]': 7,
    PART % '"provides":["p"],"requires":["p"]': 7,
    PART % '"plan":{"exchange":[{"do":"return","value":-2147483649}]}': 7,
    "nonsense": None,
}


def test_hosts_refuse_the_same_and_say_which_message() -> None:
    lines = "".join(f"{line}\n\n" for line in REFUSED)
    for command in [COMMAND], [sys.executable, "-m", "ucm_cts.adapters.sdk.python.host", PYTHON]:
        done = subprocess.run(command, input=lines, capture_output=True, text=True, check=True)
        answers = [from_host_decoder().decode(line) for line in done.stdout.splitlines()]
        assert len(answers) == len(REFUSED)
        for answer, (line, number) in zip(answers, REFUSED.items(), strict=True):
            assert isinstance(answer, Refused), line
            assert answer.id == number, line
        assert answers[0] == Refused("the harness speaks protocol 3, this host speaks 2")
        assert all("twice" in answers[n].reason for n in (7, 8))  # type: ignore[union-attr]


def test_the_reference_frameworks_agree_in_verdicts_and_exercised_requirements() -> None:
    python = through("reference-py")
    assert python.broken == {}
    assert len(python.exercised) > 70, "the sample reaches nearly every requirement"
    assert_same(python, through("reference-cpp"))


def test_executable_and_extension_module_give_the_same_traces() -> None:
    assert_same_traces(through("reference-cpp"), through("reference-cpp-module"))


def test_executable_that_is_already_running(listening: str) -> None:
    assert_same_traces(through("reference-cpp"), through.__wrapped__(listening))


@pytest.mark.parametrize("endpoint", ["reference-py", "reference-cpp-module", "subjects:stops_in_startup_order"])
def test_in_process_and_in_a_host(endpoint: str) -> None:
    assert_same_traces(through(endpoint), in_a_process_of_its_own(endpoint))
    if endpoint.startswith("subjects"):
        assert {r for broken in through(endpoint).broken.values() for r in broken} == {"R-11.2.2.1-13"}
