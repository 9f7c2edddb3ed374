"""Every SDK does what suite/host_conformance says a host does."""

from __future__ import annotations

import fnmatch
import itertools
import re
import threading
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest
from cpp_builds import Builds, talk
from java_builds import JavaBuilds, java
from performing import line_of

from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.container_calls import AddComponent, GetComponents
from ucm_cts.adapters.contract.data_types import AnyType, Interface
from ucm_cts.adapters.contract.programming_model import (
    BadParameter,
    ContainerInterface,
    FragmentObject,
    Implementation,
    NotFound,
    ObjectTimer,
    PortConnection,
    PortElementObject,
    TimerHandler,
    TimerScheduler,
    UcmError,
)
from ucm_cts.adapters.contract.scenario import (
    INDEX_TIMERS,
    OBJECT_TIMERS,
    SELF_EXECUTION_API,
    TIMER_CALLBACK,
    Declaration,
    Scenario,
    Step,
)
from ucm_cts.adapters.contract.value import Value
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.execution.integrity import contradiction

__all__ = ["java"]


class Case(Value, frozen=True):
    """One behaviour of hosts: the scenario that shows it, what framework it is tried with, and the trace."""

    behaviour: str
    framework: str
    components: dict[str, Declaration]
    steps: tuple[Step, ...]
    trace: tuple[str, ...]
    patience: int = 2000
    interfaces: dict[str, Interface] = {}
    types: dict[str, dict[str, AnyType]] = {}

    @property
    def scenario(self) -> Scenario:
        return Scenario(self.components, self.steps, self.patience, self.interfaces, types=self.types)


FOLDER = Path(m.__file__).parents[2] / "suite" / "host_conformance"
CASES = [case for path in sorted(FOLDER.glob("*.yaml")) for case in read(path, list[Case])]


class Flooding(ContainerInterface):
    """Has more components than any scenario makes."""

    def get_components(self) -> Sequence[int]:
        return range(10_001)


class Timer(ObjectTimer):
    def rounds(self) -> int:
        return 3

    def id(self) -> str:
        return "t"

    def cancel(self) -> None:
        raise UcmError("too late")

    def is_cancelled(self) -> bool:
        return False


class Scheduler(TimerScheduler):
    """Triggers inside the calls. The second method returns no timer."""

    def scheduler_trigger(self, handler: TimerHandler, delay: Sequence[int]) -> ObjectTimer:
        handler.on_trigger(Timer(), delay, 0)
        return Timer()

    def schedule_repeated_trigger(
        self, handler: TimerHandler, start_delay: Sequence[int], interval: Sequence[int], max_rounds: int
    ) -> ObjectTimer | None:
        handler.on_trigger(Timer(), interval, max_rounds)
        return None


def serve_timers(implementation: Implementation) -> None:
    """Has a body use object timers and then calls its callback of index timers."""
    body = implementation.create()
    elements = [p.element or "" for p in implementation.policies if p.definition == OBJECT_TIMERS]
    body.on_startup([PortConnection(element, (Scheduler(),)) for element in elements])
    callback = body.get_policy_port(INDEX_TIMERS, TIMER_CALLBACK)
    assert callback is not None
    callback.call("on_timeout", [[5, "RELATIVE_TIME"], 7])


