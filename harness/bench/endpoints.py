"""Measures a life-cycle scenario through each endpoint, the framework alone, and other ways to test it."""

from __future__ import annotations

import importlib
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from rich.table import Table

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.programming_model import (
    ComponentObject,
    Implementation,
    PortConnection,
    PortElementObject,
)
from ucm_cts.adapters.mutants.python.subjects import CONTAINER, mutants_of
from ucm_cts.adapters.reference.python.framework import ContainerManager
from ucm_cts.harness.bench.alternatives import parametrised_test, state_machine
from ucm_cts.harness.bench.measuring import ROUNDS, empty_table, limit, medians, timed
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.host_watch import Limits
from ucm_cts.harness.hosting.hosts import Hosts
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.results.values import Incident
from ucm_cts.harness.selftest.trials import Thoroughness, all_mutants, examine_mutant
from ucm_cts.reference_models.monitor import Monitor

BATCH = 400

DIRECT = "pybind11, in process"
TRACED = "pybind11, in process, with trace"
PIPELINED = "wire, pipelined"
JUDGED = "wire, pipelined, with monitor"
STATE_MACHINE = "hypothesis' RuleBasedStateMachine, in process"
PARAMETRISED = "one parametrised pytest test a case, in process"

_ROUNDS_OF_ALTERNATIVES = 3

_SERVER, _CLIENT = "server", "client"
_PROVIDED, _REQUIRED = "in_api", "out_api"

LIFE_CYCLE = s.Scenario(
    {
        _SERVER: s.Declaration(provides=(_PROVIDED,)),
        _CLIENT: s.Declaration(requires=(_REQUIRED,)),
    },
    (
        s.AddComponent(_SERVER),
        s.AddComponent(_CLIENT),
        s.GetPortElement(_SERVER, _PROVIDED, "api"),
        s.Connect(_CLIENT, _REQUIRED, "api", "link"),
        s.Start(),
        s.Invoke("api", 1),
        s.Stop(),
        s.Disconnect("link"),
        s.RemoveComponent(_CLIENT),
        s.RemoveComponent(_SERVER),
    ),
)
"""The scenario whose cost is counted: ten operations, a whole life of two components."""

_ECHO = "import os\nwhile True:\n    data = os.read(0, 65536)\n    if not data: break\n    os.write(1, data)\n"


def tables() -> Iterator[Table]:
    """What the endpoints cost, one table after the other."""
    module: Any = importlib.import_module("ucm_cts.adapters._reference_cpp")
    cases: dict[str, Callable[[], float]] = {}
    trace = module.answer(encode(Run(0, LIFE_CYCLE)))
    with (
        Hosts(locate("reference-cpp")) as hosts,
        Hosts(locate("reference-py")) as python,
        _raw_pipe(trace) as pipe,
    ):
        hosts.welcome  # noqa: B018 - starts the host outside the measurement
        python.welcome  # noqa: B018
        cases["direct C++ loop"] = lambda: float(module.life_cycles(BATCH * 10)) / 1000
        cases[DIRECT] = lambda: timed(lambda: _direct(module), BATCH)
        cases[TRACED] = lambda: timed(lambda: _traced(module.answer), BATCH)
        cases["pybind11, in process, with trace and monitor"] = lambda: timed(lambda: _judged(module.answer), BATCH)
        cases["raw pipe, as many bytes as the trace has"] = lambda: timed(pipe, BATCH)
        cases["wire, one at a time"] = lambda: timed(lambda: _wire(hosts, 1, False), 1, BATCH)
        cases["wire, one at a time, with monitor"] = lambda: timed(lambda: _wire(hosts, 1, True), 1, BATCH)
        cases[PIPELINED] = lambda: timed(lambda: _wire(hosts, 32, False), 1, BATCH)
        cases[JUDGED] = lambda: timed(lambda: _wire(hosts, 32, True), 1, BATCH)
        cases["wire, pipelined, with monitor, Python framework"] = lambda: timed(
            lambda: _wire(python, 32, True), 1, BATCH
        )
        costs = medians(cases)
    yield _life_cycle_table(costs)
    others = {STATE_MACHINE: state_machine, PARAMETRISED: parametrised_test}
    yield _alternatives_table(costs[JUDGED], medians(others, _ROUNDS_OF_ALTERNATIVES))
    with _pinned(), _raw_pipe(encode(Run(0, ONE_CALL)) + b"\n") as ping, Hosts(locate("reference-cpp")) as hosts:
        hosts.welcome  # noqa: B018
        calls = medians(
            {
                "raw ping-pong": lambda: timed(ping, BATCH),
                "one call a message": lambda: timed(lambda: _calls(hosts, ONE_CALL, BATCH), 1, BATCH),
            }
        )
    with Hosts(locate("reference-cpp")) as hosts:
        hosts.welcome  # noqa: B018
        many = BATCH // 8
        calls |= medians(
            {
                "64 calls a message": lambda: timed(lambda: _calls(hosts, MANY_CALLS, many, 8), 1, many * 64),
                "direct Python call": lambda: timed(_direct_python_calls, BATCH, 64),
            }
        )
    yield _call_table(calls)
    restarts = {name: _restart(name) for name in ("reference-cpp", "reference-py")}
    whole = {name: _whole_run(name) for name in ("reference-cpp", "reference-py")}
    other = empty_table("Hosts and whole runs", "|reference-cpp|reference-py|limit")
    other.add_row(
        "fresh host after a crash, ms", *(f"{restarts[n]:.1f}" for n in restarts), limit(10, *restarts.values())
    )
    other.add_row("whole container run, s", *(f"{whole[n]:.2f}" for n in whole), limit(10, *whole.values()))
    each, number = _one_mutant()
    note = f"{each / whole['reference-py']:.1f} × the run of the framework it was made of"
    other.add_row(f"one mutant of the kill matrix, of {len(SAMPLE)}, s", "", f"{each:.2f}", note)
    other.add_row(f"all {number} of these clauses, two at a time, min", "", f"{each * number / 120:.1f}", "from that")
    yield other


