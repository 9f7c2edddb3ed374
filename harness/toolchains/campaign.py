"""One run against a tool chain: ask, judge, take a second look, and add up; the counterpart of ``running/campaign.py``."""

from __future__ import annotations

import datetime
import os
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from typing import Protocol

import msgspec

import ucm_cts
from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_requirements
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.tally import Tally, overall
from ucm_cts.harness.results.values import Effort, Processed, Report
from ucm_cts.harness.toolchains.commands.description import Task
from ucm_cts.harness.toolchains.commands.processing import Made, Processor
from ucm_cts.reference_models.findings import Finding

TASKS: dict[str, Task] = {"pim": "check", "idl": "idl", "cpp11": "cpp11", "cpp03": "cpp03"}
"""What a tool chain is asked to do for each profile."""


class Fact(msgspec.Struct, frozen=True):
    """One thing that what was made of a model says of a requirement, or, where that is empty, a remark to be counted.

    ``finding`` is None where it was kept. ``unclear`` says why it says nothing, and then counts for nothing; with ``elsewhere`` because of what another requirement is held
    to account for, so that what else is known of this one stands. ``asked`` are the
    names of the models whose processing it rests on, the last one being that which shows it.
    """

    requirement: str
    asked: tuple[str, ...]
    finding: Finding | None = None
    unclear: str = ""
    elsewhere: bool = False
    processed: Processed | None = None
    measure: str = ""


class Examination(Protocol):
    """What a profile asks of a tool chain, and how it judges what comes of it."""

    @property
    def models(self) -> Sequence[tuple[str, str]]:
        """The models to be processed, each with its name, simple ones first."""

    @property
    def not_asked(self) -> Mapping[str, str]:
        """The requirements that do not apply by what the vendor states, and why."""

    def look(self, name: str, made: Made) -> tuple[Fact, ...]:
        """What was made of one model says by itself; this may take time, and is done for several models at once."""

    def judge(self, made: Mapping[str, Made], looked: Mapping[str, tuple[Fact, ...]]) -> Iterable[Fact]:
        """What ``made``, by the names of the models, and what looking at each has shown, says."""


class ToolChainCampaign:
    """Asks a tool chain all that belongs to a profile. Use ``ask`` once, then ``judge`` and ``look_again``, then ``report``."""

    def __init__(
        self,
        processor: Processor,
        examination: Examination,
        identity: tuple[str, str],
        profile: str,
        statement: Statement,
        known_failures: Sequence[KnownFailure] = (),
        jobs: int = os.cpu_count() or 1,
        source: str = "",
        seed: int = 0,
    ) -> None:
        """``identity`` is the product and its version, ``source`` the file that describes it, ``seed`` the run's."""
        self._processor = processor
        self._examination = examination
        self._identity = identity
        self._profile = profile
        self._statement = statement
        self._known = known_failures
        self._jobs = jobs
        self._source = source
        self._seed = seed
        self._made: dict[str, Made] = {}
        self._looked: dict[str, tuple[Fact, ...]] = {}
        self._facts: list[Fact] = []
        self._tally = Tally()
        for requirement, reason in examination.not_asked.items():
            self._tally.settle(requirement, "not applicable", reason)
        self._requirements = [r for r in load_requirements() if r.profile in PARTS[profile]]
        self._measures: Counter[str] = Counter()
        self._began = time.monotonic()
        self._started = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")

    def ask(self) -> Iterator[str]:
        """Have each model processed, several at a time; yields the name of each when it is done."""
        task = TASKS[self._profile]
        models, size = self._examination.models, self._processor.at_once(task)
        waiting = iter([models[first : first + size] for first in range(0, len(models), size)])
        running: dict[Future[list[tuple[Made, tuple[Fact, ...]]]], list[str]] = {}
        with ThreadPoolExecutor(self._jobs) as pool:
            try:
                while True:
                    for some in waiting:
                        future = pool.submit(self._processed, task, some)
                        running[future] = [name for name, _ in some]
                        if len(running) >= 2 * self._jobs:
                            break
                    if not running:
                        return
                    done, _ = wait(running, return_when=FIRST_COMPLETED)
                    for future in done:
                        for name, (made, looked) in zip(running.pop(future), future.result(), strict=True):
                            self._made[name], self._looked[name] = made, looked
                            yield name
            finally:
                pool.shutdown(cancel_futures=True)

    def _processed(self, task: Task, some: Sequence[tuple[str, str]]) -> list[tuple[Made, tuple[Fact, ...]]]:
        names = (name for name, _ in some)
        made = self._processor.process_all(task, some)
        return [(one, self._examination.look(name, one)) for name, one in zip(names, made, strict=True)]

    def judge(self) -> None:
        """Judge what was made so far."""
        self._facts = list(self._examination.judge(self._made, self._looked))
        for fact in self._facts:
            self._measures[fact.measure or "facts"] += 1
            if not fact.requirement:
                continue
            if fact.unclear and fact.elsewhere:
                self._tally.explain(fact.requirement, f"{fact.asked[-1]}: {fact.unclear}")
            elif fact.unclear:
                self._tally.settle(fact.requirement, "inconclusive", f"{fact.asked[-1]}: {fact.unclear}")
            else:
                self._tally.exercised[fact.requirement] += 1
                if fact.finding is not None:
                    self._tally.add_failure(fact.finding, None, fact.processed)

    def look_again(self) -> Iterator[str]:
        """Have what broke a requirement processed once more: what does not show again is unstable, and no verdict.

        One model for each requirement is enough; yields each requirement.
        """
        texts = dict(self._examination.models)
        broken = {fact.requirement: fact for fact in reversed(self._facts) if fact.finding is not None}

        def is_shown_again(fact: Fact) -> bool:
            again = {name: self._processor.process(TASKS[self._profile], name, texts[name]) for name in fact.asked}
            looked = {name: self._examination.look(name, made) for name, made in again.items()}
            facts = self._examination.judge(self._made | again, self._looked | looked)
            return any(f.requirement == fact.requirement and f.finding and f.asked == fact.asked for f in facts)

        with ThreadPoolExecutor(self._jobs) as pool:
            try:
                for fact, shown in zip(broken.values(), pool.map(is_shown_again, broken.values()), strict=True):
                    if not shown and fact.finding is not None:
                        self._tally.mark_unstable_processed(
                            fact.finding, fact.processed, "a second try did not show it"
                        )
                    yield fact.requirement
            finally:
                pool.shutdown(cancel_futures=True)

    def report(self) -> Report:
        """All verdicts of the run so far."""
        results = self._tally.results(self._requirements, self._known)
        return Report(
            product=self._identity[0],
            version=self._identity[1],
            profile=self._profile,
            verdict=overall(results, ()),
            requirements=results,
            transitions=self._tally.transitions(load_life_cycle())[:0],
            incidents=(),
            adapter=self._source,
            suite_version=ucm_cts.__version__,
            seed=self._seed,
            started=self._started,
            seconds=round(time.monotonic() - self._began, 3),
            scenarios=len(self._made),
            events=len(self._facts),
            statement=self._statement,
            readings={},
            effort=Effort(dict(self._measures.most_common())),
        )
