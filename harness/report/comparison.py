"""Reports of several runs side by side, requirement by requirement: what ``ucm-cts compare`` shows.

A report file can come from anywhere: one that breaks the schema, or contradicts itself, is refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import msgspec

from ucm_cts.harness.catalogue.documents import DocumentError, convert, read_lines, read_text
from ucm_cts.harness.catalogue.requirements import Level
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.json_report import SCHEMA_VERSION, FindingEntry, ReportEntry, RequirementEntry
from ucm_cts.harness.report.order import clause_key
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.tally import overall

MOST = 12
"""The most reports that make a readable page."""

LARGEST = 64 * 1024 * 1024
"""Bytes a report may have."""


@dataclass(frozen=True)
class Column:
    """One report, and the file it was read from."""

    path: Path
    report: ReportEntry

    @property
    def name(self) -> str:
        """Product and version."""
        return f"{self.report.product} {self.report.version}"


@dataclass(frozen=True)
class Row:
    """One requirement: what each report says of it, None where the report does not hold it."""

    id: str
    clause: str
    title: str
    level: Level
    cells: tuple[RequirementEntry | None, ...]

    @property
    def is_shared(self) -> bool:
        """All reports hold it."""
        return None not in self.cells

    @property
    def differs(self) -> bool:
        """Those that hold it do not agree."""
        return len({cell.verdict for cell in self.cells if cell}) > 1

    @property
    def is_kept(self) -> bool:
        """Those that hold it agree, and none has anything against it."""
        return not self.differs and all(cell.verdict in ("pass", "not applicable") for cell in self.cells if cell)


@dataclass(frozen=True)
class Part:
    """What one clause asks, and how many of its requirements each report has under each verdict."""

    clause: str
    rows: tuple[Row, ...]

    def entries(self, column: int) -> list[RequirementEntry]:
        """What the report at ``column`` says of them."""
        return [cell for row in self.rows if (cell := row.cells[column])]


@dataclass(frozen=True)
class Option:
    """A place where the text leaves a choice, and the readings that each report observed."""

    name: str
    readings: tuple[tuple[str, ...], ...]

    @property
    def differs(self) -> bool:
        """Those that show any reading do not show the same ones."""
        return len({frozenset(seen) for seen in self.readings if seen}) > 1


@dataclass(frozen=True)
class Comparison:
    """Reports side by side, rows in the order of clauses."""

    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    options: tuple[Option, ...]

    @property
    def shared(self) -> list[Row]:
        """Requirements that all reports hold."""
        return [row for row in self.rows if row.is_shared]

    def parts(self, fits: Callable[[Row], bool] = lambda row: True) -> list[Part]:
        """The rows that fit, by clause."""
        clauses = dict.fromkeys(row.clause for row in self.rows if fits(row))
        return [Part(clause, tuple(r for r in self.rows if r.clause == clause and fits(r))) for clause in clauses]


def read_report(path: Path) -> ReportEntry:
    """The ``report.json`` at ``path``. Raises ``DocumentError``, naming the line, if it is none or contradicts itself."""
    return decoded_report(path, read_text(path, LARGEST))


def decoded_report(path: Path, text: str | bytes) -> ReportEntry:
    """The report that ``text``, from the file at ``path`` or from an archive there, is. Raises as ``read_report`` does."""
    _check_version(path, text)
    try:
        report = msgspec.json.decode(text, type=ReportEntry)
    except msgspec.ValidationError as error:
        raise _misfit(path, error) from None
    except (msgspec.DecodeError, RecursionError) as error:
        raise DocumentError(path, None, f"is no report ({error}); {_REMEDY}") from None
    contradiction = _contradiction(report)
    if contradiction:
        raise DocumentError(path, None, f"{contradiction}; {_REMEDY}")
    return report


class _Versioned(msgspec.Struct, frozen=True):
    schema_version: int | None = None
    suite_version: str = ""


def _check_version(path: Path, text: str | bytes) -> None:
    """Raise ``DocumentError`` for a report of another version of the schema, which may mean something else by the same names."""
    try:
        found = msgspec.json.decode(text, type=_Versioned)
    except (msgspec.MsgspecError, RecursionError):
        return  # it is no report of any version, which its reader says better
    if found.suite_version and found.schema_version != SCHEMA_VERSION:
        which = f"schema version {found.schema_version}" if found.schema_version is not None else "no schema version"
        by = one_line(found.suite_version, 40)
        is_newer = found.schema_version is not None and found.schema_version > SCHEMA_VERSION
        remedy = "update ucm-cts" if is_newer else "make it again with 'ucm-cts run'"
        raise DocumentError(
            path,
            None,
            f"has {which} (written by UCM-CTS {by}), and this one reads version {SCHEMA_VERSION}; {remedy}",
        )


def _contradiction(report: ReportEntry) -> str:
    """What no run can have written, if anything."""
    seen: set[str] = set()
    for entry in report.requirements:
        if not _ID.fullmatch(entry.id):
            return f"'{entry.id}' is no requirement"
        if entry.id in seen:
            return f"holds {entry.id} twice"
        seen.add(entry.id)
        fails = any(not finding.unstable for finding in entry.findings)
        if fails is not (entry.verdict == "fail"):
            return f"{entry.id} is '{entry.verdict}', against its findings"
        if entry.verdict == "pass" and not entry.exercised:
            return f"{entry.id} is 'pass' and was never exercised"
    left_out = sum(entry.verdict == "not applicable" for entry in report.requirements)
    scope = report.scope
    if (scope.profile, scope.asked + left_out, scope.not_applicable) != (
        report.profile,
        len(report.requirements),
        left_out,
    ):
        return f"says '{one_line(scope.text)}', against its requirements"
    due = overall(report.requirements, report.incidents, report.incomplete)
    return "" if report.verdict == due else f"says '{report.verdict}', but what it holds is '{due}'"


_ID = re.compile(r"R-\d{1,4}(\.\d{1,4}){0,8}-\d{1,4}")

_REMEDY = "give a report.json as this version of ucm-cts run writes it"


def _misfit(path: Path, error: msgspec.ValidationError) -> DocumentError:
    """The same error with its line, if the file is small enough to find it."""
    problem = str(error)
    with suppress(DocumentError, RecursionError):
        _, lines = read_lines(path)
        try:
            convert(path, msgspec.json.decode(read_text(path)), ReportEntry, lines)
        except DocumentError as located:
            problem = str(located).removeprefix(str(path)).lstrip(":")
            number, colon, rest = problem.partition(": ")
            if colon and number.isdigit():
                return DocumentError(path, int(number), f"{rest}; {_REMEDY}")
    return DocumentError(path, None, f"{problem}; {_REMEDY}")


def compare(paths: Sequence[Path]) -> Comparison:
    """The reports in the files ``paths``, in that order. Raises ``DocumentError``, and ``WrongUse`` for their number."""
    if not 2 <= len(paths) <= MOST:
        raise WrongUse(f"{len(paths)} report(s) cannot be compared; name 2 to {MOST} files report.json")
    return side_by_side([Column(path, read_report(path)) for path in paths])


def side_by_side(columns: Sequence[Column]) -> Comparison:
    """The reports in ``columns``, in that order. Raises ``WrongUse`` if they cannot be compared."""
    held = [{entry.id: entry for entry in column.report.requirements} for column in columns]
    for number, column in enumerate(columns):
        if column.report.incomplete:
            why = f"its run is incomplete ({one_line(column.report.incomplete)})"
            raise WrongUse(f"'{column.path}' cannot be compared: {why}; run it again to its end")
        others = set[str]().union(*held[:number], *held[number + 1 :])
        if not others & held[number].keys():
            profile = one_line(column.report.profile, 40)
            raise WrongUse(
                f"'{column.path}' (profile {profile}) has no requirement in common with the others; compare runs of one profile"
            )
    known = {id_: entry for entries in reversed(held) for id_, entry in entries.items()}
    rows = [
        Row(id_, entry.clause, entry.title, entry.level, tuple(entries.get(id_) for entries in held))
        for id_, entry in known.items()
    ]
    names = sorted({option for column in columns for option in column.report.readings})
    return Comparison(
        tuple(columns),
        tuple(sorted(rows, key=lambda row: (clause_key(row.clause), row.clause, row.id))),
        tuple(Option(name, tuple(c.report.readings.get(name, ()) for c in columns)) for name in names),
    )


def first_finding(cell: RequirementEntry) -> FindingEntry | None:
    """The finding to show: the first that is held against the framework, or else the first."""
    findings: Iterable[FindingEntry] = sorted(cell.findings, key=lambda finding: bool(finding.unstable))
    return next(iter(findings), None)
