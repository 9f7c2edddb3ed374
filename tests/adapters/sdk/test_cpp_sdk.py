"""The C++ SDK behind the wire."""

from __future__ import annotations

import platform
import signal
import subprocess
import time
from pathlib import Path

import pytest
from cpp_builds import LIFE, PAIR, Builds, Host, concurrent_scenarios, connect, events, talk
from protocol_messages import check_refusals, mutated_lines

from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t

pytestmark = pytest.mark.native

# the wire


def test_welcome_and_trace(builds: Builds) -> None:
    (welcome, traced), _, status = talk(builds.reference, m.Hello(m.PROTOCOL), m.Run(9, s.Scenario(PAIR, LIFE)))
    assert isinstance(welcome, m.Welcome)
    assert welcome.protocol == m.PROTOCOL
    assert isinstance(traced, m.Traced)
    assert (traced.id, traced.stuck, status) == (9, (), 0)
    assert [e.n for e in traced.events] == list(range(1, len(traced.events) + 1))
    assert [e.t for e in traced.events] == sorted(e.t for e in traced.events)
    results = [e.value for e in traced.events if isinstance(e, t.Return)]
    assert t.Reference("P", 1, "p_e") in results
    assert ~7 in results


def test_host_and_harness_accept_the_same_messages(builds: Builds) -> None:
    lines = mutated_lines()
    answers, _, status = talk(builds.program("patchbay"), b"".join(line + b"\n" for line in lines), m.Hello(m.PROTOCOL))
    assert status == 0
    check_refusals(lines, answers[:-1])
    assert isinstance(answers[-1], m.Welcome)


def test_refusals_name_the_place(builds: Builds) -> None:
    steps = b'{"type":"run","id":3,"scenario":{"components":{},"steps":[{"op":"start"},{"op":"start","x":1}]}}\n'
    plan = b'{"type":"run","id":4,"scenario":{"components":{"A":{"plan":{"on_init":[{"do":"dance"}]}}},"steps":[]}}\n'
    (first, second, third), _, _ = talk(builds.reference, steps, plan, b'{"type":"hello","protocol":7}\n')
    assert first == m.Refused("Object contains unknown field `x` - at `$.scenario.steps[1]`", 3)
    assert second == m.Refused("Invalid value 'dance' - at `$.scenario.components.A.plan.on_init[0].do`", 4)
    assert third == m.Refused(f"the harness speaks protocol 7, this host speaks {m.PROTOCOL}")


def test_streamed_events_come_first_and_are_those_of_the_trace(builds: Builds) -> None:
    threads = tuple(s.AddComponent("P", bind=f"p{n}", thread=f"t{n % 3}") for n in range(30))
    answers, _, _ = talk(builds.reference, m.Run(5, s.Scenario(PAIR, threads), stream=True))
    *streamed, traced = answers
    assert isinstance(traced, m.Traced)
    assert [a.event for a in streamed if isinstance(a, m.Happened)] == list(traced.events)
    assert len(streamed) == len(traced.events) > 100


@pytest.mark.parametrize("kind", ["tcp", "unix"])
def test_listening(builds: Builds, kind: str, tmp_path: Path) -> None:
    where = "tcp://127.0.0.1:0" if kind == "tcp" else f"unix:{tmp_path}/socket"
    server = subprocess.Popen(
        [builds.program("rude"), "--listen", where], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    )
    assert server.stdout
    try:
        address = server.stdout.readline().decode().removeprefix("listening on ").strip()
        with connect(address) as stays, connect(address) as dies:
            dies.sendall(m.encode(m.Run(1, s.Scenario({}, (s.AddComponent("abort"),)))) + b"\n")
            assert dies.recv(100) == b"", "a crash ends the connection"
            stays.sendall(m.encode(m.Hello(m.PROTOCOL)) + b"\n")
            welcome = m.from_host_decoder().decode(stays.makefile("rb").readline())
            assert isinstance(welcome, m.Welcome)
            assert welcome.product == "rude"
    finally:
        server.terminate()
        server.wait()


# frameworks that misbehave


def test_exceptions_of_operations(builds: Builds) -> None:
    steps: tuple[s.Step, ...] = (
        *(s.AddComponent(f"throw {what}") for what in ("int", "long", "text")),
        s.AddComponent("fine"),
        s.GetComponents(),
        s.RemoveComponent("unknown"),
        s.GetPortElement("fine", "p", "ref"),
        s.Invoke("ref", 1),
        s.CreateContainer("sub"),
        s.Destroy(),
    )
    raised = {e.step: e for e in events(builds.program("rude"), s.Scenario({}, steps)) if isinstance(e, t.Raise)}
    assert [raised[n].error for n in (0, 1, 2, 5, 9)] == [
        "UNDECLARED",
        "UNDECLARED",
        "NOT_FOUND",
        "BAD_PARAMETER",
        "UCM_ERROR",
    ]
    assert raised[1].detail.startswith("std::length_error: xxx")
    assert len(raised[1].detail) == 200
    assert raised[2].detail == '"quoted" ä \ufffd'
    assert raised[5].detail == "2147483645", "unknown is an id that the framework has not given out"
    assert 7 not in raised


