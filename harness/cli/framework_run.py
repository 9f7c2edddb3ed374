"""Certifies a framework (``ucm-cts run ADAPTER``), once or several times, and keeps what was measured whatever happens."""

from __future__ import annotations

import functools
import hashlib
import time
from collections.abc import Collection, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn, Protocol

import msgspec

import ucm_cts
from ucm_cts.adapters.contract.messages import Welcome
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.cli.last_run import failed_in
from ucm_cts.harness.cli.one_run import carry_out
from ucm_cts.harness.cli.options import Budget, greet, leave_with, name_of, nothing_selected
from ucm_cts.harness.cli.run_checkpoints import CHECKPOINTS, Checkpoints
from ucm_cts.harness.cli.terminal import Interrupts, Output, ends_like_interrupts
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.campaign_state import CampaignState
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.execution.judging import Judge, SideJudge, may_judge_aside
from ucm_cts.harness.execution.repeating import repeated, steady_search
from ucm_cts.harness.exploring.in_runs import DRAWN_SCENARIOS, exploration_in, remember_in
from ucm_cts.harness.hosting.hosts import HostUnavailable
from ucm_cts.harness.hosting.locate import Endpoint, WrongUse, locate
from ucm_cts.harness.hosting.pace import waits
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import asked_by, select
from ucm_cts.harness.report.write import keep_report, report_folder
from ucm_cts.harness.results.known_failures import KnownFailure, known_today
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.tally import ended_early, of_selection
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import check_subject, stated_by

KEPT_EVERY = 60
"""After so many seconds, what a run has measured is kept again."""

MANY_SCENARIOS = 500
"""A run of so many scenarios has some of them judged on another core."""


@dataclass(frozen=True)
class FrameworkRun:
    """What a user wants: the arguments of ``ucm-cts run``.

    ``seed``: of the first run; ``is_seeded``: the user named it. ``explore``: what drawing scenarios may cost after the test
    purposes of a whole profile. ``hidden``: what hosts must not see, besides the report. ``everything``: the summary lists everything.
    """

    adapter: str
    profile: str
    expression: str
    seed: int
    out: Path
    known_failures: Path | None
    ics: Path | None
    repeat: int
    in_process: bool
    virtual_time: bool
    jobs: int | None
    limits: Limits
    systematic: int
    explore: Budget
    everything: bool
    failed_first: bool
    resume: bool
    is_seeded: bool
    sandbox: bool = True
    hidden: tuple[Path, ...] = ()


class Keeper(Protocol):
    """Makes something of a run beside its report."""

    def driver(self, endpoint: Endpoint, seed: int, limits: Limits) -> Driver:
        """The driver of the run."""

    def begin(self, driver: Driver, statement: Statement, known: tuple[KnownFailure, ...]) -> None:
        """The first host is there, and nothing was run yet. Raises ``WrongUse``."""

    def measured(self, driver: Driver) -> None:
        """Everything was run, and the hosts are still there."""

    def finish(self, report: FrameworkReport, wanted: FrameworkRun, known: tuple[KnownFailure, ...]) -> str:
        """The report is written. Returns a line about what was made of the run. Raises ``WrongUse``."""


def certify_framework(wanted: FrameworkRun, keeper: Keeper | None = None) -> NoReturn:
    """Run it, write the report, and end. Raises ``WrongUse``, ``DocumentError`` and ``HostUnavailable``.

    With a ``keeper`` scenarios that failed in earlier runs are not tried again: what is run follows from the arguments.
    """
    console = Output()
    hidden = [wanted.out, *wanted.hidden]
    endpoint = locate(
        wanted.adapter, wanted.in_process, sandbox=wanted.sandbox, hidden=hidden, virtual_time=wanted.virtual_time
    )
    known = known_today(wanted.known_failures)
    statement = stated_by(wanted.ics, wanted.adapter, wanted.sandbox)
    offered = purposes_for(statement, wanted.profile, wanted.systematic)
    purposes = select(offered, wanted.expression) if wanted.expression else offered
    if not purposes:
        names = (name for purpose in offered for name in (purpose.id, purpose.clause, *purpose.requirements))
        raise nothing_selected(wanted.expression, names, "test purpose")
    with (
        ends_like_interrupts() as interrupts,
        interrupts.held(),  # nothing is lost between the places that permit interrupts
        report_folder(wanted.out, CHECKPOINTS) as folder,
    ):
        if not wanted.virtual_time and _hosts_at_once(wanted, statement, keeper) > 1:
            purposes = tuple(sorted(purposes, key=_lateness))
        if wanted.failed_first:
            failed = failed_in(wanted.out, console).requirements
            purposes = tuple(sorted(purposes, key=lambda purpose: not failed.intersection(purpose.requirements)))
        plan = _Plan(wanted, endpoint, statement, known, purposes, keeper)
        series = _Series(plan, Checkpoints(folder, _measured(plan)), console, interrupts)
        incomplete = series.run()
        report = ended_early(series.joined(), incomplete)
        if wanted.expression:
            report = of_selection(report, wanted.expression, asked_by(purposes, wanted.expression))
        saved = keep_report(report, folder, () if report.incomplete else CHECKPOINTS)
        problem = remember_in(wanted.out, report)
        if problem:
            console.say(problem)
        if keeper is not None:
            console.say(keeper.finish(report, wanted, known))
        leave_with(console, report, saved, known, wanted.everything)


