"""A made-up run with realistic traces and hostile texts, for the tests of reports."""

from __future__ import annotations

from typing import Any

import msgspec

from ucm_cts.adapters.contract.scenario import (
    AddComponent,
    Connect,
    Declaration,
    Destroy,
    GetPortElement,
    Invoke,
    RemoveComponent,
    Scenario,
    Start,
    Step,
    Stop,
)
from ucm_cts.adapters.contract.trace import (
    Call,
    Create,
    Dependency,
    Enter,
    Event,
    Exit,
    Raise,
    Reference,
    Reply,
    Request,
    Return,
    Trace,
)
from ucm_cts.harness.catalogue.requirements import Requirement
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.results.values import (
    Execution,
    FrameworkReport,
    Incident,
    IncidentReport,
    ReportedFinding,
    RequirementResult,
    TraceEvidence,
    TransitionResult,
)
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, Outcome, Row

HOSTILE = "</script><script>alert(1)</script>\"'><img src=x onerror=alert(2)>\x00\x1b[31m\u202e\ud800{{ 7*7 }}"


class Tape:
    """Writes a trace: numbers and times its events."""

    def __init__(self) -> None:
        self.events: list[Event] = []

    def put(self, kind: type[Any], thread: int = 0, **fields: Any) -> None:
        n = len(self.events) + 1
        self.events.append(kind(n=n, t=n * 1_000, thread=thread, **fields))

    def step(self, number: int, value: Any = None) -> None:
        self.put(Call, step=number)
        self.put(Return, step=number, value=value)

    def hook(self, component: str, hook: str, **more: Any) -> None:
        self.put(Enter, component=component, instance=1, hook=hook, **more)
        self.put(Exit, component=component, instance=1, hook=hook)

    def trace(self) -> tuple[Event, ...]:
        return tuple(self.events)


COMPONENTS = {
    "provider": Declaration(provides=("in_api",)),
    "client": Declaration(requires=("out_api",), provides=("in_go",), connectable=True),
}
STEPS: tuple[Step, ...] = (
    AddComponent(component="provider"),
    AddComponent(component="client"),
    GetPortElement(id="provider", port="in_api", bind="api"),
    Connect(id="client", port="out_api", to="api", bind="link"),
    Start(),
    GetPortElement(id="client", port="in_go", bind="go"),
    Invoke(ref="go", value=7),
    RemoveComponent(id="provider"),
    Stop(),
    Destroy(),
)
API = Reference(component="provider", instance=1, port="in_api")


def lasting(first: int, last: int) -> Trace:
    """A trace from one millisecond to the other."""
    return Call(n=1, t=first * 1_000_000, thread=0, step=0), Call(n=2, t=last * 1_000_000, thread=0, step=1)


def begin(tape: Tape) -> None:
    """Two components, connected and started."""
    for number, component in enumerate(("provider", "client")):
        tape.put(Call, step=number)
        tape.put(Create, component=component, instance=1)
        tape.hook(component, "on_init")
        tape.put(Return, step=number, value=number + 17)
    tape.step(2, API)
    tape.put(Call, step=3)
    tape.hook("client", "on_connect", port="out_api", reference=API)
    tape.put(Return, step=3, value=4)
    tape.put(Call, step=4)
    tape.hook("provider", "on_startup", dependencies=())
    tape.hook("client", "on_startup", dependencies=(Dependency(port="out_api", references=(API,)),))
    tape.put(Return, step=4)


def refused_stop() -> ReportedFinding:
    """The framework forgets on_shutdown of the provider at stop."""
    tape = Tape()
    begin(tape)
    steps = (*STEPS[:5], Stop(), Destroy())
    tape.put(Call, step=5)
    tape.hook("client", "on_shutdown")
    tape.put(Return, step=5)
    last = len(tape.events)
    finding = Finding(
        requirement="R-11.2.2.1-12",
        rule="callbacks",
        cause="on_shutdown missing at stop",
        expected="stop calls on_shutdown of every started component before it returns.",
        observed="stop returned, and provider had not received on_shutdown.",
        events=(last,),
        step=5,
        expected_events=(Arrow("manager", "provider", "on_shutdown()"), Arrow("manager", "test", "returns")),
    )
    tape.put(Call, step=6)
    tape.hook("client", "on_remove")
    tape.hook("provider", "on_remove")
    tape.put(Return, step=6)
    return ReportedFinding(
        finding, TraceEvidence(Execution("stop-after-start", Scenario(COMPONENTS, steps), tape.trace())), 31
    )


