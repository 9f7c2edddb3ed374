"""What cannot be true of the dates of a certificate, and of how long its run took; and waivers that do not count any more."""

from __future__ import annotations

import datetime
from collections.abc import Iterator

from ucm_cts.harness.certificates.contents import Claims
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.reading import Contents, day_of, moment_of
from ucm_cts.harness.report.json_report import ReportEntry
from ucm_cts.harness.results.foreign import one_line

_LONGEST = 366 * 86_400
"""Seconds of a run."""

_SLACK = 60
"""Seconds by which somebody may set a clock back during a run."""


def wrong_times(contents: Contents, claims: Claims, now: datetime.datetime) -> Iterator[Problem]:
    """What cannot be true of dates, and waivers that do not count any more."""
    issued = moment_of(claims.issued)
    if issued is None:
        yield Problem("time", f"'{one_line(claims.issued, 60)}' is no moment at which it was signed")
    elif issued > now + datetime.timedelta(days=1):
        yield Problem("time", f"it was signed in the future, at {claims.issued}; set your clock, or ask who signed it")
    started = moment_of(contents.report.started) if contents.report is not None else None
    if contents.report is not None and started is None:
        yield Problem("time", f"'{one_line(contents.report.started, 60)}' is no moment at which the run began")
    if issued is not None and started is not None and started > issued:
        yield Problem(
            "time", f"the run began at {started.isoformat()}, after the certificate was signed at {claims.issued}"
        )
    yield from _durations(contents.report, started, issued)
    for waiver in contents.waivers or ():
        last = day_of(waiver.expires)
        if last is not None and issued is not None and last < issued.date():
            yield Problem(
                "waiver",
                f"the waiver of {waiver.requirement} had expired on {waiver.expires}, before the certificate was signed",
            )
        elif last is not None and last < now.date():
            yield Problem(
                "waiver expired",
                f"the waiver of {waiver.requirement} expired on {waiver.expires}; ask for a new certificate",
            )


def _durations(
    report: ReportEntry | None, started: datetime.datetime | None, issued: datetime.datetime | None
) -> Iterator[Problem]:
    """What cannot be true of how long the run took. Nothing else shows it."""
    if report is None:
        return
    parts = (*(entry.seconds for entry in report.requirements), *report.seconds_by_clause.values())
    if not 0 <= report.seconds <= _LONGEST or min(parts, default=0.0) < 0 or max(parts, default=0.0) > _LONGEST:
        yield Problem(
            "time", "the report says that the run, or a part of it, took less than nothing or more than a year"
        )
    elif started and issued and started <= issued and (issued - started).total_seconds() + _SLACK < report.seconds:
        yield Problem(
            "time",
            f"the run began at {started.isoformat()} and took {report.seconds:.0f} s, so that it was signed before its end",
        )
