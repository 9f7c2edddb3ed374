"""The records read back from the trace, compared with the records that it must have (10.1.4.2).

Records are distinguished by their texts. One that is not the text of a message is of a traced call if it contains the name of
its method, and it is a message that was altered if it contains the name that this message begins with.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Policy
from ucm_cts.adapters.contract.trace import Call, LogRecord, Return
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.service_policies import policy_elements, port_traces

COMMON_SEVERITIES = ("debug", "info", "warning", "error")
_SEVERITIES = {"model-6": ("trace", *COMMON_SEVERITIES, "critical"), "idl-5": (*COMMON_SEVERITIES, "fatal")}
_RANKS = {"trace": 0, "debug": 1, "info": 2, "warning": 3, "error": 4, "critical": 5, "fatal": 5}
_NARROW = 255
_SHORTEST_NAME = 4


@dataclass(frozen=True)
class Threshold:
    """Which severities there are, as far as that is known, and which of them the vendor says are recorded."""

    severities: tuple[str, ...]
    least: str

    @classmethod
    def declared(cls, ics: Ics) -> Threshold:
        """What the vendor declares; without a threshold every severity is recorded."""
        return cls(_SEVERITIES.get(ics.reading("log-severity-set"), COMMON_SEVERITIES), ics.reading("log-threshold"))

    def knows(self, severity: str) -> bool:
        """Is it certain that there is such a severity?"""
        return severity in self.severities

    @property
    def records_all(self) -> bool:
        """Is every severity recorded?"""
        return self.least not in _RANKS

    def records(self, severity: str) -> bool:
        """Is it recorded?"""
        return _RANKS.get(severity, 0) >= _RANKS.get(self.least, 0)


@dataclass(frozen=True, slots=True)
class LogReading:
    """The log was read from ``begin`` to ``end``; ``in_vain`` says that the step waited for more records than came."""

    begin: Call
    end: Return
    in_vain: bool

    @property
    def records(self) -> tuple[LogRecord, ...]:
        """The records that it has."""
        return self.end.records or ()


@dataclass(slots=True, eq=False)
class Message:
    """A message that a body wrote, or was to write. ``due`` messages have their record in the log sooner or later, ``barred`` ones,
    which are below the threshold, have none; of others nothing is known.
    """

    call: MethodCall
    severity: str
    text: str
    due: bool
    barred: bool
    record: LogRecord | None = None
    altered: LogRecord | None = None

    @property
    def is_narrow(self) -> bool:
        """Can it be written under every reading of messages: ASCII, up to 255 characters, not empty?"""
        return self.text.isascii() and 0 < len(self.text) <= _NARROW


@dataclass(slots=True, eq=False)
class Tracing:
    """Calls of ``method`` that are traced: each time, at one of its two ends, by one policy. ``due`` of them have their
    record in the log sooner or later, ``possible`` ones may have one, ``barred`` ones are below the threshold. ``others`` are
    ends of such calls that are not traced. ``ports`` says how many are due where, ``severities`` which severities were configured.
    """

    method: str
    due: int = 0
    possible: int = 0
    barred: int = 0
    others: int = 0
    ports: Counter[tuple[str, str]] = field(default_factory=Counter)
    severities: set[str] = field(default_factory=set)
    records: list[LogRecord] = field(default_factory=list)

    @property
    def most(self) -> int:
        """The largest number of traced calls under any threshold."""
        return self.due + self.possible + self.barred

    @property
    def pairs(self) -> set[int]:
        """How many calls can have a second record, for their return, as every port has them or has none."""
        sums = {0}
        for number in self.ports.values():
            sums |= {total + number for total in sums}
        return sums

    @property
    def is_traced(self) -> bool:
        """Has some call of it been traced?"""
        return bool(self.ports)


@dataclass(slots=True, eq=False)
class Contents:
    """Everything about one reading of the log.

    ``surplus``: records of messages that have theirs already.
    ``strays``: records of no known message or call.
    """

    reading: LogReading
    messages: list[Message]
    tracings: dict[str, Tracing]
    surplus: list[tuple[Message, LogRecord]] = field(default_factory=list)
    strays: list[LogRecord] = field(default_factory=list)

    @property
    def step(self) -> int:
        """The step that read the log."""
        return self.reading.end.step

    @property
    def events(self) -> tuple[int, int]:
        """Begin and end of the reading."""
        return self.reading.begin.n, self.reading.end.n

    def events_of(self, message: Message) -> tuple[int, int]:
        """Where ``message`` was written, and the end of the reading."""
        return message.call.request.n, self.reading.end.n

    @property
    def missing(self) -> list[Message]:
        """Messages whose record a step waited for in vain."""
        if not self.reading.in_vain:
            return []
        return [m for m in self.messages if m.due and m.record is None and m.altered is None]


def log_readings(runtime: ObservedRuntime) -> list[LogReading]:
    """Each time that the log was read so far."""
    return [
        LogReading(o.begin, o.end, len(o.end.records) < o.step.records)
        for o in runtime.interactions.operations
        if isinstance(o.step, s.ReadLog) and isinstance(o.end, Return) and o.end.records is not None
    ]


def contents_read(runtime: ObservedRuntime, event: Return) -> Contents | None:
    """The contents of the log as the step that ``event`` ends has read it; None if that step does not read it."""
    reading = next((reading for reading in log_readings(runtime) if reading.end is event), None)
    return contents_of(reading, runtime) if reading is not None else None


def contents_of(reading: LogReading, runtime: ObservedRuntime) -> Contents:
    """The records that ``reading`` found, with the messages and calls they belong to."""
    contents = Contents(reading, list(_messages(reading, runtime)), _tracings(reading, runtime))
    for record in _without_messages(contents):
        named = [method for method in contents.tracings if method in record.message]
        if named:  # of names that are parts of others the whole one is meant
            contents.tracings[max(named, key=len)].records.append(record)
        elif not _is_altered(contents, record):
            contents.strays.append(record)
    return contents


def _messages(reading: LogReading, runtime: ObservedRuntime) -> Iterator[Message]:
    threshold = Threshold.declared(runtime.ics)
    for call in runtime.interactions.calls:
        request, reply = call.request, call.reply
        elements = policy_elements(runtime.scenario.components.get(request.component), s.COMPONENT_TRACE)
        arguments = request.arguments or ()
        if request.port not in elements or len(arguments) != 2 or request.n > reading.end.n:
            continue
        severity, text = (str(argument) for argument in arguments)
        over = reply is not None and reply.n < reading.begin.n and not reply.failed
        known = over and threshold.knows(severity)
        records = threshold.records(severity)
        yield Message(call, severity, text, known and records, known and not records)


def _without_messages(contents: Contents) -> list[LogRecord]:
    """Give messages their records; those that are of none are returned."""
    by_text: dict[str, list[Message]] = {}
    for message in contents.messages:
        by_text.setdefault(message.text, []).append(message)
    rest, late = [], []
    for record in contents.reading.records:
        if record.message not in by_text:
            rest.append(record)
            continue
        of_text = by_text[record.message]
        own = [m for m in of_text if m.record is None and m.severity == record.severity]
        if own:
            _first(own).record = record
        else:
            late.append(record)
    for record in late:  # none is left of its severity: it belongs to another one, or to none
        of_text = by_text[record.message]
        free = [m for m in of_text if m.record is None and not m.barred]
        if free:
            _first(free).record = record
        else:
            contents.surplus.append((of_text[0], record))
    return rest


def _first(messages: list[Message]) -> Message:
    """Those that must have a record come before those that may have one."""
    return min(messages, key=lambda message: not message.due)


def _is_altered(contents: Contents, record: LogRecord) -> bool:
    """Is it what became of a message?"""
    known = record.message.casefold()
    alike = [m for m in contents.messages if len(_name(m)) >= _SHORTEST_NAME and _name(m) in known]
    bare = [m for m in alike if m.record is None and m.altered is None]
    if bare:
        _first(bare).altered = record
    elif alike:
        contents.surplus.append((alike[0], record))
    return bool(alike)


def _name(message: Message) -> str:
    """The word that a message begins with."""
    found = re.match(r"[a-z]*", message.text.casefold())
    return found[0] if found is not None else ""


def _tracings(reading: LogReading, runtime: ObservedRuntime) -> dict[str, Tracing]:
    """All methods that were called through port elements of bodies, by name."""
    threshold = Threshold.declared(runtime.ics)
    tracings: dict[str, Tracing] = {}
    for component, port, method, begin, end in _ends(runtime):
        if begin > reading.end.n:
            continue
        tracing = tracings.setdefault(method, Tracing(method))
        policies = port_traces(runtime.scenario.components.get(component), port, method)
        if not policies:
            tracing.others += 1
        for policy in policies:
            over = end is not None and end < reading.begin.n
            tracing.ports[component, port] += _add(tracing, policy, over, threshold)
    return tracings


def _add(tracing: Tracing, policy: Policy, over: bool, threshold: Threshold) -> bool:
    """A call is traced by this policy; returns whether its record is due. Without parameters it may have any severity."""
    severity = policy.parameters.get(s.LOG_SEVERITY, "")
    if policy.parameters:
        tracing.severities.add(severity)
    if not over or not (threshold.knows(severity) if policy.parameters else threshold.records_all):
        tracing.possible += 1
    elif threshold.records(severity):
        tracing.due += 1
        return True
    else:
        tracing.barred += 1
    return False


def _ends(runtime: ObservedRuntime) -> Iterator[tuple[str, str, str, int, int | None]]:
    """Component, port and method of each call, at either end, with when it began and, if all went well, when it was over."""
    components = runtime.scenario.components
    for call in runtime.interactions.calls:
        request, reply = call.request, call.reply
        declaration = components.get(request.component)
        if declaration is not None and request.port in declaration.requires and request.method is not None:
            over = reply.n if reply is not None and not reply.failed else None
            yield request.component, request.port, request.method, request.n, over
    for delivery in runtime.interactions.deliveries:
        enter, end = delivery.enter, delivery.exit
        over = end.n if end is not None and not end.failed else None
        yield enter.component, enter.port or "", enter.method or "", enter.n, over
    for call in runtime.interactions.calls:  # the body may not have been entered yet, or never
        method = call.request.method or ""
        for member, port in call.goals:
            if port_traces(components.get(member.component), port, method) and not call.delivered_to(member, port):
                yield member.component, port, method, call.request.n, None


def severities_shown(records: Iterable[LogRecord]) -> str:
    """How often which severity is there, for people."""
    return ", ".join(
        f"{number} {severity}" for severity, number in sorted(Counter(r.severity for r in records).items())
    )
