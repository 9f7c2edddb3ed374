"""Message types in other languages are what the generator makes of the schema, and every message survives them."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec
import pytest
from cpp_builds import SDK, STRICT, run
from files import ROOT, SUPPORT
from protocol_messages import Samples

from ucm_cts.adapters.contract import generating
from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract.schema_types import Protocol

PROTOCOL = Protocol(json.loads(generating.SCHEMA.read_text()))


def test_schema_is_that_of_the_types() -> None:
    assert json.loads(generating.SCHEMA.read_text()) == json.loads(msgspec.json.encode(m.protocol_schema()))


@pytest.mark.parametrize("path", generating.FILES, ids=lambda path: path.name)
def test_committed_files_equal_generated_ones(path: Path) -> None:
    committed = ROOT / "adapters" / "sdk" / path.relative_to(generating.SDK)  # an installed package leaves them out
    assert committed.read_text() == generating.rendered(generating.FILES[path])


@pytest.mark.native
def test_every_message_survives_cpp(tmp_path: Path) -> None:
    source = tmp_path / "round_trip.cpp"
    source.write_text(generating.rendered("round_trip.cpp.jinja", [SUPPORT / "native"]))
    run(["g++", *STRICT, "-O0", "-I", SDK / "include", source, "-pthread", "-o", tmp_path / "round_trip"])
    samples = Samples(PROTOCOL)
    asked = [samples.message("to_host", one.name) for one in PROTOCOL.unions["to_host"].alternatives]
    events = [samples.message("Event", one.name) for one in PROTOCOL.unions["Event"].alternatives]
    answers = [samples.message("from_host", one.name) for one in PROTOCOL.unions["from_host"].alternatives]
    for event in events:
        answers.append({"type": "event", "id": 1, "event": event})
    for message in asked:
        m.to_host_decoder().decode(json.dumps(message))
    for message in answers:
        m.from_host_decoder().decode(json.dumps(message))
    sent = [*asked, *events, *answers]
    done = run([tmp_path / "round_trip"], input="".join(json.dumps(one) + "\n" for one in sent))
    got = [json.loads(line) for line in done.stdout.splitlines()]
    by_recorder = {"n", "t", "thread"}
    for before, after in zip(sent, got, strict=True):
        if "kind" in before:
            before = {name: value for name, value in before.items() if name not in by_recorder}
            after = {name: value for name, value in after.items() if name not in by_recorder}
        assert after == before