def test_setting_up_fails(builds: Builds) -> None:
    scenario = s.Scenario({"refuse": s.Declaration()}, ())
    (refused, welcome), _, _ = talk(builds.program("rude"), m.Run(8, scenario), m.Hello(m.PROTOCOL))
    assert isinstance(refused, m.Refused)
    assert refused.id == 8
    assert "no licence" in refused.reason
    assert isinstance(welcome, m.Welcome)


def test_printing_does_not_reach_the_protocol(builds: Builds) -> None:
    (traced,), err, _ = talk(builds.program("rude"), m.Run(1, s.Scenario({}, (s.AddComponent("print"),))))
    assert isinstance(traced, m.Traced)
    assert '{"type":"welcome"}' in err


@pytest.mark.parametrize(("what", "number"), [("crash", signal.SIGSEGV), ("abort", signal.SIGABRT)])
def test_crash_is_seen_with_its_signal_and_place(builds: Builds, what: str, number: int) -> None:
    answers, err, status = talk(builds.program("rude"), m.Run(1, s.Scenario({}, (s.AddComponent(what),)), stream=True))
    assert status == -number
    assert [type(a) for a in answers] == [m.Happened]
    assert f"{signal.Signals(number).name}, thread: main" in err
    if what == "crash" and platform.libc_ver()[0] == "glibc":
        assert "crash_here" in err


def test_stuck_threads_are_named_and_end_the_host(builds: Builds) -> None:
    scenario = s.Scenario(
        {}, (s.AddComponent("hang", thread="w"), s.Join("w"), s.AddComponent("fine", thread="v")), 100
    )
    answers, _, status = talk(builds.program("rude"), m.Run(1, scenario), m.Hello(m.PROTOCOL))
    assert len(answers) == 1, "after stuck threads the host ends itself"
    assert isinstance(answers[0], m.Traced)
    assert answers[0].stuck == ("w",)
    assert [e.step for e in answers[0].events if isinstance(e, t.Timeout)] == [1]
    assert status == 0


def test_backtraces_on_request(builds: Builds) -> None:
    hold = s.Declaration(plan={"on_init": (s.HoldAtGate("g"),)})
    scenario = s.Scenario({"H": hold}, (s.AddComponent("H", thread="w"), s.ReachGate("g"), s.Join("w")), 1000)
    host = Host(builds.reference)
    host.send(m.Run(1, scenario, stream=True))
    assert host.process.stdout
    while b'"held"' not in host.process.stdout.readline():
        pass
    time.sleep(0.05)
    host.process.send_signal(signal.SIGUSR1)
    answers, err, status = host.end()
    assert "thread: main" in err
    assert "thread: worker w" in err
    assert "add_component" in err.partition("worker w")[2], "the worker's frames are named"
    assert isinstance(answers[-1], m.Traced)
    assert (answers[-1].stuck, status) == ((), 0), "and the scenario went on"


# threads and gates


def test_gates_order_threads(builds: Builds) -> None:
    trace = events(builds.reference, concurrent_scenarios()[0])
    kinds = [(type(e).__name__, getattr(e, "gate", getattr(e, "step", None)), e.thread) for e in trace]
    held = kinds.index(("Held", "startup", 1))
    asked = kinds.index(("Return", 5, 0))
    opened = kinds.index(("Opened", "startup", 0))
    started = kinds.index(("Return", 3, 1))
    assert held < asked < opened < started, "get_components is answered while start is under way"
    assert [e.ids for e in trace if isinstance(e, t.Siblings)] == [(1,)]
    assert not [e for e in trace if isinstance(e, t.Timeout)]


@pytest.mark.parametrize("sanitizer", ["asan", "tsan"])
def test_sanitizers_have_nothing_to_say(builds: Builds, sanitizer: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("UCM_CTS_LWUCM_BODIES", "generic")
    runs = [m.Run(n, scenario, stream=n % 2 == 0) for n in range(10) for scenario in concurrent_scenarios()]
    answers, err, status = talk(builds.program(sanitizer), *runs, b"junk\n")
    assert (err, status) == ("", 0)
    traces = [a for a in answers if isinstance(a, m.Traced)]
    assert len(traces) == len(runs)
    assert all(trace.stuck == () for trace in traces)
