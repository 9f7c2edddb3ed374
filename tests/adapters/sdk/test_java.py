"""The Java SDK behind the wire, its guide, and Fractal's Julia behind it."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
from pathlib import Path
from typing import Any

import msgspec
import pytest
import scheduling
from command_line import report_of, ucm_cts
from cpp_builds import PAIR, Host, connect, events, found, talk
from cpp_builds import run as run_program
from files import ROOT, SUPPORT
from java_builds import GUIDE, JavaBuilds, java
from protocol_messages import Samples, check_refusals, mutated_lines
from real_frameworks import HABITS, check

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import generating
from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.schema_types import Protocol
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.selection import load_purposes

pytestmark = pytest.mark.native

__all__ = ["java"]

# the same as in Python


def without_times(answer: m.FromHost) -> Any:
    """What two hosts have to tell alike: texts of exceptions are each framework's own, and words for wrong values are each language's."""
    assert isinstance(answer, m.Traced), answer
    same = {"t": 0, "calendar": 0, "detail": ""}
    return answer.stuck, [
        msgspec.structs.replace(
            event,
            **{name: v for name, v in same.items() if hasattr(event, name)},
            **({"wrong": "wrong"} if getattr(event, "wrong", "") else {}),
        )
        for event in answer.events
    ]


def by_python(run: m.Run, adapter: type[Adapter] = ReferenceAdapter) -> m.FromHost:
    return m.from_host_decoder().decode(Engine(adapter).answer(m.encode(run)))


def typed() -> s.Scenario:
    """Values of many types, a declared exception, a failure and a counted burst, from a client to its servers."""
    text, problem = d.String("CHAR32"), d.Structure("problem", {"why": d.String("CHAR32")})
    ask = d.Method((d.Parameter("text", "INOUT", text),), (problem,))
    values = (2**64 - 1, -(2**63), True, "ä\n\U0001f600", [1, [False, "x"]])
    calls: tuple[s.Action, ...] = (
        s.CallMethod("out", "ask", values),
        s.CallMethod("out", "ask", ()),
        s.CallMethod("out", "fail", (1,)),
        s.CallMethod("out", "none", (1,)),
        s.CallMethod("bad", "ask", (1,)),
        s.Burst("news", 2**20 - 2, 4),
        s.CallMethod("nothing", "ask", (1,)),
    )
    ports = {"out": "i", "bad": "i", "news": "n"}
    answers = (s.Answer("ask", overwrite=True), s.Answer("fail", ("why",), "problem"))
    components = {
        "C": s.Declaration(("go",), tuple(ports), plan={"exchange": (*calls, s.ReturnValue(7))}, ports=ports),
        "S": s.Declaration(("in",), plan={"method": answers}, ports={"in": "i"}),
        "B": s.Declaration(("in",), plan={"method": (s.RaiseError(),)}, ports={"in": "i"}),
        "N": s.Declaration(("in",), plan={"method": (s.CountMessages(),)}, ports={"in": "n"}),
    }
    servers = {"out": "S", "bad": "B", "news": "N"}
    steps = (
        *(s.AddComponent(name) for name in components),
        *(s.GetPortElement(name, "in", f"ref {name}") for name in servers.values()),
        s.GetPortElement("C", "go", "go"),
        *(s.Connect("C", port, f"ref {name}", port) for port, name in servers.items()),
        s.Start(),
        s.Invoke("go", 1),
        s.AwaitMessages("N", 4),
        s.AwaitMessages("S", 0, 2),
        s.Pause(1),
        s.Link("simple_service_connector", "i", "l"),
        s.ReadLog(),
        s.Attach("l", "client", "C", "out"),
    )
    numbers = d.message_interface(d.Integer("ULONG"))
    return s.Scenario(components, steps, interfaces={"i": d.Interface({"ask": ask}), "n": numbers})


def test_same_scenarios_make_the_same_traces_behind_both_sdks(java: JavaBuilds) -> None:
    """tests/support/java/StrictAdapter.java does what the Python reference framework does, which has connectors and a log beside."""
    scenarios = [scenario for purpose in load_purposes("container") for _, scenario in purpose.scenarios]
    runs = [m.Run(n, scenario) for n, scenario in enumerate((*scenarios, typed()))]
    answers, _, status = talk(java.program("StrictAdapter"), *runs)
    assert (status, len(answers)) == (0, len(runs))
    for run, answer in zip(runs[:-1], answers, strict=False):
        assert isinstance(answer, m.Traced), answer
        assert contradiction(run.scenario, answer.events) is None, run
        stuck, reported = without_times(answer)
        if not any(step.thread for step in run.scenario.steps):  # else the order may be another
            assert (stuck, reported) == without_times(by_python(run)), run
    _, reported = without_times(answers[-1])
    _, expected = without_times(by_python(runs[-1]))
    end = next(n for n, event in enumerate(reported) if isinstance(event, t.Paused))
    assert reported[: end + 1] == expected[: end + 1]
    assert [event.variable for event in reported if isinstance(event, t.Skip)] == ["link", "read_log", "l"]
    assert contradiction(runs[-1].scenario, reported) is None


def test_stress_counts_overlaps(java: JavaBuilds) -> None:
    steps = (s.AddComponent("P"), s.GetPortElement("P", "p_e", "r"), s.Stress(("r", "r"), 300), s.Invoke("r", 1))
    trace = events(java.program("StrictAdapter"), s.Scenario(PAIR, steps))
    (stressed,) = [event for event in trace if isinstance(event, t.Stressed)]
    assert min(stressed.calls, stressed.control_calls, stressed.overlaps, stressed.control_overlaps) > 0
    assert stressed.failed == 0
    assert [event.hook for event in trace if isinstance(event, t.Enter)] == ["on_init", "exchange"], "silent meanwhile"


def test_bodies_with_timers_have_a_callback(java: JavaBuilds) -> None:
    answers: dict[s.Hook, tuple[s.Action, ...]] = {"method": (s.Answer("on_timeout"),)}
    timed = s.Declaration(plan=answers, policies=(s.Policy(s.INDEX_TIMERS, element="timers"),))
    scenario = s.Scenario({"A": timed, "B": s.Declaration(policies=(s.Policy(s.CLOCK, element="c"),))}, (s.Start(),))
    trace = events(java.program("CallingBackAdapter"), scenario)
    assert contradiction(scenario, trace) is None
    (entered,) = (event for event in trace if isinstance(event, t.Enter))
    assert (entered.component, entered.hook) == ("A", "method")
    assert (entered.port, entered.method) == (s.TIMER_CALLBACK, "on_timeout")
    assert entered.arguments == ([5, s.RELATIVE_TIME], 7)


def test_bodies_use_object_timers_as_those_in_python_do(java: JavaBuilds) -> None:
    """tests/support/java/SchedulingAdapter.java does what tests/support/scheduling.py does."""
    runs = [m.Run(n, scenario) for n, scenario in enumerate((scheduling.ALL, scheduling.CROWDED))]
    (alike, crowded), _, _ = talk(java.program("SchedulingAdapter"), *runs)
    assert without_times(alike) == without_times(by_python(runs[0], scheduling.SchedulingAdapter))
    assert isinstance(crowded, m.Traced)
    assert contradiction(scheduling.CROWDED, crowded.events) is None
    assert len({event.thread for event in crowded.events if isinstance(event, t.Enter) and event.timer}) == 4


# the wire


def test_host_and_harness_accept_the_same_messages(java: JavaBuilds) -> None:
    lines = mutated_lines()
    answers, _, status = talk(java.program("StrictAdapter"), b"\n".join([*lines, b""]), m.Hello(m.PROTOCOL))
    assert status == 0
    check_refusals(lines, answers[:-1])
    assert answers[-1] == m.Welcome(m.PROTOCOL, "strict", "1")


def test_refusals_name_the_place(java: JavaBuilds) -> None:
    steps = b'{"type":"run","id":3,"scenario":{"components":{},"steps":[{"op":"start"},{"op":"start","x":1}]}}\n'
    plan = b'{"type":"run","id":4,"scenario":{"components":{"A":{"plan":{"on_init":[{"do":"dance"}]}}},"steps":[]}}\n'
    refuse = m.Run(8, s.Scenario({"refuse": s.Declaration()}, ()))
    answers, _, _ = talk(java.program("RudeAdapter"), steps, plan, b'{"type":"hello","protocol":7}\n', refuse)
    begin = "not a message of protocol 2: "
    assert answers == [
        m.Refused(f"{begin}Object contains unknown field `x` - at `$.scenario.steps[1]`", 3),
        m.Refused(f"{begin}Invalid value 'dance' - at `$.scenario.components.A.plan.on_init[0].do`", 4),
        m.Refused("the harness speaks protocol 7, this host speaks 2"),
        m.Refused("java.lang.IllegalStateException: no licence", 8),
    ]


def test_streamed_events_come_first_and_are_those_of_the_trace(java: JavaBuilds) -> None:
    threads = tuple(s.AddComponent("P", bind=f"p{n}", thread=f"t{n % 3}") for n in range(30))
    *streamed, traced = talk(java.program("StrictAdapter"), m.Run(5, s.Scenario(PAIR, threads), stream=True))[0]
    assert isinstance(traced, m.Traced)
    assert [a.event for a in streamed if isinstance(a, m.Happened)] == list(traced.events)
    assert len(streamed) == len(traced.events) > 100


@pytest.mark.parametrize("kind", ["tcp", "unix"])
def test_listening(java: JavaBuilds, kind: str, tmp_path: Path) -> None:
    where = "tcp://127.0.0.1:0" if kind == "tcp" else f"unix:{tmp_path}/socket"
    command = [java.program("RudeAdapter"), "--listen", where]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    assert server.stdout
    try:
        address = server.stdout.readline().decode().removeprefix("listening on ").strip()
        with connect(address) as stays, connect(address) as dies:
            dies.sendall(m.encode(m.Run(1, s.Scenario({}, (s.AddComponent("halt"),)))) + b"\n")
            assert dies.recv(100) == b"", "an end of the host ends the connection"
            stays.sendall(m.encode(m.Hello(m.PROTOCOL)) + b"\n")
            welcome = m.from_host_decoder().decode(stays.makefile("rb").readline())
            assert welcome == m.Welcome(m.PROTOCOL, "rude", "0", "{port}.{element}")
    finally:
        server.terminate()
        server.wait()


@pytest.mark.parametrize("wrong", [["--listen", "udp://x:1"], ["--listen", "tcp://x"], ["surprise"]])
def test_wrong_use_gives_one_line(java: JavaBuilds, wrong: list[str]) -> None:
    done = subprocess.run([java.program("RudeAdapter"), *wrong], capture_output=True, text=True, check=False)
    assert (done.returncode in (1, 2), done.stdout) == (True, "")
    assert re.fullmatch(r"rude: .*tcp://HOST:PORT or unix:.*PATH\n", done.stderr)


# frameworks that misbehave


def test_exceptions_of_operations(java: JavaBuilds) -> None:
    steps: tuple[s.Step, ...] = (
        *(s.AddComponent(f"throw {what}") for what in ("error", "long", "text")),
        s.AddComponent("interrupt"),
        s.GetComponents(),
        s.RemoveComponent("unknown"),
        s.GetPortElement("interrupt", "none", "null"),
        s.GetPortElement("interrupt", "p", "ref"),
        s.Invoke("ref", 1),
        s.Invoke("null", 1),
        s.Pause(20),
        s.Destroy(),
    )
    trace = events(java.program("RudeAdapter"), s.Scenario({}, steps))
    raised = {e.step: e for e in trace if isinstance(e, t.Raise)}
    errors = {step: event.error for step, event in raised.items()}
    assert errors == {
        0: "UNDECLARED",
        1: "UNDECLARED",
        2: "NOT_FOUND",
        5: "BAD_PARAMETER",
        8: "UNDECLARED",
        11: "UCM_ERROR",
    }
    assert raised[0].detail == "java.lang.StackOverflowError"
    assert raised[1].detail == f"java.io.IOException: {'x' * 200}"
    assert raised[2].detail == '"quoted" ä \ufffd'
    assert raised[5].detail == "2147483645", "unknown is an id that the framework has not given out"
    assert [e.variable for e in trace if isinstance(e, t.Skip)] == ["null"]
    assert contradiction(s.Scenario({}, steps), trace) is None, "an interrupt of the framework does not shorten waits"


def test_what_the_framework_hands_over_in_place_of_values_is_recorded(java: JavaBuilds) -> None:
    trace = events(java.program("RudeAdapter"), s.Scenario({"A": s.Declaration()}, (s.Stop(),)))
    assert [e.wrong for e in trace if isinstance(e, t.Enter)] == ["nothing as its connections"]


def test_broken_contract_is_refused(java: JavaBuilds) -> None:
    listed = s.Scenario({}, (s.CreateContainer("sub"), s.GetComponents(container="sub")))
    answers, _, _ = talk(java.program("RudeAdapter"), m.Run(1, listed))
    assert answers == [m.Refused("get_components returned nothing; it returns a list of integers", 1)]


def test_printing_does_not_reach_the_protocol(java: JavaBuilds) -> None:
    (traced,), err, _ = talk(java.program("RudeAdapter"), m.Run(1, s.Scenario({}, (s.AddComponent("print"),))))
    assert isinstance(traced, m.Traced)
    assert '{"type":"welcome"}' in err


def test_exit_of_the_framework_is_reported_with_the_events_before(java: JavaBuilds) -> None:
    run = m.Run(1, s.Scenario({}, (s.AddComponent("exit"),)), stream=True)
    answers, _, status = talk(java.program("RudeAdapter"), run)
    assert (status, [type(answer) for answer in answers]) == (3, [m.Happened])


def test_stuck_threads_are_named_and_end_the_host(java: JavaBuilds) -> None:
    steps = (s.AddComponent("hang", thread="w"), s.Settle("w"), s.Join("w"), s.AddComponent("fine", thread="v"))
    answers, _, status = talk(java.program("RudeAdapter"), m.Run(1, s.Scenario({}, steps, 200)), m.Hello(m.PROTOCOL))
    assert len(answers) == 1, "after stuck threads the host ends itself"
    assert isinstance(answers[0], m.Traced)
    assert (answers[0].stuck, status) == (("w",), 0)
    assert found(answers[0].events) == {"w": "blocked"}
    assert [e.step for e in answers[0].events if isinstance(e, t.Timeout)] == [2]


def test_stacks_on_request(java: JavaBuilds) -> None:
    hold = s.Declaration(plan={"on_init": (s.HoldAtGate("g"),)})
    steps = (s.AddComponent("H", thread="w"), s.ReachGate("g"), s.Join("w"))
    host = Host(java.program("StrictAdapter"))
    host.send(m.Run(1, s.Scenario({"H": hold}, steps, 1000), stream=True))
    assert host.process.stdout
    assert host.process.stderr
    while b'"held"' not in host.process.stdout.readline():
        pass
    host.process.send_signal(signal.SIGUSR1)
    shown = b""
    while not {b"thread main:", b"thread worker w:", b"Gates.hold"} <= set(
        re.findall(rb"thread [\w ]+:|Gates.hold", shown)
    ):
        shown += host.process.stderr.read(1)
    answers, _, status = host.end()
    assert isinstance(answers[-1], m.Traced)
    assert (answers[-1].stuck, status) == ((), 0), "and the scenario went on"


# the guide


def test_guide(java: JavaBuilds, monkeypatch: pytest.MonkeyPatch) -> None:
    page = GUIDE.read_text()
    (adapters, wanted) = (re.search(pattern, page) for pattern in (r"mvn -q -f (\w+)", r"`([\w.]+):([\w-]+):([\d.]+)`"))
    assert adapters
    assert wanted
    pom = (ROOT / adapters[1] / "sdk" / "java" / "pom.xml").read_text()
    group, artifact, version = wanted.groups()
    assert f"<groupId>{group}</groupId>" in pom
    assert f"<artifactId>{artifact}</artifactId>\n  <name>" in pom
    assert f"<version>{version}</version>" in pom.partition("</parent>")[0]
    monkeypatch.chdir(java.folder)
    assert "    ucm-cts run ./beans-adapter\n" in page
    few = "R-11.2.2.1 or R-11.2.1.2-05 or R-11.2.1.3-02 or R-12.10-26"
    outcome = ucm_cts("run", "./beans-adapter", "-k", few, "--out", "beans")
    assert (outcome.status, outcome.err) == (1, "")
    report = report_of(java.folder / "beans")
    assert report["product"] == "Beans"
    assert report["incidents"] == []
    verdicts = {one["id"]: one["verdict"] for one in report["requirements"]}
    assert {verdicts[f"R-11.2.2.1-{number}"] for number in ("01", "05", "07", "08")} == {"pass"}
    assert {verdicts[one] for one in ("R-11.2.1.2-05", "R-11.2.1.3-02", "R-11.2.2.1-13", "R-12.10-26")} == {"fail"}


# Julia


def test_julia_shows_its_habits(java: JavaBuilds, monkeypatch: pytest.MonkeyPatch) -> None:
    """As far as its table goes; the published report goes through all."""
    monkeypatch.chdir(java.folder)
    habits = HABITS["Fractal Julia 2.5.2"]
    reported = {habit.requirement for habit in habits} | {"R-12.10-17"}  # where a container is null
    reported -= {"R-12.10-07"}  # of its test purposes one is enough: the others have dozens of calls that wait for ever
    few = " or ".join((*sorted(reported), "connect/null reference", "on_init by add_component after start/asks"))
    outcome = ucm_cts(
        "run", "adapters/integrations/julia/julia-adapter", "-k", few, "--incident-time", "400", "--out", "julia"
    )
    assert (outcome.status, outcome.err) == (1, "")
    report = report_of(java.folder / "julia")
    failing = {one["id"] for one in report["requirements"] if one["verdict"] == "fail"}
    check(habits, failing, report["readings"])
    assert report["incidents"] == []
    assert "waited for ever" in "".join(report["warnings"]), "calls of what is not started wait"
    assert "error" not in {one["verdict"] for one in report["requirements"]}


def test_julia_adapter_names_missing_files(tmp_path: Path) -> None:
    tools = tmp_path / "bin"
    tools.mkdir()
    for name in ("sh", "dirname", "readlink"):
        (tools / name).symlink_to(shutil.which(name) or name)
    environment = {name: value for name, value in os.environ.items() if name != "JAVA_HOME"}
    adapter = tmp_path / "adapters" / "integrations" / "julia" / "julia-adapter"
    adapter.parent.mkdir(parents=True)
    shutil.copy(ROOT / "adapters" / "integrations" / "julia" / "julia-adapter", adapter)

    def said() -> tuple[int, str]:
        done = subprocess.run(
            [adapter], env={**environment, "PATH": str(tools)}, capture_output=True, text=True, check=False
        )
        return done.returncode, done.stderr

    assert said() == (2, "julia-adapter: there is no java; install a Java runtime, 17 or later\n")
    (tools / "java").write_text("#!/bin/sh\n")
    (tools / "java").chmod(0o755)
    assert said() == (2, f"julia-adapter: it is not built; run: mvn -q -f {tmp_path}/adapters package\n")


def test_julia_adapter_stays_thin() -> None:
    files = [*(ROOT / "adapters" / "integrations" / "julia").rglob("*.java")]
    assert 0 < sum(len(file.read_text().splitlines()) for file in files) <= 300


def test_every_message_survives_java(java: JavaBuilds) -> None:
    protocol = Protocol(json.loads(generating.SCHEMA.read_text()))
    samples = Samples(protocol)
    sent = [samples.message("to_host", one.name) for one in protocol.unions["to_host"].alternatives]
    lines = "".join(json.dumps(one) + "\n" for one in sent)
    done = run_program(["java", "-cp", "classes:lib/*", "org.ucmcts.RoundTrip"], cwd=java.folder, input=lines)
    assert [json.loads(line) for line in done.stdout.splitlines()] == sent


def test_java_is_formatted_alike() -> None:
    files = [*(ROOT / "adapters").rglob("*.java"), *(SUPPORT / "java").glob("*.java")]
    assert len(files) > 30
    for file in files:
        text = file.read_text()
        assert not re.findall(r"\t|[ ]\n|\r|\n\n\n|\n\n\}|.{121,}", text), file
        assert text.endswith("}\n") or file.name == "package-info.java", file
        imports = re.findall(r"(?m)^import (?!static)(.+);$", text)
        assert imports == sorted(imports), file


def test_the_test_command_brings_java() -> None:
    """So that nothing here is skipped where it counts."""
    commands = re.findall(r"(?m)^apt-get update .*$", (ROOT / "README.md").read_text())
    wanted = {"openjdk-17-jdk-headless", "maven"}
    assert [wanted <= set(command.split()) for command in commands if command.endswith("pipx run tox")] == [True]
