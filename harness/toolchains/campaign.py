"""One run against a tool chain: process, judge, confirm, and add up. ``execution/campaign.py`` does this for frameworks."""

from __future__ import annotations

import datetime
import os
import time
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import Protocol

import msgspec

import ucm_cts
from ucm_cts.harness.catalogue.requirements import requirements_of
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.tally import Tally, overall
from ucm_cts.harness.results.values import Effort, FactEvidence, ToolChainReport
from ucm_cts.harness.toolchains.commands.description import Task
from ucm_cts.harness.toolchains.commands.processing import Processor, Response
from ucm_cts.harness.toolchains.idl import omniidl
from ucm_cts.reference_models.findings import Finding

TASKS: dict[str, Task] = {"pim": "check", "idl": "idl", "cpp11": "cpp11", "cpp03": "cpp03"}
"""The task of a tool chain that each profile tests."""


class Fact(msgspec.Struct, frozen=True):
    """One statement about a requirement that follows from responses: kept, broken or undecided."""

    requirement: str
    """Empty for a remark, which is only counted."""
    models: tuple[str, ...]
    """The names of the models whose responses it rests on; the last one shows it."""
    finding: Finding | None = None
    """None unless the requirement is broken."""
    undecided: str = ""
    """Why the responses decide nothing, empty if they do."""
    leaves_others: bool = False
    """Whether other facts about the requirement still count although this one is undecided."""
    evidence: FactEvidence | None = None
    measure: str = ""
    """What this fact counts as in the report's figures."""


class Examination(Protocol):
    """The models of a profile, and the judgement on the responses of a tool chain."""

    @property
    def models(self) -> Sequence[tuple[str, str]]:
        """The models to be processed, each with its name, simple ones first."""

    @property
    def not_applicable(self) -> Mapping[str, str]:
        """The requirements that do not apply by what the vendor states, and why."""

    def examine(self, name: str, response: Response) -> tuple[Fact, ...]:
        """The facts that one response shows by itself. Slow; called for several models at once."""

    def judge(self, responses: Mapping[str, Response], shown: Mapping[str, tuple[Fact, ...]]) -> Iterable[Fact]:
        """All facts, from the responses and what ``examine`` has ``shown`` of each, by the names of the models."""


@dataclass(frozen=True)
class ToolChainPlan:
    """What a run on a tool chain is of.

    ``product``, ``version``: of the tool chain.
    ``profile``: what it is tested for.
    ``statement``: its vendor's.
    ``known_failures``: those that are expected for now.
    ``jobs``: how many calls of it may run at a time.
    ``source``: the file that describes it.
    ``seed``: of the run.
    ``first``: the names of models to begin with.
    """

    product: str
    version: str
    profile: str
    statement: Statement
    known_failures: Sequence[KnownFailure] = ()
    jobs: int = os.cpu_count() or 1
    source: str = ""
    seed: int = 0
    first: Collection[str] = ()


