"""Known failures: a file that says which failures are expected for now, why, and until when (docs/known-failures.md).

An entry matches a requirement *and* the text of what was observed. Entries that match nothing are errors,
so that no entry stays longer than its defect. A known failure keeps its verdict in the report; only the exit status changes.
"""

from __future__ import annotations

import datetime
import fnmatch
import glob
from collections.abc import Sequence
from pathlib import Path

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, read, read_lines
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.results.values import Report, RequirementResult, incidents_of
from ucm_cts.reference_models.findings import Finding


class KnownFailure(Value, frozen=True):
    """A failure that is expected for now.

    ``requirement``: the id of the requirement that fails.
    ``observed``: the observation; ``*`` matches any text.
    ``reason``: why it is accepted.
    ``expires``: the last day on which the entry counts, ISO 8601.
    ``url``: the ticket of the defect.
    """

    requirement: str
    observed: str
    reason: str
    expires: str
    url: str = ""


def known_today(path: Path | None) -> tuple[KnownFailure, ...]:
    """The entries of the file at ``path``, if there is one, as of today. Raises ``DocumentError``."""
    if path is None:
        return ()
    return load_known_failures(path, [r.id for r in load_requirements()], datetime.date.today())


def load_known_failures(path: Path, requirements: Sequence[str], today: datetime.date) -> tuple[KnownFailure, ...]:
    """The entries of the file at ``path``. Raises ``DocumentError`` for unknown requirements and expired entries."""
    entries = read(path, list[KnownFailure])
    _, lines = read_lines(path)
    for index, entry in enumerate(entries):
        line = lines.get(f"$[{index}]")
        if entry.requirement not in requirements:
            raise DocumentError(path, line, f"no requirement '{entry.requirement}'; 'ucm-cts explain' lists them")
        try:
            last = datetime.date.fromisoformat(entry.expires)
        except ValueError:
            raise DocumentError(path, line, f"'{entry.expires}' is no date; write it as 2027-01-31") from None
        if last < today:
            raise DocumentError(path, line, f"expired on {entry.expires}; mend the failure or set a new date")
    return tuple(entries)


def waiver_for(finding: Finding, known: Sequence[KnownFailure]) -> str:
    """The reason of the entry that matches ``finding``; empty if none does."""
    for entry in known:
        if entry.requirement == finding.requirement and _matches(entry.observed, finding.observed):
            return entry.reason
    return ""


def _matches(pattern: str, text: str) -> bool:
    """Nothing but ``*`` is special: observations are full of brackets and question marks."""
    return fnmatch.fnmatchcase(text, "*".join(map(glob.escape, pattern.split("*"))))


def all_known(report: Report) -> bool:
    """Would ``report`` be conformant without its known failures?"""
    return (
        report.verdict == "not conformant"
        and not incidents_of(report)
        and all(
            r.verdict in ("pass", "not applicable") or (r.verdict == "fail" and all(f.waived for f in r.findings))
            for r in report.requirements
            if r.decides
        )
    )


def succeeded(report: Report) -> bool:
    """Is ``report`` conformant but for known failures?"""
    return report.verdict == "conformant" or all_known(report)


def stale(known: Sequence[KnownFailure], results: Sequence[RequirementResult]) -> list[KnownFailure]:
    """Entries that match no finding of this run."""
    findings = [f.finding for r in results for f in r.findings]
    return [entry for entry in known if not any(waiver_for(finding, [entry]) for finding in findings)]
