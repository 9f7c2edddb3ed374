"""Judges the record of a certificate again: from the certificate to a plan of the run, and back to a report."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import msgspec

from ucm_cts.harness.catalogue.profiles import TOOLCHAIN_PROFILES
from ucm_cts.harness.certificates.contents import Claims
from ucm_cts.harness.certificates.delta import NOT_FROM_TRACES, judged_by_this_suite
from ucm_cts.harness.certificates.problems import Problem, unreadable
from ucm_cts.harness.certificates.reading import Contents
from ucm_cts.harness.certificates.rejudging import RunPlan, judge_again
from ucm_cts.harness.execution.recording import RecordError, decoded
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.json_report import ReportEntry, entry_of
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.tally import overall


@dataclass(frozen=True)
class JudgedAgain:
    """The report that a record shows; with ``problems``, of a part of the run only. ``unshown``: what the record says without a trace."""

    report: ReportEntry
    problems: tuple[Problem, ...] = ()
    unshown: tuple[str, ...] = ()


def judged_again(contents: Contents, statement: Statement, is_delta: bool) -> JudgedAgain:
    """What the record of ``contents`` shows. Raises ``Unreadable`` if it cannot be read."""
    claims, environment = contents.claims, contents.environment
    assert claims is not None
    assert environment is not None
    assert contents.record is not None
    if claims.profile in TOOLCHAIN_PROFILES:
        return _of_toolchain(contents, claims, statement, is_delta)
    try:
        record = decoded(contents.record)
    except RecordError as error:
        raise unreadable("record", str(error)) from None
    if is_delta:
        by_today = judged_by_this_suite(record, claims.profile, statement, contents.waivers or ())
        return JudgedAgain(_with_old(entry_of(by_today), contents.report))
    settings = environment.settings
    plan = RunPlan(
        profile=claims.profile,
        seed=claims.seed,
        statement=statement,
        known=contents.waivers or (),
        systematic=settings.systematic,
        drawn=settings.drawn,
        seconds=settings.timeout,
        memory=settings.memory,
        incident_seconds=settings.incident_time,
    )
    judged = judge_again(record, plan)
    problems = tuple(Problem("record", problem) for problem in judged.problems)
    return JudgedAgain(entry_of(judged.report), problems, judged.unshown)


def _of_toolchain(contents: Contents, claims: Claims, statement: Statement, is_delta: bool) -> JudgedAgain:
    """What the record of a tool chain shows. Raises ``Unreadable``."""
    need("toolchain", "verifying a certificate of a tool chain")
    from ucm_cts.harness.certificates.toolchain_rejudging import judge_toolchain_again
    from ucm_cts.harness.toolchains import recorded_form
    from ucm_cts.harness.toolchains.campaign import ToolChainPlan

    assert contents.record is not None
    try:
        record = recorded_form.decoded(contents.record)
        plan = ToolChainPlan(
            claims.product,
            claims.version,
            claims.profile,
            statement,
            contents.waivers or (),
            seed=claims.seed,
        )
        judged = judge_toolchain_again(record, plan, contents.is_vouched_for, is_delta=is_delta)
    except (recorded_form.RecordError, WrongUse) as error:
        raise unreadable("record", one_line(str(error), 400)) from None
    shown = entry_of(judged.report)
    problems = (
        *judged.problems,
        *(unfinished_compilations(contents.report, shown) if contents.report and not is_delta else ()),
    )
    return JudgedAgain(shown, tuple(Problem("record", problem) for problem in problems))


def unfinished_compilations(said: ReportEntry, shown: ReportEntry) -> Iterator[str]:
    """The first difference between the reports ``said`` and ``shown`` that a compiler without an end explains, as a line.

    Compilers run again when the record of a tool chain is judged. On a very busy machine one may not end in time, which says nothing about the product.
    """
    from ucm_cts.harness.toolchains.commands.bounded import NO_END

    before = {entry.id: entry for entry in said.requirements}
    for entry in shown.requirements:
        other = before.get(entry.id, entry)
        for which, reason in (("here", entry.reason), ("when it was made", other.reason)):
            if other.verdict != entry.verdict and NO_END in reason:
                yield f"not judged: {which}, {one_line(reason, 200)}; try again when the machine is less busy"
                return


def _with_old(shown: ReportEntry, old: ReportEntry | None) -> ReportEntry:
    """``shown`` with what the certificate itself says of requirements that traces do not decide."""
    kept = {entry.id: entry for entry in old.requirements if entry.id in NOT_FROM_TRACES} if old is not None else {}
    requirements = tuple(kept.get(entry.id, entry) for entry in shown.requirements)
    return msgspec.structs.replace(
        shown, requirements=requirements, verdict=overall(requirements, shown.incidents, shown.incomplete)
    )