class ToolChainCampaign:
    """Runs a profile on a tool chain. Call ``process`` once, then ``judge`` and ``confirm``, then ``report``."""

    def __init__(self, processor: Processor, examination: Examination, plan: ToolChainPlan) -> None:
        self._processor = processor
        self._examination = examination
        self._plan = plan
        self._responses: dict[str, Response] = {}
        self._shown: dict[str, tuple[Fact, ...]] = {}
        self._facts: list[Fact] = []
        self._tally = Tally()
        self._seconds: dict[str, float] = {}
        self.is_judged = False
        self._requirements = list(requirements_of(plan.profile))
        self._measures: Counter[str] = Counter()
        self._began = time.monotonic()
        self._started = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")

    def process(self) -> Iterator[str]:
        """Have each model processed, several at a time; yields the name of each when it is done."""
        task = TASKS[self._plan.profile]
        models = sorted(self._examination.models, key=lambda model: model[0] not in self._plan.first)
        size = self._processor.at_once(task)
        waiting = iter([models[first : first + size] for first in range(0, len(models), size)])
        running: dict[Future[list[tuple[Response, tuple[Fact, ...]]]], list[str]] = {}
        with ThreadPoolExecutor(self._plan.jobs) as pool:
            try:
                while True:
                    for some in waiting:
                        future = pool.submit(self._processed, task, some)
                        running[future] = [name for name, _ in some]
                        if len(running) >= 2 * self._plan.jobs:
                            break
                    if not running:
                        return
                    done, _ = wait(running, return_when=FIRST_COMPLETED)
                    for future in done:
                        for name, (response, facts) in zip(running.pop(future), future.result(), strict=True):
                            self._responses[name], self._shown[name] = response, facts
                            yield name
            finally:
                pool.shutdown(cancel_futures=True)

    def _processed(self, task: Task, some: Sequence[tuple[str, str]]) -> list[tuple[Response, tuple[Fact, ...]]]:
        began = time.monotonic()
        responses = self._processor.process_all(task, some)
        pairs = zip(some, responses, strict=True)
        done = [(one, self._examination.examine(name, one)) for (name, _), one in pairs]
        self._seconds.update({name: (time.monotonic() - began) / len(some) for name, _ in some})
        return done

    def warnings(self) -> tuple[str, ...]:
        """What the vendor should know of how the calls went."""
        return self._processor.warnings()

    def judge(self) -> None:
        """Judge the responses so far, instead of what was judged before."""
        self._tally = Tally()
        self._measures.clear()
        for requirement, reason in self._examination.not_applicable.items():
            self._tally.settle(requirement, "not applicable", reason)
        if self._plan.profile == "idl" and omniidl.missing():  # a pass must not depend on what is installed
            self._tally.settle(omniidl.ASKED_ABOUT, "inconclusive", omniidl.missing())
        self._facts = list(self._examination.judge(self._responses, self._shown))
        for fact in self._facts:
            self._measures[fact.measure or "facts"] += 1
            if not fact.requirement:
                continue
            if fact.undecided and fact.leaves_others:
                self._tally.explain(fact.requirement, f"{fact.models[-1]}: {fact.undecided}")
            elif fact.undecided:
                self._tally.settle(fact.requirement, "inconclusive", f"{fact.models[-1]}: {fact.undecided}")
            else:
                self._tally.exercised[fact.requirement] += 1
                if fact.finding is not None:
                    self._tally.add_failure(fact.finding, fact.evidence)
        asked_by_model: dict[str, set[str]] = {}
        for fact in self._facts:
            if fact.requirement:
                asked_by_model.setdefault(fact.models[-1], set()).add(fact.requirement)
        for name, requirements in asked_by_model.items():
            for requirement in requirements:
                self._tally.seconds[requirement] += self._seconds.get(name, 0.0) / len(requirements)
        self._explain_lost()
        self.is_judged = True

    def _explain_lost(self) -> None:
        """Say of requirements that nothing exercised that models got no answer, if so."""
        lost = Counter(
            f"{response.processed.incident.kind}: {response.processed.incident.detail}"
            for response in self._responses.values()
            if response.processed.incident is not None
        )
        for reason, number in lost.most_common(1):
            for requirement in self._requirements:
                answers = f"{number} of {len(self._responses)} models got no answer ({reason})"
                self._tally.explain(requirement.id, f"its condition never arose in this run; {answers}")

    def confirm(self) -> Iterator[str]:
        """Process again one model of each broken requirement: a failure that does not show again is unstable, and no verdict.

        Yields each requirement.
        """
        texts = dict(self._examination.models)
        broken = {fact.requirement: fact for fact in reversed(self._facts) if fact.finding is not None}

        def is_shown_again(fact: Fact) -> bool:
            task = TASKS[self._plan.profile]
            again = {name: self._processor.process(task, name, texts[name], fact.requirement) for name in fact.models}
            shown = {name: self._examination.examine(name, response) for name, response in again.items()}
            facts = self._examination.judge(self._responses | again, self._shown | shown)
            return any(f.requirement == fact.requirement and f.finding and f.models == fact.models for f in facts)

        with ThreadPoolExecutor(self._plan.jobs) as pool:
            try:
                for fact, again in zip(broken.values(), pool.map(is_shown_again, broken.values()), strict=True):
                    if not again and fact.finding is not None:
                        self._tally.mark_unstable(fact.finding, fact.evidence, "a second try did not show it")
                    yield fact.requirement
            finally:
                pool.shutdown(cancel_futures=True)

    def asked_by(self, words: Collection[str]) -> set[str]:
        """The requirements that models ask about whose names hold one of ``words``."""
        return {fact.requirement for fact in self._facts if any(word in fact.models[-1].lower() for word in words)}

    def report(self) -> ToolChainReport:
        """All verdicts of the run so far."""
        results = self._tally.results(self._requirements, self._plan.known_failures)
        return ToolChainReport(
            product=self._plan.product,
            version=self._plan.version,
            profile=self._plan.profile,
            verdict=overall(results, ()),
            requirements=results,
            adapter=self._plan.source,
            suite_version=ucm_cts.__version__,
            seed=self._plan.seed,
            started=self._started,
            seconds=round(time.monotonic() - self._began, 3),
            models=len(self._responses),
            facts=sum(1 for fact in self._facts if fact.requirement),
            statement=self._plan.statement,
            effort=Effort(dict(self._measures.most_common())),
            isolation=self._processor.isolation,
        )