SAMPLE = ("initialises_at_stop", "same_id_for_all", "forgets_the_last", "mixes_references_up")
"""Mutants of profile container, a sample for the cost of one."""


def _one_mutant() -> tuple[float, int]:
    """Seconds for one mutant of the container profile, and how many of them there are."""
    mutants = all_mutants()
    seconds = [examine_mutant(mutants[name], Thoroughness()).seconds for name in SAMPLE]
    return statistics.mean(seconds), len(mutants_of(CONTAINER))


def _life_cycle_table(costs: dict[str, float]) -> Table:
    direct = costs[DIRECT]
    table = empty_table("One life-cycle scenario (10 operations)", "through|µs|× direct pybind11|a second|limit")
    for name, cost in costs.items():
        aim = limit(40, cost / direct) if name == JUDGED else ""
        table.add_row(name, f"{cost:.1f}", f"{cost / direct:.1f}", f"{1e6 / cost:,.0f}", aim)
    isolation = costs[PIPELINED] - costs[TRACED]
    table.add_section()
    table.add_row(
        "isolation: the wire, pipelined, less what is in process", f"{isolation:.1f}", "", "", limit(50, isolation)
    )
    return table


def _alternatives_table(judged: float, costs: dict[str, float]) -> Table:
    table = empty_table("Ten operations, tested in another way", "with|µs|× a judged scenario through the wire")
    table.add_row("this suite, in a process of its own", f"{judged:.1f}", "1")
    for name, cost in costs.items():
        table.add_row(name, f"{cost:.1f}", f"{cost / judged:.1f}")
    return table


def _call_table(calls: dict[str, float]) -> Table:
    table = empty_table("One call, with its trace", "through|µs|ratio|limit")
    ping, python = calls["raw ping-pong"], calls["direct Python call"]
    one, many = calls["one call a message"], calls["64 calls a message"]
    table.add_row("raw ping-pong of as many bytes", f"{ping:.1f}", "1", "")
    table.add_row("one call a message, one at a time", f"{one:.1f}", f"{one / ping:.1f}", limit(2, one / ping))
    table.add_row("direct call of the Python reference framework", f"{python:.2f}", "1", "")
    table.add_row("64 calls a message", f"{many:.2f}", f"{many / python:.1f}", limit(6, many / python))
    return table


