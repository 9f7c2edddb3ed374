"""The record of one run: every scenario with its whole trace, as a value and as a file that people can read.

The file has one JSON document a line: the heading, the distinct events (without number and time), the distinct scenarios as hosts got
them, and then the entries in the order in which they happened. An entry names its scenario and its events by their places in these lists.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import Annotated

import msgspec

from ucm_cts.adapters.contract.messages import Welcome
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Event, Trace
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Incident, Isolation

FORMAT = 2
"""The format of records that this suite writes and reads."""

MOST_BYTES = 128 << 20
"""Bytes that the file of a record may have; that of profile core has about 25 million."""

MOST_ENTRIES = 200_000
MOST_EVENTS = 10_000_000
MOST_IN_TRACE = 1_000_000

MOST_AHEAD = 2_000
"""Scenarios that may be asked for before they are answered: those on their way to a host, each after some that are left out."""

LONGEST_LINE = 2_000
"""Characters of any text that a record has for people."""

_Index = Annotated[int, msgspec.Meta(ge=0, le=MOST_EVENTS)]
_Milliseconds = Annotated[int, msgspec.Meta(ge=0, le=10**12)]
_Text = Annotated[str, msgspec.Meta(max_length=LONGEST_LINE)]
_Count = Annotated[int, msgspec.Meta(ge=0, le=2**31)]
_Step = Annotated[int, msgspec.Meta(ge=-(2**62), le=2**62)]


class RecordError(Exception):
    """The record cannot be read. The message is one line."""


class Entry(Value, frozen=True, tag_field="is"):
    """Something that a driver told. ``at``: milliseconds since the run began."""

    at: _Milliseconds


class Performed(Entry, frozen=True):
    """Common to entries of one scenario and its trace.

    ``name``: the name of the scenario.
    ``scenario``: its place among the scenarios.
    ``events``: of the trace, by their places among the events.
    ``times``: nanoseconds since the event before, for the first one since the last event of the record.
    ``stuck``: the workers that never came back.
    """

    name: _Text
    scenario: _Index
    events: tuple[_Index, ...] = ()
    times: tuple[_Step, ...] = ()
    stuck: tuple[_Text, ...] = ()


class Answered(Performed, frozen=True, tag="answer"):
    """The answer to a scenario of the run.

    ``drawn``: how many scenarios had been asked for since the answer before.
    ``incident``: what went wrong with the host; ``is_whole``: the trace is complete, although threads never came back.
    ``apart``: its calls were made on threads of their own.
    """

    drawn: Annotated[int, msgspec.Meta(ge=0, le=MOST_AHEAD)] = 1
    incident: Incident | None = None
    is_whole: bool = False
    apart: bool = False


class Repeated(Performed, frozen=True, tag="again"):
    """A second look: the same scenario in other circumstances (``Circumstances``). It has no events if there is no trace that can be
    believed.
    """

    patience: Annotated[float, msgspec.Meta(ge=0, le=1000)] = 1
    one_core: bool = False
    after: Annotated[int, msgspec.Meta(ge=0, le=1_000_000)] = 0


class Usage(Value, frozen=True):
    """What the host's process holds: ``threads``, and open ``files``."""

    threads: _Count
    files: _Count


class InSeries(Performed, frozen=True, tag="series"):
    """A scenario run again on the same host, and what the host's process held then, if that can be counted."""

    usage: Usage | None = None


class SeriesCut(Entry, frozen=True, tag="series cut"):
    """The host gave no trace when a scenario was run again and again."""


class Counted(Entry, frozen=True, tag="usage"):
    """What the process of the host held last, when it had been given time."""

    usage: Usage


class Stood(Entry, frozen=True, tag="gap"):
    """The machine stood still for so many ``milliseconds`` while the last trace that was asked about came about."""

    milliseconds: _Milliseconds


class Contended(Entry, frozen=True, tag="contention"):
    """Threads of the machine waited so many ``milliseconds`` for a processor while the last trace that was asked about came about."""

    milliseconds: _Milliseconds


class UsedUp(Entry, frozen=True, tag="time used up"):
    """The time for second looks was used up."""


class Shorter(Performed, frozen=True, tag="shorter"):
    """The shortest scenario with a failure that was found; the report shows it. No verdict rests on it.

    ``cause``: of the failure.
    ``plain``: the scenario as it is written; ``words``: the names and payloads of its disguise.
    """

    cause: tuple[_Text, _Text, _Text] = ("", "", "")
    plain: Scenario = Scenario({}, ())
    words: dict[str, str] = {}
    incident: Incident | None = None
    is_whole: bool = False


AnyEntry = Answered | Repeated | InSeries | SeriesCut | Counted | Stood | Contended | UsedUp | Shorter


class Heading(Value, frozen=True):
    """What the driver says of the run as a whole.

    ``seed``: names and payloads were drawn from it.
    ``started``: when the run began, ISO 8601.
    ``isolation``, ``adapter``, ``adapter_file`` and ``warnings`` are as in the report.
    """

    format: int
    seed: int
    identity: Welcome
    adapter: _Text
    started: Annotated[str, msgspec.Meta(max_length=40)]
    isolation: Isolation
    adapter_file: _Text = ""
    warnings: tuple[_Text, ...] = ()


