"""Runs profile container on a Python adapter in this process, and mutants as the self-test does: for the tests of properties."""

from __future__ import annotations

import functools
import hashlib
import re
import resource
import signal
import time
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from types import FrameType
from typing import Any, NamedTuple

import psutil

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.mutants.python.subjects import Mutant
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.hosting.pace import waits
from ucm_cts.harness.purposes.payloads import Payloads
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.selftest.trials import Thoroughness, all_mutants, examine_mutant
from ucm_cts.harness.selftest.wording import Wording
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

_TIME = re.compile(rb'"t":\d+')


class Judged(NamedTuple):
    """The verdicts of the monitor on one trace: findings, readings seen by option, requirements exercised.

    ``asked``: the options that it asked for, each with its declared value, if it has one.
    """

    findings: tuple[Finding, ...]
    readings: Mapping[str, frozenset[str]]
    exercised: frozenset[str]
    asked: Mapping[str, str | None]


Declared = tuple[tuple[str, str], ...]

_known: dict[tuple[bytes, bytes], list[Judged]] = {}
"""Same trace, same findings, if what was asked of the statement is declared alike: what many subjects do alike, but for the time it
took, is judged once. By scenario and digest of the trace.
"""


class _Asked(dict[str, str]):
    """Declared readings that note which of them are asked for."""

    def __init__(self, declared: Declared) -> None:
        super().__init__(declared)
        self.options: set[str] = set()

    def get(self, option: str, default: Any = None) -> Any:
        self.options.add(option)
        return super().get(option, default)

    def __getitem__(self, option: str) -> str:
        self.options.add(option)
        return super().__getitem__(option)


class Product:
    """A framework that has been through the container profile, under the readings that its vendor declares.

    ``failing`` are the failing requirements, each with an example, ``exercised`` those that were exercised at all,
    ``readings`` what it makes of the freedoms of the text.
    """

    def __init__(self, adapter: type[Adapter], declared: Mapping[str, str] = {}) -> None:
        self.failing: dict[str, str] = {}
        self.readings: dict[str, set[str]] = {}
        self.exercised: set[str] = set()
        self._telling: list[tuple[str, Scenario, bytes, frozenset[str]]] = []
        engine, stated = Engine(adapter), tuple(sorted(declared.items()))
        for line, (name, scenario) in _prepared(stated).items():
            answer = engine.answer(line)
            known = _known.setdefault((line, hashlib.blake2b(_TIME.sub(b"", answer), digest_size=16).digest()), [])
            judged = next((one for one in known if all(declared.get(o) == v for o, v in one.asked.items())), None)
            if judged is None:
                judged = _judged(stated, name, scenario, answer)
                known.append(judged)
            _tell(self.failing, name, judged.findings)
            self.exercised |= judged.exercised
            for option, values in judged.readings.items():
                self.readings.setdefault(option, set()).update(values)
            if judged.readings:
                self._telling.append((name, scenario, answer, frozenset(judged.readings)))

    def failing_if(self, declared: Mapping[str, str]) -> dict[str, str]:
        """Failing requirements, each with an example, if the vendor declares these readings."""
        monitor = Monitor(load_life_cycle(), Ics(declared))
        failing: dict[str, str] = {}
        for name, scenario, answer, seen in self._telling:
            if len(declared) > 1 or seen.issuperset(declared):
                _tell(failing, name, monitor.judge(scenario, _trace(name, answer)).findings)
        return failing


def check_killed(mutant: Mutant, how: Thoroughness = Thoroughness(quick=True)) -> None:  # noqa: B008 - a frozen value
    """Examine ``mutant`` as the self-test does: in a host, under the statement, with each finding compared."""
    result = examine_mutant(all_mutants()[mutant.name], how)
    assert result.is_killed, (result.survives, result.trouble, result.incidents)
    assert not result.spills
    assert not result.wrongly_said


def check_wording(scenario: Scenario, findings: Iterable[Finding]) -> None:
    """Each finding must expect something else than what was observed, and name what it is about."""
    wording = Wording(scenario)
    for finding in findings:
        assert not wording.problem(finding), finding


def _tell(failing: dict[str, str], name: str, findings: tuple[Finding, ...] | list[Finding]) -> None:
    for f in findings:
        failing.setdefault(f.requirement, f"{name}: expected {f.expected}; observed {f.observed}")


@functools.cache
def _prepared(declared: Declared) -> dict[bytes, tuple[str, Scenario]]:
    """The suite's scenarios by what a host is sent; those that several test purposes share are there once."""
    prepared: dict[bytes, tuple[str, Scenario]] = {}
    for purpose in load_purposes("container", *map("=".join, declared)):
        for name, plain in purpose.scenarios:
            line, scenario = _sent(plain)
            prepared.setdefault(line, (name, scenario))
    return prepared


_lines: dict[bytes, tuple[bytes, Scenario]] = {}


def _sent(plain: Scenario) -> tuple[bytes, Scenario]:
    """What a host is sent of a scenario, whatever was sent before: the same under each statement."""
    key = encode(Run(0, plain))
    if key not in _lines:
        scenario = Disguise(1, "{port}_{element}").scenario(Payloads(zlib.crc32(key)).deal(plain))
        _lines[key] = encode(Run(0, scenario)), scenario
    return _lines[key]


def _trace(name: str, answer: bytes) -> Trace:
    traced = from_host_decoder().decode(answer)
    assert isinstance(traced, Traced), (name, traced)
    return traced.events


_ROOM = 1 << 30
"""Bytes that one scenario of a wrong subject may take in this process."""


_SECONDS = 20
"""How long one may take, besides what the scenario itself waits."""


class TakesTooLong(BaseException):
    """A wrong subject does not come back. No engine catches this."""


@contextmanager
def bounded(scenario: Scenario) -> Iterator[None]:
    """As a host bounds memory and time of a framework, whose calls may grow, or wait, without end. Raises ``TakesTooLong``."""

    def give_up(_number: int, _frame: FrameType | None) -> None:
        raise TakesTooLong

    before, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (_this_process().memory_info().vms + _ROOM, most))
    began, handler = time.monotonic(), signal.signal(signal.SIGALRM, give_up)
    left, interval = signal.setitimer(signal.ITIMER_REAL, _SECONDS + waits(scenario), 1)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, handler)
        if left:  # that of the whole test
            signal.setitimer(signal.ITIMER_REAL, max(left - (time.monotonic() - began), 0.001), interval)
        resource.setrlimit(resource.RLIMIT_AS, (before, most))


@functools.cache
def _this_process() -> psutil.Process:
    return psutil.Process()


def _judged(declared: Declared, name: str, scenario: Scenario, answer: bytes) -> Judged:
    traced = from_host_decoder().decode(answer)
    assert isinstance(traced, Traced), (name, traced)
    problem = contradiction(scenario, traced.events, traced.stuck)
    assert problem is None, (name, problem)
    monitor, stated = _monitor_of(declared)
    stated.options.clear()
    verdicts = monitor.judge(scenario, traced.events)
    check_wording(scenario, verdicts.findings)
    readings = {option: frozenset(values) for option, values in verdicts.readings.items()}
    asked = {option: dict.get(stated, option) for option in stated.options}
    return Judged(tuple(verdicts.findings), readings, frozenset(verdicts.exercises), asked)


@functools.cache
def _monitor_of(declared: Declared) -> tuple[Monitor, _Asked]:
    """A monitor, and the readings that it asks for."""
    stated = _Asked(declared)
    return Monitor(load_life_cycle(), Ics(stated)), stated
