"""``comparison.html``: reports side by side, in one self-contained file."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote

from ucm_cts.harness.report.comparison import Column, Comparison, Row, first_finding
from ucm_cts.harness.report.json_report import ReportEntry
from ucm_cts.harness.report.order import VERDICTS, Shown, count, shown
from ucm_cts.harness.report.page import rendered
from ucm_cts.harness.results.values import Verdict

_ORDER: tuple[Shown, ...] = ("pass", *(verdict for verdict in VERDICTS if verdict != "pass"))

_FACTS: tuple[tuple[str, Callable[[ReportEntry], str]], ...] = (
    ("Profile", lambda report: report.profile),
    ("Started", lambda report: report.started),
    ("Took", lambda report: f"{report.seconds:.1f} s, {report.scenarios:,} scenarios, {report.events:,} events"),
    ("Adapter", lambda report: report.adapter),
    ("Statement", lambda report: report.statement.source or "none"),
    ("Suite", lambda report: f"UCM-CTS {report.suite_version}"),
    ("Seed", lambda report: str(report.seed)),
)


def to_html(comparison: Comparison, folder: Path) -> str:
    """The whole page, with links to the reports as they are found from ``folder``, where the page will be."""
    return rendered(
        "comparison.html.jinja",
        comparison=comparison,
        kept_by_all=_unanimous(comparison, "pass"),
        broken_by_all=_unanimous(comparison, "fail"),
        apart=sum(row.differs for row in comparison.shared),
        asked_of_all=comparison.parts(lambda row: row.is_shared),
        asked_of_some=comparison.parts(lambda row: not row.is_shared),
        remarkable=comparison.parts(lambda row: not row.is_kept),
        kept=comparison.parts(lambda row: row.is_kept),
        counts=[count(column.report.requirements) for column in comparison.columns],
        links=[_link(column, folder) for column in comparison.columns],
        versions=sorted({column.report.suite_version for column in comparison.columns}),
        facts=_FACTS,
        first=first_finding,
        order=_ORDER,
    )


def _unanimous(comparison: Comparison, verdict: Verdict) -> int:
    def all_say_so(row: Row) -> bool:
        return all(cell is not None and shown(cell) == verdict for cell in row.cells)

    return sum(map(all_say_so, comparison.rows))


def _link(column: Column, folder: Path) -> str:
    """Where the page of the report is, seen from ``folder``; empty if there is none beside its file."""
    page = column.path.with_name("report.html")
    return quote(os.fsencode(os.path.relpath(page, folder))) if page.is_file() else ""
