"""Runs the suite under pytest: one node a test purpose. Loaded by the suite's test module.

The host and the verdicts live as long as the session; each node runs its purpose's scenarios on them.
"""

from __future__ import annotations

import random
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import cast

import click
import pytest

from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.catalogue.requirements import decides, load_requirements
from ucm_cts.harness.cli.options import Budget, DrawnScenarios
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.exploring.in_runs import DRAWN_SCENARIOS, exploration_in, remember_in
from ucm_cts.harness.hosting.hosts import HostUnavailable
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.report.diagrams.sequence_text import failure_text
from ucm_cts.harness.report.order import not_followed
from ucm_cts.harness.report.write import keep_report, report_folder
from ucm_cts.harness.results.known_failures import known_today, stale, waiver_for
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, Execution, FrameworkReport
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import check_subject, stated_by
from ucm_cts.reference_models.findings import Finding

_SUITE = "ucm_cts.suite.test_conformance"


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """One node a test purpose of the profile, named by its clause and its id.

    For ``-k``, a clause can be written with underscores, too: ``-k 10_1_6``.
    """
    if metafunc.module.__name__ != _SUITE or "purpose" not in metafunc.fixturenames:
        return
    purposes = purposes_for(statement_of(metafunc.config), metafunc.config.getoption("--iut-profile"))
    metafunc.parametrize("purpose", purposes, ids=[f"{p.clause}-{p.id}".replace(" ", "-") for p in purposes])


