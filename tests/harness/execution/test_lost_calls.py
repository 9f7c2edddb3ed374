"""A business call that never comes back fails its own requirement, and not the operation that waits for it."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import within
from made_up_run import Tape, sample
from rich.console import Console

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.report.summary import summary
from ucm_cts.harness.results.incidents import finding_of_incident
from ucm_cts.harness.results.values import Execution, Incident, IncidentKind, IncidentReport

PASSIVE = (Policy(s.PROTECTED_PASSIVE),)
SERVER, CLIENT = Declaration(provides=("in",)), Declaration(provides=("go",), requires=("out",))
PLAIN: tuple[s.Step, ...] = (
    s.AddComponent("server"),
    s.AddComponent("client"),
    s.GetPortElement("server", "in", "api"),
    s.GetPortElement("client", "go", "tell"),
    s.Connect("client", "out", "api", "link"),
    s.Start(),
    s.Invoke("tell", 7, thread="w"),
)


class Story(Tape):
    """What a host has recorded of a call that is lost."""

    def __init__(self, *after: s.Step, plain: tuple[s.Step, ...] = PLAIN, server: Declaration = SERVER) -> None:
        super().__init__()
        self.scenario = Scenario({"server": server, "client": CLIENT}, (*plain, *after))
        for number, step in enumerate(plain[:-1]):
            self.put(t.Call, step=number)
            if isinstance(step, s.AddComponent):
                self.put(t.Create, component=step.component, instance=1)
                self.hook(step.component, "on_init")
            if isinstance(step, s.Start):
                self.hook("server", "on_startup", dependencies=())
                self.hook("client", "on_startup", dependencies=())
            self.put(t.Return, step=number)
        self.put(t.Call, thread=1, step=len(plain) - 1)

    def asks(self) -> Story:
        """The client is entered and calls the server."""
        self.put(t.Enter, thread=1, component="client", instance=1, hook="exchange", port="go", value=7)
        self.put(t.Request, thread=1, component="client", instance=1, port="out", value=7)
        return self

    def serves(self) -> Story:
        """The server is entered and left."""
        self.put(t.Enter, thread=2, component="server", instance=1, hook="exchange", port="in", value=7)
        self.put(t.Exit, thread=2, component="server", instance=1, hook="exchange", value=~7)
        return self

    def waits(self, step: int) -> Story:
        """A step runs out of patience."""
        self.put(t.Timeout, step=step)
        return self

    def calls(self, step: int) -> Story:
        """The operation of a step is called."""
        self.put(t.Call, step=step)
        return self

    def execution(self, kind: IncidentKind = "hang") -> Execution:
        """The execution, which ends in an incident."""
        return Execution("x", self.scenario, self.trace(), Incident(kind, "SIGSEGV"))

    def blames(self, kind: IncidentKind = "hang") -> str:
        """The requirement that fails; empty if none does."""
        finding = finding_of_incident(self.execution(kind))
        assert finding is None or finding.expected != finding.observed
        return finding.requirement if finding is not None else ""


LINKED: dict[str, tuple[s.Step, ...]] = {
    connector: (
        *PLAIN[:2],
        PLAIN[3],
        s.Link(connector, "numbers", "line"),  # type: ignore[arg-type]
        s.Attach("line", taker, "server", "in"),  # type: ignore[arg-type]
        s.Attach("line", sender, "client", "out"),  # type: ignore[arg-type]
        *PLAIN[5:],
    )
    for connector, taker, sender in (
        (s.SERVICE_CONNECTOR, "server", "client"),
        (s.MESSAGE_CONNECTOR, "receiver", "emitter"),
    )
}


def test_the_deepest_call_is_blamed() -> None:
    assert Story().blames() == "R-11.2.3-03"
    finding = finding_of_incident(Story().asks().execution())
    assert finding is not None
    assert "client makes through out to server" in finding.expected
    assert Story().asks().serves().blames() == "R-11.2.3-03"


def test_its_policy_or_its_connector_says_which_requirement() -> None:
    assert Story(server=Declaration(provides=("in",), policies=PASSIVE)).asks().blames() == "R-10.1.3.2-15"
    assert Story(plain=LINKED[s.SERVICE_CONNECTOR]).asks().blames() == "R-10.1.5.1-01"
    assert Story(plain=LINKED[s.MESSAGE_CONNECTOR]).asks().blames() == "R-10.1.6.1-10"


def test_a_stop_that_waits_for_it_is_not_blamed() -> None:
    joins = s.Join("w"), s.Stop()
    assert Story(*joins).asks().waits(7).calls(8).blames() == "R-11.2.3-03"


def test_a_stop_called_meanwhile_may_be_the_reason() -> None:
    assert Story(s.Stop()).asks().calls(7).blames() == "R-12.10-10"


def test_a_body_that_is_inside_keeps_its_caller_waiting() -> None:
    story = Story(s.Stop()).asks()
    story.put(t.Enter, thread=2, component="server", instance=1, hook="exchange", port="in", value=7)
    assert story.blames() == ""
    assert story.calls(7).blames() == "R-12.10-10"


def test_a_call_waits_for_a_component_that_waits_for_a_broken_link() -> None:
    """The client, which is executed by a thread of its own, calls through what is broken. In the other story nobody does."""
    plain = (*LINKED[s.SERVICE_CONNECTOR][:-1], s.Break("line"), PLAIN[-1])
    for entered, blamed in ((True, ""), (False, "R-11.2.3-03")):
        story = Story(plain=plain)
        if entered:
            story.put(t.Enter, thread=2, component="client", instance=1, hook="exchange", port="go", value=7)
            story.put(t.Request, thread=2, component="client", instance=1, port="out", value=7)
        assert story.blames() == blamed


def test_a_call_of_another_component_than_the_one_that_waits_is_lost() -> None:
    go = (s.GetPortElement("server", "in", "api"), *LINKED[s.SERVICE_CONNECTOR][:-1], s.Break("line"), PLAIN[-1])
    story = Story(s.Invoke("api", 8, thread="v"), plain=(*go[1:3], go[0], *go[3:]))
    story.put(t.Enter, thread=2, component="client", instance=1, hook="exchange", port="go", value=7)
    story.put(t.Request, thread=2, component="client", instance=1, port="out", value=7)
    assert story.blames() == ""
    story.put(t.Call, thread=3, step=len(go))
    assert story.blames() == "R-11.2.3-03"


def test_calls_before_the_start_may_wait() -> None:
    early = Story(plain=(*PLAIN[:4], PLAIN[6]))
    assert early.blames() == ""


def test_a_crash_belongs_to_the_operation_or_else_to_the_call() -> None:
    assert Story(s.GetComponents()).calls(7).blames("crash") == "R-12.10-11"
    assert Story().asks().blames("crash") == "R-11.2.3-03"


@pytest.mark.slow
def test_a_framework_that_loses_calls_fails_for_that(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    within(tmp_path, monkeypatch)
    steps = (s.AddComponent("server"), s.GetPortElement("server", "in.api", "api"), s.Start(), s.Invoke("api", 7))
    asked = Scenario({"server": Declaration(provides=("in.api",))}, (*steps, s.Stop()))
    with Driver(locate("hostile.failing:LosesCalls"), seed=1, limits=Limits(seconds=2)) as driver:
        (answer,) = driver.run([("lost", asked)])
        finding = finding_of_incident(driver.revealed(answer))
    assert finding is not None
    assert finding.requirement == "R-11.2.3-03"
    assert "the call of exchange that the test makes through reference api to server comes back" in finding.expected


@pytest.mark.parametrize("kind", ["crash", "memory"])
def test_what_fails_no_requirement_comes_first(kind: IncidentKind) -> None:
    quiet = Story(s.Pause(10))
    quiet.put(t.Return, thread=1, step=6, value=1)
    item = IncidentReport(Incident(kind, "signal 11"), quiet.execution(kind))
    console = Console(width=200)
    with console.capture() as printed:
        console.print(summary(sample(incidents=(item,))))
    lines = [line for line in printed.get().splitlines() if line]
    first = next(line for line in lines[1:] if line.startswith(("⚡", "✗")))
    assert first == f"⚡ {kind}  fails no requirement: signal 11, between two calls"