class RudeAdapter(Adapter):
    """Misbehaves as the name of the component to add says, like the adapters of that name in C++ and Java."""

    is_flooding = False

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        self.implementations = implementations
        return "root"

    def add_component(self, container: Any, implementation: str, attributes: Mapping[str, str]) -> int:
        if implementation == "hang":
            threading.Event().wait()
        end = time.monotonic() + 1  # other tests run in this process
        while implementation == "spin" and time.monotonic() < end:
            pass
        if implementation == "throw text":
            raise NotFound("text")
        if implementation == "throw long":
            raise OSError("x" * 300)
        self.is_flooding = implementation == "many"
        return 2**31 - 1

    def remove_component(self, container: Any, comp_instance: int) -> None:
        raise BadParameter(str(comp_instance))

    def get_port_element(self, container: Any, comp_instance: int, port_name: str) -> PortElementObject | None:
        return None

    def connect(self, container: Any, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        return 0

    def disconnect(self, container: Any, connection: int) -> None: ...

    def start(self, container: Any) -> None:
        for one in self.implementations:
            if one.name == "timed":
                serve_timers(one)
                continue
            body = one.create()
            for policy in one.policies:
                element = body.get_policy_element(policy.definition, SELF_EXECUTION_API)
                if element is not None:
                    element.run()
            if one.name == "flooded":
                assert isinstance(body, FragmentObject)
                body.set_container_interface(Flooding())
                body.on_startup([PortConnection("out", ())] * 10_001)

    def stop(self, container: Any) -> None: ...

    def get_components(self, container: Any) -> Sequence[int]:
        return [2**31 - 2] * (10_001 if self.is_flooding else 1)

    def create_container(self, manager: Any) -> Any:
        return "sub"

    def remove_container(self, manager: Any, sub_container: Any) -> None: ...

    def advance(self, manager: Any, milliseconds: int) -> None:
        raise BadParameter(str(milliseconds))

    def destroy(self, manager: Any) -> None:
        raise UcmError("never")


PYTHON = {"strict": ReferenceAdapter, "rude": RudeAdapter}


def check(case: Case, answer: m.FromHost) -> None:
    """``answer`` is a trace that can be true, with the events of ``case``."""
    assert isinstance(answer, m.Traced), answer
    assert contradiction(case.scenario, answer.events, answer.stuck) is None
    lines = [line_of(event) for event in answer.events] + [f"stuck {name}" for name in answer.stuck]
    expected = list(case.trace)
    if expected[0] == "*":  # what comes first is the matter of another case
        expected = expected[1:]
        lines = lines[-len(expected) :]
    assert all(wait < case.patience / 2 for wait in _settling(answer.events)), _settling(answer.events)
    unlike = [(line, due) for line, due in zip(lines, expected, strict=False) if not _is(line, due)]
    assert (len(lines), unlike) == (len(expected), []), "\n".join(lines)


def _settling(trace: t.Trace) -> list[float]:
    """How long each settle took whose worker was found to be done, held or blocked, in milliseconds.

    Such a step does not wait for the patience to run out; half of it leaves room for a machine that is busy otherwise.
    """
    steps = [event for event in trace if not event.thread]
    settled = [(a, b) for a, b in itertools.pairwise(steps) if isinstance(b, t.Settled) and b.where != "running"]
    return [(b.t - a.t) / 1e6 for a, b in settled]


def _is(line: str, due: str) -> bool:
    return fnmatch.fnmatchcase(line, re.sub(r"\[", "[[]", due))


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.behaviour)
def test_python(case: Case) -> None:
    line = Engine(PYTHON[case.framework]).answer(m.encode(m.Run(1, case.scenario)))
    check(case, m.from_host_decoder().decode(line))


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.behaviour)
def test_cpp(case: Case, builds: Builds) -> None:
    program = builds.reference if case.framework == "strict" else builds.program("rude")
    (answer,), _, status = talk(program, m.Run(1, case.scenario))
    assert status == 0
    check(case, answer)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.behaviour)
def test_java(case: Case, java: JavaBuilds) -> None:
    (answer,), _, status = talk(java.program(f"{case.framework.capitalize()}Adapter"), m.Run(1, case.scenario))
    assert status == 0
    check(case, answer)


MANY = m.Run(1, Scenario({}, (AddComponent("many"), GetComponents())))
TOO_MANY = "get_components returned more than 10000 ids, which no scenario can have led to"


def check_refused(answer: m.FromHost) -> None:
    assert isinstance(answer, m.Refused), answer
    assert answer.reason.endswith(TOO_MANY), answer.reason


def test_python_refuses_too_many_ids() -> None:
    check_refused(m.from_host_decoder().decode(Engine(RudeAdapter).answer(m.encode(MANY))))


def test_cpp_refuses_too_many_ids(builds: Builds) -> None:
    check_refused(talk(builds.program("rude"), MANY)[0][0])


def test_java_refuses_too_many_ids(java: JavaBuilds) -> None:
    check_refused(talk(java.program("RudeAdapter"), MANY)[0][0])