def pytest_itemcollected(item: pytest.Item) -> None:
    """Let ``-k`` find the clause of a node under its name with underscores."""
    if isinstance(item, pytest.Function) and item.module.__name__ == _SUITE and "purpose" in item.fixturenames:
        purpose = cast(TestPurpose, item.callspec.params["purpose"])
        item.extra_keyword_matches.add(purpose.clause.replace(".", "_"))


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Without a budget no scenarios are drawn."""
    drawn = [item for item in items if isinstance(item, pytest.Function) and "check_drawn" in item.fixturenames]
    if drawn and not budget_of(config).amount:
        config.hook.pytest_deselected(items=drawn)
        items[:] = [item for item in items if item not in drawn]


def budget_of(config: pytest.Config) -> Budget:
    """What drawing scenarios may cost. Raises ``pytest.UsageError``."""
    try:
        return DrawnScenarios(or_none=True).convert(config.getoption("--iut-explore"), None, None)
    except click.BadParameter as error:
        raise pytest.UsageError(f"--iut-explore: {error.message}") from None


def statement_of(config: pytest.Config) -> Statement:
    """What the vendor states. Raises ``pytest.UsageError``."""
    if _STATEMENT not in config.stash:
        given = config.getoption("--iut-ics")
        try:
            config.stash[_STATEMENT] = stated_by(Path(given) if given else None, config.getoption("--iut") or "")
        except (WrongUse, DocumentError) as error:
            raise pytest.UsageError(str(error)) from None
    return config.stash[_STATEMENT]


@pytest.fixture(scope="session")
def campaign(request: pytest.FixtureRequest) -> Iterator[Campaign]:
    """The run against ``--iut``; its report is written when the session ends."""
    config = request.config
    adapter, out, seed, list_of_known = (
        config.getoption(f"--iut{name}") for name in ("", "-out", "-seed", "-known-failures")
    )
    if not adapter:
        message = "say which implementation to test: --iut ADAPTER, for instance --iut reference-py"
        pytest.exit(f"ucm-cts: {message}", returncode=2)
    statement = statement_of(config)
    drawn = seed if seed is not None else random.SystemRandom().randrange(2**32)
    given = {
        limit: config.getoption(f"--iut-{name}")
        for limit, name in (("seconds", "timeout"), ("memory", "memory"), ("incident_seconds", "incident-time"))
    }
    limits = Limits(**{limit: value for limit, value in given.items() if value is not None})
    with ExitStack() as cleanup:
        try:
            known = known_today(Path(list_of_known) if list_of_known else None)
            endpoint = locate(
                adapter,
                config.getoption("--iut-in-process"),
                sandbox=not config.getoption("--iut-no-sandbox"),
                hidden=[out] if out else [],
            )
            driver = cleanup.enter_context(Driver(endpoint, drawn, limits, statement.hosts_at_once))
            _ = driver.disguise  # starts a host, which identifies the adapter
            profile = config.getoption("--iut-profile")
            check_subject(statement, driver.identity, profile)
            running = Campaign(driver, profile, known, statement)
            folder = cleanup.enter_context(report_folder(Path(out))) if out else None
        except (WrongUse, DocumentError, HostUnavailable) as error:
            pytest.exit(f"ucm-cts: {error}", returncode=2)
        yield running
        interrupted = _is_interrupted(request.session)
        if not interrupted:
            running.confirm()
        if out and not interrupted:
            for _ in running.shorten():
                pass
        report = running.report(_ended_early(request.session, len(running.checked)))
        config.stash[_UNDECIDED] = _undecided(running, report)
        config.stash[_ADVICE] = [f"{r.id}: {r.title}" for r in not_followed(report.requirements)]
        if folder is not None:
            saved = keep_report(report, folder)
            forgotten = remember_in(Path(out), report)
            config.stash[_UNDECIDED] += [forgotten] if forgotten else []
            if saved.problem:
                where = f"it is in '{saved.place}'" if saved.place is not None else "no folder took it"
                config.stash[_UNDECIDED].append(f"the report cannot be written: {saved.problem}; {where}")


def _ended_early(session: pytest.Session, done: int) -> str:
    """Why the session ended before its end, empty if it did not."""
    early = "interrupted" if _is_interrupted(session) else session.shouldfail or session.shouldstop
    return f"{early} after {done} test purposes" if early else ""


def _is_interrupted(session: pytest.Session) -> bool:
    return session.exitstatus == pytest.ExitCode.INTERRUPTED


_UNDECIDED = pytest.StashKey[list[str]]()
_ADVICE = pytest.StashKey[list[str]]()
_STATEMENT: pytest.StashKey[Statement] = pytest.StashKey()


def _undecided(campaign: Campaign, report: FrameworkReport) -> list[str]:
    """One line for each requirement that no node shows and that did not pass. After a selection, only selected ones count."""
    meant = {requirement for purpose in campaign.checked for requirement in purpose.requirements}
    whole = len(campaign.checked) == len(purposes_for(campaign.statement, report.profile))
    lines = [
        f"{r.verdict} {r.id}: {r.reason}"
        for r in report.requirements
        if r.verdict in ("inconclusive", "error") and r.decides and (whole or r.id in meant)
    ]
    lines += [
        f"fail {r.id}: expected {f.finding.expected}; observed {f.finding.observed}"
        for r in report.requirements
        for f in r.findings
        if f.execution is None and not f.waived and r.decides and (whole or r.id in meant)
    ]
    if whole:
        lines += [
            f"known failure of {entry.requirement} no longer occurs ({entry.observed}): remove it"
            for entry in stale(campaign.known, report.requirements)
        ]
    return lines


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Nothing passes without having been exercised."""
    if session.config.stash.get(_UNDECIDED, []) and session.exitstatus == pytest.ExitCode.OK:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Print the requirements without a verdict, and the recommendations that were not followed."""
    lines = config.stash.get(_UNDECIDED, [])
    if lines:
        terminalreporter.section("UCM conformance is not established", red=True)
        for line in lines:
            terminalreporter.write_line(line)
    advice = config.stash.get(_ADVICE, [])
    if advice:
        terminalreporter.section("Recommendations not followed", yellow=True)
        for line in advice:
            terminalreporter.write_line(line)


@pytest.fixture
def check(campaign: Campaign) -> object:
    """Run a purpose and fail with what was expected and what was observed. Recommendations fail nothing."""

    def run(purpose: TestPurpose) -> None:
        for checked in campaign.check([purpose]):
            _fail_with(checked.failures, campaign)

    return run


@pytest.fixture
def check_drawn(campaign: Campaign, request: pytest.FixtureRequest) -> object:
    """Draw and run scenarios, and fail with one of each cause."""

    def run() -> None:
        out, budget = request.config.getoption("--iut-out"), budget_of(request.config)
        exploration = exploration_in(Path(out) if out else None, campaign, campaign.report().seed)
        exploration.replay()
        began, drawn = time.monotonic(), 0
        for progress in exploration.explore():
            drawn = progress.scenarios
            if budget.spent(drawn, time.monotonic() - began) >= budget.amount:
                break
        campaign.count(DRAWN_SCENARIOS, drawn)
        _fail_with(exploration.failures, campaign)

    return run


def _fail_with(shown: Sequence[tuple[Finding | None, Execution]], campaign: Campaign) -> None:
    """Fail, unless all that was ``shown`` is a recommendation or known."""
    advice = {r.id for r in load_requirements() if not decides(r.level)}
    failures = [(f, execution) for f, execution in shown if f is None or f.requirement not in advice]
    reasons = [waiver_for(f, campaign.known) if f is not None else "" for f, _ in failures]
    if reasons and all(reasons):
        pytest.xfail("; ".join(sorted(set(reasons))))
    stories = [_story(finding, execution) for finding, execution in failures[:3]]
    if stories:
        more = len(failures) - len(stories)
        pytest.fail("\n\n".join(stories) + (f"\n\nand {more} more" if more > 0 else ""), pytrace=False)


def _story(finding: Finding | None, execution: Execution) -> str:
    if finding is not None:
        head = f"{finding.requirement}: expected {finding.expected}; observed {finding.observed}"
        return f"{head}\nscenario {execution.name}\n{failure_text(finding, execution)}"
    incident = execution.incident
    assert incident is not None
    remark = "" if incident.kind in FRAMEWORK_INCIDENTS else "\nThis says nothing about the framework."
    return f"{incident.kind}: {incident.detail}{remark}\n{incident.stacks}"
