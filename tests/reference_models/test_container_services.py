"""Clock and trace (10.1.4): frameworks whose vendors declare their readings, and traces that show too little for a verdict."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import msgspec
import pytest
from performing import answer

from ucm_cts.adapters.contract.adapter import NotOffered
from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.programming_model import Implementation, UcmError
from ucm_cts.adapters.contract.scenario import PORT_TRACE, Policy, Scenario
from ucm_cts.adapters.contract.trace import Event, LogRecord, Paused, Reply, Request, Return
from ucm_cts.adapters.mutants.python.registry import Base, bind
from ucm_cts.adapters.mutants.python.variants import clocks_and_traces as variants
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.model.clock_readings import SECOND, passed
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.verdicts import Verdicts

pytestmark = pytest.mark.slow

Adapter = type[ReferenceAdapter]
MILLISECOND = 1_000_000


class has_the_severities_of_idl(Base):
    """There is no trace and no critical, and there is fatal."""

    severities = ("debug", "info", "warning", "error", "fatal")


class ignores_what_is_not_severe(Base):
    """Nothing below info is recorded."""

    def _write(self, record: tuple[str, str]) -> None:
        if record[0] != "debug":
            super()._write(record)


class takes_short_texts_only(Base):
    """Messages have 255 narrow characters."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if len(message) > 255 or not message.isascii():
            raise UcmError("no such message")
        super()._log(member, severity, message)


class traces_whole_components(Base):
    """port_trace is a policy of components."""

    def _check_service(self, implementation: Implementation, policy: Policy) -> None:
        if policy.definition != PORT_TRACE:
            super()._check_service(implementation, policy)
        elif policy.port is not None:
            raise UcmError("port_trace is for components")

    def _port_traces(self, member: Member, port: str) -> list[Policy]:
        return [p for p in member.implementation.policies if p.definition == PORT_TRACE]


DECLARED: dict[str, tuple[type, dict[str, str]]] = {
    "six severities": (Base, {"log-severity-set": "model-6"}),
    "five severities": (has_the_severities_of_idl, {"log-severity-set": "idl-5"}),
    "threshold": (ignores_what_is_not_severe, {"log-threshold": "info"}),
    "narrow": (takes_short_texts_only, {"log-message": "narrow-255"}),
    "several methods": (Base, {"methods-to-trace": "list"}),
    "of components": (traces_whole_components, {"port-trace-applicability": "onComponent"}),
    "calls": (Base, {"port-trace-records": "call"}),
    "calls and returns": (variants.writes_calls_and_returns, {"port-trace-records": "call-and-return"}),
    "unix": (Base, {"clock-epoch": "unix"}),
    "monotonic": (variants.has_monotonic_clocks, {"local-clock": "monotonic"}),
}


def purposes(readings: Mapping[str, str]) -> Iterator[tuple[str, tuple[str, ...], list[Scenario]]]:
    declared = [f"{option}={value}" for option, value in readings.items()]
    for purpose in load_purposes("core", *declared):
        if purpose.clause.startswith("10.1.4"):
            yield purpose.id, purpose.requirements, [scenario for _, scenario in purpose.scenarios]


def judged(scenario: Scenario, adapter: Adapter, readings: Mapping[str, str] = {}) -> Verdicts:
    traced = answer(scenario, adapter)
    assert isinstance(traced, Traced), traced
    return Monitor(load_life_cycle(), Ics(readings)).judge(scenario, traced.events)


@pytest.mark.parametrize("name", DECLARED)
def test_declared_readings_are_tried_and_kept(name: str) -> None:
    mixin, readings = DECLARED[name]
    adapter, disguise = bind(mixin.__name__, mixin), Disguise(3, "{port}.{element}")
    for purpose, requirements, scenarios in purposes(readings):
        exercised: set[str] = set()
        for plain in scenarios:
            scenario = msgspec.structs.replace(disguise.scenario(plain), patience=200)
            verdicts = judged(scenario, adapter, readings)
            assert verdicts.findings == [], purpose
            exercised |= set(verdicts.exercises)
        assert set(requirements) <= exercised, purpose


def purpose(name: str, **readings: str) -> Scenario:
    (scenario,) = next(scenarios for found, _, scenarios in purposes(readings) if found == name)
    return scenario


def events_of(scenario: Scenario, adapter: Adapter = ReferenceAdapter) -> list[Event]:
    traced = answer(scenario, adapter)
    assert isinstance(traced, Traced), traced
    return list(traced.events)


def findings(scenario: Scenario, events: list[Event], **readings: str) -> dict[str, str]:
    verdicts = Monitor(load_life_cycle(), Ics({k.replace("_", "-"): v for k, v in readings.items()})).judge(
        scenario, tuple(events)
    )
    return {finding.requirement: finding.cause for finding in verdicts.findings}


def exercised(scenario: Scenario, events: list[Event]) -> set[str]:
    return set(Monitor(load_life_cycle()).judge(scenario, tuple(events)).exercises)


LONGER = "clock-over-a-longer-time"
RATE, ORDER = "R-10.1.4.1-09", "R-10.1.4.1-08"


def with_times(events: list[Event], *milliseconds: int) -> list[Event]:
    """The local clock gave these times instead, one after the other; the synchronised one was not asked."""
    times = iter(milliseconds)
    asked = ""
    changed = []
    for event in events:
        if isinstance(event, Request):
            asked = str(event.method)
        if isinstance(event, Request | Reply) and asked != "get_local_time":
            continue
        if isinstance(event, Reply):
            seconds, rest = divmod(next(times), 1000)
            event = msgspec.structs.replace(event, results=([seconds, rest * 1000],))
        changed.append(event)
    return changed