def _direct(module: Any) -> None:
    runtime = module.Runtime([(_SERVER, [_PROVIDED], []), (_CLIENT, [], [_REQUIRED])])
    server = runtime.add_component(_SERVER)
    client = runtime.add_component(_CLIENT)
    api = runtime.get_port_element(server, _PROVIDED)
    link = runtime.connect(client, _REQUIRED, api)
    runtime.start()
    runtime.exchange(api, 1)
    runtime.stop()
    runtime.disconnect(link)
    runtime.remove_component(client)
    runtime.remove_component(server)


_MONITOR = Monitor(load_life_cycle())


def _traced(answer: Callable[[bytes], bytes]) -> Traced:
    reply = from_host_decoder().decode(answer(encode(Run(0, LIFE_CYCLE))))
    assert isinstance(reply, Traced)
    return reply


def _judged(answer: Callable[[bytes], bytes]) -> None:
    assert not _MONITOR.judge(LIFE_CYCLE, _traced(answer).events).findings


def _wire(hosts: Hosts, window: int, judged: bool) -> None:
    for answer in hosts.run((Run(number, LIFE_CYCLE) for number in range(BATCH)), window):
        assert isinstance(answer.reply, Traced)
        if judged:
            assert not _MONITOR.judge(LIFE_CYCLE, answer.reply.events).findings


ONE_CALL = s.Scenario({}, (s.GetComponents(),))
MANY_CALLS = s.Scenario(
    {_SERVER: s.Declaration(provides=(_PROVIDED,))},
    (s.AddComponent(_SERVER), *(s.GetPortElement(_SERVER, _PROVIDED, "api"),) * 63),
)


def _calls(hosts: Hosts, scenario: s.Scenario, messages: int, window: int = 1) -> None:
    """Send ``messages`` with ``scenario``; with a ``window`` of 1 the next goes out when the answer is there."""
    for answer in hosts.run((Run(number, scenario) for number in range(messages)), window):
        assert isinstance(answer.reply, Traced)


class _Port(PortElementObject):
    def exchange(self, value: int) -> int:
        return ~value


class _Body(ComponentObject):
    """A body that records nothing."""

    def __init__(self) -> None:
        self.port = _Port()

    def on_init(self) -> None: ...

    def on_startup(self, dependencies: Sequence[PortConnection]) -> None: ...

    def on_shutdown(self) -> None: ...

    def on_remove(self) -> None: ...

    def get_portElement(self, provided: str) -> PortElementObject:
        return self.port

    def set_attribute(self, name: str, value: str) -> None: ...


def _direct_python_calls() -> None:
    """The calls of ``MANY_CALLS``, made directly."""
    container = ContainerManager([Implementation(_SERVER, (_PROVIDED,), (), (), False, False, _Body)])
    server = container.add_component(_SERVER, {})
    for _ in range(63):
        container.get_port_element(server, _PROVIDED)


@contextmanager
def _pinned() -> Iterator[None]:
    """Both ends of a pipe on one core: faster for ping-pong than two cores, and the same for all figures."""
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


@contextmanager
def _raw_pipe(line: bytes) -> Iterator[Callable[[], None]]:
    """A process that echoes bytes, and a function that sends these and waits for them."""
    process = subprocess.Popen([sys.executable, "-c", _ECHO], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
    assert process.stdin is not None
    assert process.stdout is not None
    out, back = process.stdin.fileno(), process.stdout.fileno()

    def ping() -> None:
        os.write(out, line)
        received = 0
        while received < len(line):
            received += len(os.read(back, 65536))

    try:
        yield ping
    finally:
        process.stdin.close()
        process.wait()


def _restart(name: str) -> float:
    """Milliseconds from the end of a host to the first answer of the next one."""
    costs = []
    with Hosts(locate(name), Limits()) as hosts:
        hosts.welcome  # noqa: B018
        for _ in range(ROUNDS):
            hosts.discard()
            costs.append(timed(lambda: _calls(hosts, ONE_CALL, 1), 1) / 1000)
    return statistics.median(costs)


def _whole_run(name: str) -> float:
    began = time.perf_counter()
    with Driver(locate(name), 1) as driver:
        campaign = Campaign(driver, "container")
        for checked in campaign.check(load_purposes("container")):
            assert not checked.failures
        assert not any(isinstance(i.incident, Incident) for i in campaign.report().incidents)
    return time.perf_counter() - began