def wrong_error() -> ReportedFinding:
    """An undeclared exception instead of NOT_FOUND."""
    tape = Tape()
    steps: tuple[Step, ...] = (AddComponent(component="provider"), RemoveComponent(id="unknown"))
    tape.put(Call, step=0)
    tape.put(Create, component="provider", instance=1)
    tape.hook("provider", "on_init")
    tape.put(Return, step=0, value=1)
    tape.put(Call, step=1)
    tape.put(Raise, step=1, error="UNDECLARED", detail="KeyError: 99 " + HOSTILE.replace("\ud800", ""))
    finding = Finding(
        requirement="R-12.10-15",
        rule="answers",
        cause="UNDECLARED for an unknown component",
        expected="remove_component of an unknown id ends with NOT_FOUND.",
        observed="It ended with an exception that 12.10 does not declare: " + HOSTILE,
        events=(len(tape.events),),
        step=1,
        expected_events=(Arrow("manager", "test", "raises NOT_FOUND"),),
    )
    return ReportedFinding(
        finding, TraceEvidence(Execution("remove-unknown", Scenario(COMPONENTS, steps), tape.trace())), 4
    )


def lost_call(rounds: int = 1) -> ReportedFinding:
    """A call between bodies comes back with another value than was returned; many rounds make a long trace."""
    tape = Tape()
    begin(tape)
    steps = list(STEPS[:6])
    tape.step(5, Reference(component="client", instance=1, port="in_go"))
    for i in range(rounds):
        steps.append(Invoke(ref="go", value=i))
        tape.put(Call, step=len(steps) - 1)
        tape.put(Enter, component="client", instance=1, hook="exchange", port="in_go", value=i)
        tape.put(Request, component="client", instance=1, port="out_api", value=i)
        tape.put(Enter, component="provider", instance=1, hook="exchange", port="in_api", value=i)
        tape.put(Exit, component="provider", instance=1, hook="exchange", value=~i)
        tape.put(Reply, component="client", instance=1, port="out_api", value=~i if i < rounds - 1 else 0)
        bad = len(tape.events)
        tape.put(Exit, component="client", instance=1, hook="exchange", value=~i)
        tape.put(Return, step=len(steps) - 1, value=~i)
    finding = Finding(
        requirement="R-11.1.3-01",
        rule="peer_calls",
        cause="reply changed",
        expected="The result of provider reaches client unchanged.",
        observed="provider returned another value than client received.",
        events=(bad,),
        step=len(steps) - 1,
        expected_events=(Arrow("provider", "client", f"returns {~(rounds - 1)}"),),
    )
    return ReportedFinding(
        finding, TraceEvidence(Execution("peer-call", Scenario(COMPONENTS, tuple(steps)), tape.trace())), 2
    )


def missing() -> ReportedFinding:
    """A finding that can point at no event, with a waiver."""
    failed = refused_stop()
    finding = msgspec.structs.replace(
        failed.finding, events=(), requirement="R-11.2.1.2-06", cause="nothing to point at"
    )
    return msgspec.structs.replace(failed, finding=finding, waived="known, ticket 12")


def crash(detail: str = "signal 11 (SIGSEGV)", stacks: str = "") -> IncidentReport:
    """The host dies inside start, with a body still at work on a thread of the framework's own."""
    tape = Tape()
    begin(tape)
    tape.put(Call, step=5)
    tape.put(Return, step=5, value="opaque")
    tape.put(Call, step=6)
    tape.put(Enter, thread=3, component="client", instance=1, hook="exchange", port="in_go", value=7)
    tape.put(Request, thread=3, component="client", instance=1, port="out_api", value=7)
    incident = Incident(
        "crash", detail, stacks or "Thread 1 (most recent call first):\n#0 0x7f3a in Registry::find()\n"
    )
    return IncidentReport(incident, Execution("call-a-peer", Scenario(COMPONENTS, STEPS), tape.trace(), incident))