class Record(Value, frozen=True):
    """All that happened in a run.

    ``events``: each that is different, with ``n`` and ``t`` 0. ``scenarios``: each that is different, as JSON.
    """

    heading: Heading
    events: tuple[Event, ...]
    scenarios: tuple[msgspec.Raw, ...]
    entries: tuple[AnyEntry, ...]

    def performed(self) -> Iterator[tuple[Performed, Trace]]:
        """Each entry of a scenario, with its trace: for readers."""
        last = 0
        for entry in self.entries:
            if isinstance(entry, Performed):
                trace = self.trace(entry, last)
                last = trace[-1].t if trace else last
                yield entry, trace

    def trace(self, entry: Performed, last: int) -> Trace:
        """The trace of ``entry``; ``last`` is the time of the last event before it."""
        events, replace = self.events, msgspec.structs.replace
        times = itertools.islice(itertools.accumulate(entry.times, initial=last), 1, None)
        return tuple(
            [replace(events[index], n=n, t=t) for n, (index, t) in enumerate(zip(entry.events, times, strict=True), 1)]
        )

    def scenario(self, entry: Performed) -> bytes:
        """The scenario of ``entry`` as its host got it, as JSON."""
        return bytes(self.scenarios[entry.scenario])


def encoded(record: Record) -> bytes:
    """``record`` as a file."""
    encode = msgspec.json.encode
    lines = [encode(record.heading), encode(record.events), encode(record.scenarios), *map(encode, record.entries)]
    return b"\n".join(lines) + b"\n"


_decode_heading = msgspec.json.Decoder(Heading).decode
_decode_events = msgspec.json.Decoder(tuple[Event, ...]).decode
_decode_scenarios = msgspec.json.Decoder(tuple[msgspec.Raw, ...]).decode
_decode_entries = msgspec.json.Decoder(AnyEntry).decode_lines


def decoded(data: bytes) -> Record:
    """The record in the file that holds ``data``. Raises ``RecordError``; ``data`` may be anything."""
    if len(data) > MOST_BYTES:
        raise RecordError(f"the record has more than {MOST_BYTES >> 20} MiB")
    heads = data.split(b"\n", 3)
    if len(heads) < 4:
        raise RecordError("the record has fewer than four lines: heading, events, scenarios and entries")
    if heads[3].count(b"\n") > MOST_ENTRIES:
        raise RecordError(f"the record has more than {MOST_ENTRIES} entries")
    line = "the heading"
    try:
        heading = _decode_heading(heads[0])
        line = "the list of events"
        events = _decode_events(heads[1])
        line = "the list of scenarios"
        scenarios = _decode_scenarios(heads[2])
        line = "an entry"
        record = Record(heading, events, scenarios, tuple(_decode_entries(heads[3])))
        line = "the record"
        again = encoded(record)
    except (msgspec.MsgspecError, UnicodeError, RecursionError, OverflowError, MemoryError) as error:
        raise RecordError(f"{line} cannot be read: {one_line(str(error), 120)}") from None
    if heading.format != FORMAT:
        raise RecordError(f"the record has format {heading.format}, and this suite reads format {FORMAT}")
    problem = _problem_of_tables(record)
    if problem:
        raise RecordError(problem)
    if again != data:
        raise RecordError("the record is not written as this suite writes it: another encoder has written it")
    return record


def _problem_of_tables(record: Record) -> str:
    """What is wrong with the lists or with what entries name in them; empty if nothing is."""
    if any(event.n or event.t for event in record.events):
        return "the list of events has one with a number or a time"
    performed = [entry for entry in record.entries if isinstance(entry, Performed)]
    if sum(len(entry.events) for entry in performed) > MOST_EVENTS:
        return f"the record has more than {MOST_EVENTS} events"
    last = 0
    for number, entry in enumerate(performed, 1):
        if len(entry.events) > MOST_IN_TRACE:
            return f"scenario {number} ('{one_line(entry.name, 60)}') has more than {MOST_IN_TRACE} events"
        if len(entry.events) != len(entry.times):
            return f"scenario {number} ('{one_line(entry.name, 60)}') has {len(entry.events)} events and {len(entry.times)} times"
        times = list(itertools.accumulate(entry.times, initial=last))
        last = times[-1]
        if min(times) < -(2**63) or max(times) >= 2**63:
            return f"scenario {number} ('{one_line(entry.name, 60)}') has a time that no clock shows"
    named = itertools.chain.from_iterable(entry.events for entry in performed)
    return (
        _unordered(named, len(record.events), "events")
        or _unordered((entry.scenario for entry in performed), len(record.scenarios), "scenarios")
        or ("" if len(set(map(bytes, record.scenarios))) == len(record.scenarios) else "a scenario is listed twice")
    )


def _unordered(named: Iterator[int], length: int, what: str) -> str:
    """Why ``named`` are not the places of a list in which each stands where it is named first; empty if they are."""
    met = 0
    for index in named:
        if index >= met:
            if index > met or index >= length:
                return f"an entry names the {what} in another order than they are listed, or one that is not"
            met += 1
    return "" if met == length else f"the list of {what} has {length - met} that no entry names"


def places_of(table: dict[bytes, int], keys: Sequence[bytes]) -> tuple[int, ...]:
    """The places of ``keys`` in ``table``, which grows."""
    return tuple(table.setdefault(key, len(table)) for key in keys)