@dataclass(frozen=True)
class _Plan:
    """What a run is of: what the user ``wanted``, and what that leads to."""

    wanted: FrameworkRun
    endpoint: Endpoint
    statement: Statement
    known: tuple[KnownFailure, ...]
    purposes: Sequence[TestPurpose]
    keeper: Keeper | None


class _Series:
    """One run, or several with a seed each; ``reports`` has one for each."""

    def __init__(self, plan: _Plan, checkpoints: Checkpoints, console: Output, interrupts: Interrupts) -> None:
        self._plan = plan
        self._wanted = plan.wanted
        self._checkpoints = checkpoints
        self._console = console
        self._interrupts = interrupts
        self._seed = plan.wanted.seed
        self._explore = Budget(0) if plan.wanted.expression else plan.wanted.explore
        self._is_greeted = False
        self._state: CampaignState | None = None
        self.reports: list[FrameworkReport] = []

    def run(self) -> str:
        """Run what is wanted. Returns why that ended early, empty if it did not; raises what prevents the first run."""
        if self._wanted.resume:
            self._resume()
        problem = self._run_once() if self.reports and len(self.reports) == self._wanted.repeat else ""
        while not problem and len(self.reports) < self._wanted.repeat:
            problem = self._run_once()
        return problem

    def _resume(self) -> None:
        self.reports, self._state = self._checkpoints.read(self._wanted.seed if self._wanted.is_seeded else None)
        known = self.reports[0] if self.reports else self._state.report if self._state is not None else None
        assert known is not None
        self._seed = known.seed
        self.reports = self.reports[: self._wanted.repeat]
        ended = f"{len(self.reports)} of {self._wanted.repeat} runs had ended before"
        part = (
            f", and {len(self._state.done)} of {len(self._plan.purposes)} test purposes"
            if self._state is not None
            else ""
        )
        self._console.say(f"{ended}{part}")

    def joined(self) -> FrameworkReport:
        """One report of all runs. What differs between them is searched for, unless nothing more is to be run."""
        try:
            with self._interrupts.permitted():
                return repeated(
                    self.reports, steady_search(self._plan.endpoint, self._wanted.limits, self._plan.statement.ics)
                )
        except (HostUnavailable, KeyboardInterrupt):
            return repeated(self.reports, lambda failed, seed: None)

    @property
    def _hosts_at_once(self) -> int:
        return _hosts_at_once(self._wanted, self._plan.statement, self._plan.keeper)

    def _run_once(self) -> str:
        """Run the next one, if one is missing. Returns why the series is not to go on, empty if it is."""
        number, of = len(self.reports) + 1, self._wanted.repeat
        which = f"run {number} of {of}"
        try:
            keeper = self._plan.keeper
            make = keeper.driver if keeper is not None else functools.partial(Driver, jobs=self._hosts_at_once)
            with (
                self._judge() as judge,
                make(self._plan.endpoint, self._seed + number - 1, self._wanted.limits) as driver,
            ):
                with self._interrupts.permitted():
                    identity = driver.identity
                known = [*self.reports, *([self._state.report] if self._state is not None else [])]
                if known and not _is_of(identity, known[0]):
                    another = f"another product, '{name_of(identity)}'"
                    if not self._is_greeted:
                        raise _Misfit(f"the runs that had ended before are of {another}; leave out --resume")
                    return f"{which} was of {another}"
                if not self._is_greeted:
                    check_subject(self._plan.statement, identity, self._wanted.profile)
                    greet(self._console, name_of(identity), self._wanted.profile, self._seed)
                    self._is_greeted = True
                    if keeper is not None:
                        keeper.begin(driver, self._plan.statement, self._plan.known)
                return self._measure(driver, judge, f"{which}: " if of > 1 else "") if number <= of else ""
        except _Misfit:
            raise
        except KeyboardInterrupt:
            if not self.reports:
                raise
            return f"interrupted before {which} had begun"
        except (HostUnavailable, WrongUse) as problem:
            if not self.reports:
                raise
            return f"{which} could not begin: {problem}"

    def _judge(self) -> AbstractContextManager[Judge]:
        """The judge of a run. One that is recorded is judged answer by answer, as it will be judged again."""
        scenarios = sum(len(purpose.scenarios) for purpose in self._plan.purposes)
        aside = self._plan.keeper is None and scenarios >= MANY_SCENARIOS and may_judge_aside()
        return SideJudge(self._plan.statement.ics) if aside else nullcontext(Judge(self._plan.statement.ics))

    def _measure(self, driver: Driver, judge: Judge, which: str) -> str:
        campaign = Campaign(driver, self._wanted.profile, self._plan.known, self._plan.statement, judge)
        done: Collection[str] = ()
        if self._state is not None:
            campaign.restore(self._state)
            done, self._state = self._state.done, None
        problem = ""
        try:
            with self._interrupts.permitted():
                self._check(campaign, which, done)
        except KeyboardInterrupt:
            state = campaign.state
            problem = f"interrupted after {len(state.done)} of {len(self._plan.purposes)} test purposes"
            self._checkpoints.keep_part(len(self.reports) + 1, state, self._console)
        if problem and self.reports:  # half a run would make verdicts unstable
            return f"{problem} of run {len(self.reports) + 1}"
        if self._plan.keeper is not None and not problem:
            self._plan.keeper.measured(driver)
        self.reports.append(campaign.report(problem))
        if self._wanted.repeat > 1 and not problem:
            self._checkpoints.keep(len(self.reports), self.reports[-1], self._console)
        left = self._wanted.repeat - len(self.reports)
        return problem or (f"interrupted when {left} runs were left" if self._interrupts.came and left else "")

    def _check(self, campaign: Campaign, which: str, done: Collection[str]) -> None:
        kept = time.monotonic()

        def between() -> None:
            nonlocal kept
            if time.monotonic() - kept > KEPT_EVERY:
                with self._interrupts.held():
                    self._checkpoints.keep_part(len(self.reports) + 1, campaign.state, self._console)
                kept = time.monotonic()
            if self._interrupts.came:
                raise KeyboardInterrupt

        draw = (lambda: self._draw(campaign)) if self._explore.amount else None
        hosts = 0 if self._plan.endpoint.virtual_time else self._hosts_at_once
        carry_out(campaign, self._plan.purposes, draw, self._console, which, done, between, hosts)

    def _draw(self, campaign: Campaign) -> int:
        """Try failures that drawn scenarios showed before, then draw scenarios. Returns how many causes of failure they show.

        All runs of a series draw the same scenarios, as far as the framework does the same.
        """
        exploration = exploration_in(self._wanted.out if self._plan.keeper is None else None, campaign, self._seed)
        known = exploration.replay()
        began, failures, far = time.monotonic(), 0, 0
        for progress in exploration.explore():
            failures, far = progress.failures, progress.scenarios
            if self._interrupts.came:
                raise KeyboardInterrupt
            if self._explore.spent(far, time.monotonic() - began) >= self._explore.amount:
                break
        campaign.count(DRAWN_SCENARIOS, far)
        self._explore = Budget(far, is_time=False)
        return max(failures, sum(one.fate == "still there" for one in known))