def with_calendar(events: list[Event], jump: int) -> list[Event]:
    """From the second look on the calendar clock showed so many milliseconds more."""
    pauses = [event for event in events if isinstance(event, Paused)]
    return [
        msgspec.structs.replace(e, calendar=e.calendar + (e is not pauses[0]) * jump * MILLISECOND)
        if isinstance(e, Paused)
        else e
        for e in events
    ]


def test_clock_that_goes_back_is_excused_only_if_it_may_have_been_set() -> None:
    scenario = purpose(LONGER)
    events = with_times(events_of(scenario), 5000, 4000, 4001, 4101)
    assert findings(scenario, events).keys() == {ORDER, RATE}
    set_back = with_calendar(events, -2000)
    assert findings(scenario, set_back) == {}
    assert findings(scenario, set_back, local_clock="monotonic").keys() == {ORDER, RATE}


def test_clock_without_calendar_readings_is_undecided() -> None:
    scenario = purpose(LONGER)
    events = [e for e in with_times(events_of(scenario), 5000, 4000, 4001, 4101) if not isinstance(e, Paused)]
    assert findings(scenario, events) == {}
    assert not {ORDER, RATE} & exercised(scenario, events)


def test_rate_is_not_judged_of_readings_that_took_long() -> None:
    """The machine stood still while the clock was read, so the time of the reading is unknown."""
    scenario = purpose(LONGER)
    slow: list[Event] = []
    late = 0
    for event in with_times(events_of(scenario), 5000, 5000, 5000, 5000):
        late += isinstance(event, Reply) * 400 * MILLISECOND
        moved = msgspec.structs.replace(event, t=event.t + late)
        slow.append(
            msgspec.structs.replace(moved, calendar=moved.calendar + late) if isinstance(moved, Paused) else moved
        )
    assert findings(scenario, slow) == {}
    assert RATE not in exercised(scenario, slow)


def test_seconds_wrap() -> None:
    assert passed((2**32 - 1) * SECOND, 3 * SECOND) == 4 * SECOND
    assert passed(3 * SECOND, (2**32 - 1) * SECOND) == -4 * SECOND


def test_epoch_is_compared_only_if_it_is_declared() -> None:
    scenario = purpose(LONGER)
    events = events_of(scenario, bind("monotonic", variants.has_monotonic_clocks))
    assert findings(scenario, events) == {}
    assert findings(scenario, events, clock_epoch="unix") == {RATE: "not unix"}


LOG = "log-through-a-life"


def with_log(events: list[Event], change: Any) -> list[Event]:
    """Other records were read."""
    return [
        msgspec.structs.replace(e, records=tuple(change(e.records)))
        if isinstance(e, Return) and e.records is not None
        else e
        for e in events
    ]


def test_ending_the_wait_for_records_too_early_is_a_contradiction() -> None:
    scenario = purpose(LOG)
    events = events_of(scenario)
    assert contradiction(scenario, events) is None
    problem = contradiction(scenario, with_log(events, lambda records: records[1:]))
    assert problem is not None
    assert "gives up waiting for 5 records too early" in problem


def test_record_is_missing_only_when_somebody_waited_for_it() -> None:
    scenario = purpose(LOG)
    events = events_of(scenario)
    assert findings(scenario, with_log(events, lambda records: records[1:])) == {"R-10.1.4.2-26": "none"}
    impatient = msgspec.structs.replace(
        scenario,
        steps=tuple(msgspec.structs.replace(x, records=0) if hasattr(x, "records") else x for x in scenario.steps),
    )
    assert findings(impatient, with_log(events, lambda records: records[1:])) == {}


def test_records_of_other_sources_are_ignored() -> None:
    scenario = purpose(LOG)
    noise = (LogRecord("info", "container started"), LogRecord("debug", ""))
    events = with_log(events_of(scenario), lambda records: (*noise, *records))
    assert findings(scenario, events) == {}


def test_message_may_be_traced_before_the_receiver_is_entered() -> None:
    """It was on its way when the log was read."""
    (both,) = next(scenarios for name, _, scenarios in purposes({}) if name == "port trace/messages")
    untraced = msgspec.structs.replace(both.components["emitter"], policies=())
    scenario = msgspec.structs.replace(both, components=both.components | {"emitter": untraced})
    events = events_of(scenario)
    read = next(e for e in events if isinstance(e, Return) and e.records is not None)
    assert read.records is not None
    before = [e for e in events[: events.index(read) + 1] if getattr(e, "hook", "") != "method"]
    assert len(read.records) == 2
    assert findings(scenario, before) == {}


def test_log_that_cannot_be_read_is_not_judged() -> None:
    class Unreadable(ReferenceAdapter):
        """Offers no way to the log."""

        def read_log(self, manager: object) -> list[tuple[str, str]]:
            raise NotOffered

    scenario = purpose(LOG)
    events = events_of(scenario, Unreadable)
    assert findings(scenario, events) == {}
    records = {"R-10.1.4.2-26", "R-10.1.4.2-51", "R-10.1.4.2-53"}
    assert "R-10.1.4.2-25" in exercised(scenario, events)
    assert not records & exercised(scenario, events)


def test_messages_are_disguised() -> None:
    """They differ in each run; the form of their texts is kept."""
    narrow = next(scenarios for name, _, scenarios in purposes({}) if name == "log/narrow texts")[0]
    disguise = Disguise(1, "{port}_{element}")
    plain, other = (
        [e.arguments[1] for e in events_of(scenario) if isinstance(e, Request) and e.arguments]
        for scenario in (narrow, disguise.scenario(narrow))
    )
    assert not set(plain) & set(other)
    assert {len(text) for text in other} >= {9, 255}
    assert [text.partition(" ")[2] for text in plain] == [text.partition(" ")[2] for text in other]
    assert disguise.reveal(tuple(other)) == tuple(plain)
