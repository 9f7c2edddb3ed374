"""Quick trials of mutated Python frameworks, in a forked process of this one: enough for most mutants.

A quick trial reports a failure that a second run with more patience shows again, and a framework that cannot be loaded.
The ordinary pipeline decides all other cases; the quick trial tells it which purpose to run first.
"""

from __future__ import annotations

import importlib
import os
import re
import resource
import select
import signal
import sys
import time
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

import msgspec

from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.scenario import Burst, Scenario, Stress
from ucm_cts.adapters.contract.value import Value
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.clock_gaps import ClockGaps
from ucm_cts.harness.execution.confirmation import is_timed
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.payloads import Payloads
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.selftest.generated.trial import MORE_PATIENCE, Outcome
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor

SECONDS = 10
"""What a scenario may take before the quick trial is given up."""

BYTES = 4 << 30
"""Address space that a forked process may take beside what it has from its parent."""

FAVOURITES = 40
"""Scenarios that killed most mutants so far are tried first."""


class QuickTrial(Value, frozen=True):
    """``outcome`` if there is one already; otherwise ``suspect`` is the purpose in which something went wrong, if any did."""

    outcome: Outcome | None = None
    suspect: str = ""


@dataclass(frozen=True)
class Prepared:
    """A scenario as the framework is given it, and the line that asks for it."""

    purpose: str
    clause: str
    name: str
    scenario: Scenario
    may_stay: frozenset[str]
    line: bytes

    def patiently(self) -> Prepared:
        """The same with more patience: a failure that is found again counts."""
        scenario = msgspec.structs.replace(self.scenario, patience=MORE_PATIENCE * self.scenario.patience)
        return replace(self, scenario=scenario, line=encode(Run(0, scenario)))


_TIME = re.compile(rb'"(t|calendar)":\d+')


@dataclass
class QuickTrials:
    """Tries one mutant after the other, and learns which scenarios find out most of them."""

    statement: Statement
    purposes: Sequence[TestPurpose]
    seed: int
    silence: float = SECONDS
    _prepared: list[Prepared] = field(default_factory=list)
    _killers: Counter[str] = field(default_factory=Counter)
    _right: set[bytes] = field(default_factory=set)
    _clock_gaps: ClockGaps | None = None

    def __post_init__(self) -> None:
        disguise, payloads = Disguise(self.seed, "{port}_{element}"), Payloads(self.seed)
        for purpose in self.purposes:
            for name, plain in purpose.scenarios:
                if not _takes_time(plain):
                    scenario = disguise.scenario(payloads.deal(plain))
                    line = encode(Run(0, scenario))
                    self._prepared.append(
                        Prepared(purpose.id, purpose.clause, name, scenario, frozenset(plain.may_stay), line)
                    )
        self._monitor = Monitor(load_life_cycle(), self.statement.ics)

    def try_out(self, adapter: str, clauses: Sequence[str]) -> QuickTrial:
        """Try ``adapter``, ``package.module:Class``, whose package can be found; purposes of ``clauses`` come first."""
        began = time.monotonic()
        reading, writing = os.pipe()
        child = os.fork()
        if child == 0:
            self._be_child(adapter, tuple(clauses), writing)
        os.close(writing)
        received = _read(reading, self.silence)
        os.close(reading)
        with suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        *at, last = received.split(b"\n") or [b""]
        trial = (
            msgspec.json.decode(last, type=QuickTrial) if last.startswith(b"{") else QuickTrial(None, _last(at, last))
        )
        if trial.outcome is not None:
            self._killers[trial.outcome.scenario] += 1
            seconds = round(time.monotonic() - began, 2)
            return QuickTrial(msgspec.structs.replace(trial.outcome, seconds=seconds))
        return trial

    def _be_child(self, adapter: str, clauses: tuple[str, ...], writing: int) -> None:
        most = _address_space() + BYTES
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)
        try:
            self._clock_gaps = ClockGaps().start()
            os.write(writing, msgspec.json.encode(self._examine(adapter, clauses, writing)))
        finally:
            os._exit(0)

    def _examine(self, adapter: str, clauses: tuple[str, ...], writing: int) -> QuickTrial:
        module, _, name = adapter.partition(":")
        sys.dont_write_bytecode = True
        try:
            engine = Engine(getattr(importlib.import_module(module), name))
        except BaseException as error:  # noqa: BLE001 - a mutant may raise anything
            return QuickTrial(Outcome("not loaded", type(error).__name__, detail=str(error)))
        favourites = {name for name, _ in self._killers.most_common(FAVOURITES)}

        def late(one: Prepared) -> tuple[bool, bool]:
            return one.name not in favourites, not one.clause.startswith(clauses)

        for one in sorted(self._prepared, key=late):
            os.write(writing, one.purpose.encode() + b"\n")
            findings = self._findings(engine, one)
            if findings is None:
                return QuickTrial(None, one.purpose)
            if findings and (again := self._findings(engine, one.patiently())):
                first = again[0]
                return QuickTrial(Outcome("failed", first.requirement, one.name, f"{first.rule}: {first.observed}"))
        return QuickTrial()

    def _findings(self, engine: Engine, one: Prepared) -> list[Finding] | None:
        """The failure, unless a clock gap may have caused it; None if only the pipeline can decide."""
        answer = engine.answer(one.line)
        if _TIME.sub(b"", answer) in self._right:
            return []
        reply = from_host_decoder().decode(answer)
        if not isinstance(reply, Traced) or not one.may_stay.issuperset(reply.stuck):
            return None
        if contradiction(one.scenario, reply.events, reply.stuck) is not None:
            return None
        stalled = self._clock_gaps is None or self._clock_gaps.longest(reply.events)
        found = self._monitor.judge(one.scenario, reply.events).findings
        return [finding for finding in found if not (stalled and is_timed(finding))]

    def learn(self, engine: Engine) -> None:
        """Keep the answers of the original framework: equal answers need no monitor."""
        for one in self._prepared:
            reply = engine.answer(one.line)
            trace = from_host_decoder().decode(reply)
            if isinstance(trace, Traced) and not trace.stuck and not self._findings(engine, one):
                self._right.add(_TIME.sub(b"", reply))


def _address_space() -> int:
    """Bytes that this process has already, those of its threads' stacks included."""
    pages, _, _ = Path("/proc/self/statm").read_text().partition(" ")
    return int(pages) * resource.getpagesize()


def _takes_time(scenario: Scenario) -> bool:
    if any(isinstance(step, Stress) for step in scenario.steps):
        return True
    plans = (actions for declaration in scenario.components.values() for actions in declaration.plan.values())
    return any(isinstance(action, Burst) for actions in plans for action in actions)


def _read(reading: int, seconds: float) -> bytes:
    """All that comes before the other end is closed, or is silent for too long."""
    received = b""
    while select.select([reading], [], [], seconds)[0]:
        part = os.read(reading, 1 << 16)
        if not part:
            break
        received += part
    return received


def _last(before: Sequence[bytes], last: bytes) -> str:
    return next((part.decode() for part in (last, *reversed(before)) if part), "")