TABLE = LifeCycleTable(
    rows=(
        Row(
            "add_component",
            "absent",
            "requires nothing",
            "R-11.2.2.1-01",
            (Outcome(("return",), "configured", ("on_init",)),),
        ),
        Row("remove_component", "absent", "never existed", "R-12.10-15", (Outcome(("NOT_FOUND",), "absent"),)),
        Row("start", "configured", "all configured", "R-11.2.3-06", (Outcome(("return",), "ready", ("on_startup",)),)),
        Row("stop", "ready", "", "R-11.2.3-10", (Outcome(("return",), "configured", ("on_shutdown",)),)),
        Row(
            "start",
            "ready",
            "already started",
            "R-11.2.3-15",
            (
                Outcome(("return",), "ready", reading="double-start=noop"),
                Outcome(("UCM_ERROR",), "ready", reading="double-start=error"),
            ),
        ),
        Row(
            "remove_component",
            "ready",
            "",
            "R-11.2.3-11",
            (
                Outcome(("return",), "absent", ("on_shutdown", "on_remove"), "remove-while-ready=cascade"),
                Outcome(("UCM_ERROR",), "ready", (), "remove-while-ready=refuse"),
            ),
        ),
    ),
    duties=(),
    order="R-11.2.3-12",
    fragments="R-11.2.1.4-01",
)
TRANSITIONS = (
    TransitionResult("absent/add_component/requires nothing", 800, 0),
    TransitionResult("absent/remove_component/never existed", 4, 4),
    TransitionResult("configured/start/all configured", 300, 0),
    TransitionResult("ready/stop/", 200, 31),
    TransitionResult("ready/remove_component/", 12, 0, ("remove-while-ready=refuse",)),
)
CATALOGUE = (
    Requirement("R-11.1.3-01", "11.1.3", "The container lets components communicate", "shall", "They talk.", "Values."),
    Requirement("R-11.2.1.2-06", "11.2.1.2", "on_remove comes last", "shall", "No callback after it.", "Order."),
    Requirement(
        "R-11.2.2.1-12", "11.2.2.1", "stop shuts every component down", "shall", "Each receives it once.", "Callbacks.",
        ("callbacks",), "", ("stop-inflight",),
    ),
    Requirement("R-11.2.2.1-01", "11.2.2.1", "add_component makes an instance", "shall", "It does.", "Create."),
    Requirement("R-11.2.3-15", "11.2.3", "start twice does no harm", "should", "Ignored or refused.", "Second start."),
    Requirement("R-11.2.3-90", "11.2.3", "Nothing to apply here", "may", "A permission."),
    Requirement("R-11.2.3-91", "11.2.3", "The harness stumbled here", "shall", "Something."),
    Requirement("R-12.10-15", "12.10", "NOT_FOUND for an unknown component", "shall", "An error.", "Answers."),
    Requirement("R-11-01", "11", "It joins things", "statement", "Text.", untestable="Describes an architecture."),
)  # fmt: skip


def results() -> tuple[RequirementResult, ...]:
    """One requirement of each verdict, and four failures."""
    titles = {entry.id: (entry.clause, entry.title) for entry in CATALOGUE}

    def result(
        name: str, verdict: Any, exercised: int, *findings: ReportedFinding, reason: str = ""
    ) -> RequirementResult:
        return RequirementResult(name, *titles[name], verdict, exercised, findings, reason, seconds=1.25)

    return (
        result("R-12.10-15", "fail", 90, wrong_error()),
        result("R-11.2.2.1-12", "fail", 412, lost_call(1), refused_stop()),
        result("R-11.1.3-01", "fail", 88, lost_call(80)),
        result("R-11.2.1.2-06", "fail", 70, missing()),
        result("R-11.2.2.1-01", "pass", 4_012),
        result("R-11.2.3-15", "inconclusive", 0, reason="No scenario started a container twice."),
        result("R-11.2.3-90", "not applicable", 0, reason="Declared so by the vendor."),
        result("R-11.2.3-91", "error", 3, reason="Judge failed: " + HOSTILE),
    )


def sample(**changes: Any) -> FrameworkReport:
    """The whole report."""
    report = FrameworkReport(
        product="Fancy " + HOSTILE,
        version="2.4 & <b>",
        profile="container",
        verdict="not conformant",
        requirements=results(),
        transitions=TRANSITIONS,
        incidents=(crash(stacks=HOSTILE * 3), crash(detail="x" * 10_000_000)),
        adapter="./my host --fast",
        suite_version="0.1.0",
        seed=42,
        started="2031-01-02T03:04:05Z",
        seconds=12.34,
        scenarios=4_711,
        events=123_456,
        statement=default_statement(),
        readings={"double-start": ("noop",), "late-add": ("deferred", "refuse")},
    )
    return msgspec.structs.replace(report, **changes)


DECISIONS = {"stop-inflight": "What was begun may end."}
