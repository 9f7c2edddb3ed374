"""Measures judging per event: on a trace of a million events, read as a stream, and on the suite's own scenarios."""

from __future__ import annotations

import json
import resource
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import msgspec
from rich.table import Table

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.trace import Event
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.bench.long_life import LongLife
from ucm_cts.harness.bench.measuring import empty_table, limit, medians
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.payloads import Payloads
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.monitor import Monitor

CALLS = 100
"""Calls of the test between two reconnections of the long life; the client passes each one on."""

AIM = 5
"""The limit of judging time, as a multiple of decoding time."""

_BLOCK = 64 * 1024
_ROUNDS = 3
_TIMED = ("paused", "stressed", "counted")
"""Ends of steps that take a fixed time."""

_decoder = msgspec.json.Decoder(Event)
_monitor = Monitor(load_life_cycle())


@dataclass(frozen=True)
class Costs:
    """Costs of judging, in nanoseconds for each event.

    ``what``: the traces.
    ``events``: how many.
    ``reading``: reading the bytes.
    ``decoding``: decoding them.
    ``plain``: decoding by the standard library.
    ``believing``: the integrity checks, without decoding.
    ``judging``: the monitor, without decoding.
    ``grown``: growth of memory in MB; None if unknown.
    """

    what: str
    events: int
    reading: float
    decoding: float
    plain: float
    believing: float
    judging: float
    grown: float | None = None


def of_a_long_life(events: int) -> Costs:
    """Measure judging one long trace that comes as a stream."""
    small = LongLife(2, CALLS)
    life = LongLife(max(2, events // (len(LongLife(3, CALLS)) - len(small))), CALLS)
    scenario = life.scenario()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "trace.jsonl"
        with path.open("wb") as file:
            file.writelines(msgspec.json.encode(event) + b"\n" for event in life.events())

        def judge() -> None:
            assert not _monitor.judge(scenario, _decoded(path)).findings

        def believe() -> None:
            assert contradiction(scenario, _decoded(path)) is None

        before = _most_memory()
        judge()
        grown = _most_memory() - before
        costs = _an_event(
            len(life),
            {
                "reading": lambda: _read(path),
                "decoding": lambda: _exhaust(map(_decoder.decode_lines, _blocks(path))),
                "streaming": lambda: _exhaust(_decoded(path)),
                "plain": lambda: _exhaust(map(json.loads, path.open("rb"))),
                "believing": believe,
                "judging": judge,
            },
        )
    return _net(f"one life of {len(life):,} events", len(life), costs, grown)


def of_the_suite(profile: str) -> Costs:
    """Measure judging the traces of the profile's scenarios one by one, without those in which time passes."""
    answers = list(_answers(profile))
    lines = [line for _, line in answers]
    traced = [(scenario, _events(line), line) for scenario, line in answers]
    events = sum(len(trace) for _, trace, _ in traced)
    decoder = from_host_decoder()

    def decode() -> None:
        for line in lines:
            decoder.decode(line)

    def judge() -> None:
        for scenario, trace, _ in traced:
            _monitor.judge(scenario, trace)

    def believe() -> None:
        for scenario, trace, _ in traced:
            contradiction(scenario, trace)

    costs = _an_event(
        events,
        {
            "reading": lambda: [len(line.split(b"\n")) for line in lines],
            "decoding": decode,
            "plain": lambda: [json.loads(line) for line in lines],
            "believing": believe,
            "judging": judge,
        },
    )
    return Costs(f"{profile}: {len(lines):,} traces", events, **costs)


def table(rows: Iterable[Costs]) -> Table:
    """The costs side by side; the aim is for the long life."""
    heads = "|reading bytes|json|msgspec|integrity check|properties|× msgspec|limit|events/s|MB"
    shown = empty_table("Checking, ns an event", heads)
    for row in rows:
        ratio = row.judging / row.decoding
        shown.add_row(
            row.what,
            f"{row.reading:.0f}",
            f"{row.plain:.0f}",
            f"{row.decoding:.0f}",
            f"{row.believing:.0f}",
            f"{row.judging:.0f}",
            f"{ratio:.1f}",
            limit(AIM, ratio) if row.grown is not None else "",
            f"{1e9 / (row.decoding + row.judging):,.0f}",
            f"+{row.grown:.0f}" if row.grown is not None else "",
        )
    return shown


def _net(what: str, events: int, costs: dict[str, float], grown: float) -> Costs:
    """Streams are read and decoded while they are judged: take that off."""
    streaming = costs.pop("streaming")
    for both in ("believing", "judging"):
        costs[both] -= streaming
    return Costs(what, events, **costs, grown=grown)


def _an_event(events: int, cases: dict[str, Callable[[], object]]) -> dict[str, float]:
    def nanoseconds(action: Callable[[], object]) -> float:
        began = time.process_time()
        action()
        return (time.process_time() - began) / events * 1e9

    return medians({name: lambda action=action: nanoseconds(action) for name, action in cases.items()}, _ROUNDS)  # type: ignore[misc]


def _decoded(path: Path) -> Iterator[Event]:
    """The events of a file, as a stream."""
    for block in _blocks(path):
        yield from _decoder.decode_lines(block)


def _blocks(path: Path) -> Iterator[bytes]:
    """The bytes of a file, whole lines."""
    with path.open("rb") as file:
        while block := b"".join(file.readlines(_BLOCK)):
            yield block


def _read(path: Path) -> None:
    with path.open("rb", buffering=0) as file:
        while file.read(_BLOCK):
            pass


def _exhaust(things: Iterable[object]) -> None:
    for _ in things:
        pass


def _answers(profile: str) -> Iterator[tuple[s.Scenario, bytes]]:
    engine = Engine(ReferenceAdapter)
    disguise, payloads = Disguise(1, ReferenceAdapter.port_element_name), Payloads(1)
    for purpose in load_purposes(profile):
        for _, plain in purpose.draw(1, {}) if purpose.draw else purpose.scenarios:
            if any(step.ends_with in _TIMED or step.thread for step in plain.steps):
                continue
            scenario = disguise.scenario(payloads.deal(plain))
            yield scenario, engine.answer(encode(Run(0, scenario)))


def _events(line: bytes) -> tuple[Event, ...]:
    reply = from_host_decoder().decode(line)
    assert isinstance(reply, Traced)
    return reply.events


def _most_memory() -> float:
    """The most memory that this process has ever had, in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