class _Misfit(WrongUse):
    """What was resumed is not of this product."""


def _hosts_at_once(wanted: FrameworkRun, statement: Statement, keeper: Keeper | None) -> int:
    """A run that is recorded has one, so that its answers can be taken in their order again."""
    return 1 if keeper is not None else wanted.jobs or statement.hosts_at_once


def _lateness(purpose: TestPurpose) -> tuple[bool, bool]:
    """What may wait comes late, because further hosts wait for it meanwhile; but all requirements come before their dimensions."""
    return purpose.of_dimensions, any(waits(scenario) > 0 for _, scenario in purpose.scenarios)


def _is_of(identity: Welcome, report: FrameworkReport) -> bool:
    return (identity.product, identity.version) == (report.product, report.version)


def _measured(plan: _Plan) -> tuple[object, ...]:
    """All that two runs must have in common to be of one series."""
    wanted, endpoint = plan.wanted, plan.endpoint
    target = Path(endpoint.target)
    return (
        ucm_cts.__version__,
        [(r.id, r.rules, r.level) for r in load_requirements()],
        [
            (purpose.id, purpose.requirements, purpose.scenarios)
            for purpose in sorted(plan.purposes, key=lambda p: p.id)
        ],
        (endpoint.text, endpoint.kind, endpoint.target, endpoint.in_process, endpoint.virtual_time),
        hashlib.sha256(target.read_bytes()).hexdigest() if target.is_file() else "",
        (wanted.profile, wanted.expression, wanted.systematic),
        msgspec.structs.replace(plan.statement, folder=""),
        (wanted.limits.seconds, wanted.limits.memory, wanted.limits.incident_seconds),
        plan.known,
    )
