"""The Markdown pages of published results: one for each product, and the tables of all products."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES
from ucm_cts.harness.report.matrix import in_words, matrix
from ucm_cts.harness.report.order import SYMBOLS, VERDICTS, Shown, clause_key, count, shown
from ucm_cts.harness.report.published import PublishedResult, PublishedVerdict, by_product
from ucm_cts.harness.results.foreign import one_line

DEPTH = 3
"""Clauses are counted to this depth of their numbers: 11.2.2.1 counts with 11.2.2."""

_ALWAYS = tuple(verdict for verdict in VERDICTS if verdict != "not followed")
"""The verdicts that have a column in any case."""


def _verdict(cell: PublishedResult | None) -> str:
    return ": ".join(in_words(cell.verdict, cell.requirements)) if cell else ""


def _columns(results: Iterable[PublishedResult]) -> list[Shown]:
    seen = {shown(entry) for result in results for entry in result.requirements}
    return [verdict for verdict in VERDICTS if verdict in _ALWAYS or verdict in seen]


def _legend(results: Iterable[PublishedResult]) -> str:
    return ", ".join(f"{SYMBOLS[verdict]} {verdict}" for verdict in _columns(results))


def overview(results: Sequence[PublishedResult]) -> list[str]:
    """The lines of the tables of all products: the matrix, verdicts by clause, and where frameworks differ."""
    frameworks = [result for result in results if result.profile in FRAMEWORK_PROFILES]
    toolchains = [result for result in results if result.profile not in FRAMEWORK_PROFILES]
    whole = matrix(results)
    rows = [
        (f"[{_name(row.held[0])}]({row.held[0].folder}/README.md)", *(_verdict(cell) for cell in row.cells))
        for row in whole.rows
    ]
    lines = ["## Products and profiles", "", *table(("product", *whole.profiles), rows)]
    for title, group in ("Frameworks", frameworks), ("Tool chains", toolchains):
        if group:
            lines += ["", f"## {title} by clause", "", f"{_legend(results)}.", "", *_by_clause(group)]
    if len(frameworks) > 1:
        lines += ["", "## Where frameworks differ", "", *_differences(frameworks)]
    return lines


def product_page(results: Sequence[PublishedResult], others: Sequence[str] = ()) -> str:
    """The page of one product and version, with all its profiles; ``others`` are further pages in its folder."""
    lines = [
        f"# {_cell(_name(results[0]))}",
        "",
        "Made by `ucm-cts results` of the files beside it; do not edit it.",
        "",
    ]
    heads = _columns(results)
    rows = [(r.profile, r.verdict, *_counts(r.requirements, heads), _stated(r), r.suite_version) for r in results]
    lines += table(("profile", "verdict", *heads, "statement", "suite"), rows)
    lines += ["", "## By clause", "", f"{_legend(results)}.", "", *_by_clause(results)]
    for result in results:
        for title, found in (
            ("Failures", _failures(result)),
            ("Incidents", [(i.kind, i.detail, i.scenario) for i in result.incidents]),
            ("Neither pass nor fail", _undecided(result)),
            ("Observed readings", [(option, ", ".join(seen)) for option, seen in result.readings.items()]),
            ("Stated readings", _declared(result)),
        ):
            if found:
                lines += ["", f"## {title}, profile {result.profile}", "", *table(_HEADS[title], found)]
    if others:
        lines += ["", "## Further pages", "", *(f"* [{name}]({name})" for name in others)]
    return "\n".join(lines) + "\n"


_HEADS = {
    "Failures": ("requirement", "title", "expected", "observed"),
    "Incidents": ("incident", "detail", "scenario"),
    "Neither pass nor fail": ("requirement", "title", "verdict", "reason"),
    "Observed readings": ("option", "readings"),
    "Stated readings": ("option", "reading"),
}


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> list[str]:
    """The lines of a Markdown table. Texts of frameworks cannot break out of a cell."""
    lines = [head, ["---"] * len(head), *rows]
    return [f"| {' | '.join(_cell(str(cell)) for cell in line)} |" for line in lines]


def _cell(text: str) -> str:
    return one_line(text, 400).replace("|", "\\|").replace("<", "&lt;")


def _name(result: PublishedResult) -> str:
    return f"{result.product} {result.version}".strip()


def _counts(entries: Iterable[PublishedVerdict], heads: Iterable[Shown]) -> list[str]:
    counts = count(entries)
    return [str(counts[verdict] or "") for verdict in heads]


def _stated(result: PublishedResult) -> str:
    return result.statement.source if result.statement else "none"


def _by_clause(results: Sequence[PublishedResult]) -> list[str]:
    several = len(by_product(results)) > 1
    heads = [f"{_name(r)}, {r.profile}" if several else r.profile for r in results]
    clauses = {_upper(entry.clause) for result in results for entry in result.requirements}
    rows = [(clause, *(_cell_of(result, clause) for result in results)) for clause in sorted(clauses, key=clause_key)]
    return table(("clause", *heads), rows)


def _upper(clause: str) -> str:
    return ".".join(clause.split(".")[:DEPTH])


def _cell_of(result: PublishedResult, clause: str) -> str:
    counts = count(entry for entry in result.requirements if _upper(entry.clause) == clause)
    return " ".join(f"{SYMBOLS[verdict]} {number}" for verdict, number in counts.items() if number)


def _differences(results: Sequence[PublishedResult]) -> list[str]:
    """The requirements that all ``results`` hold and at least one does not pass."""
    held = [{entry.id: entry for entry in result.requirements} for result in results]
    rows = []
    for entry in results[0].requirements:
        cells = [entries.get(entry.id) for entries in held]
        if None not in cells and {cell.verdict for cell in cells if cell} != {"pass"}:
            title = next(filter(None, (cell.title for cell in cells if cell)), "")
            rows.append((entry.id, title, *(SYMBOLS[shown(cell)] for cell in cells if cell)))
    return table(("requirement", "title", *map(_name, results)), rows)


def _failures(result: PublishedResult) -> list[tuple[str, ...]]:
    titles = {entry.id: entry.title for entry in result.requirements}
    return [
        (f.requirement, titles[f.requirement], f.expected, f"{f.observed} ({remark})" if remark else f.observed)
        for f in result.failures
        for remark in [f.waived or f.unstable]
    ]


def _undecided(result: PublishedResult) -> list[tuple[str, ...]]:
    return [(r.id, r.title, r.verdict, r.reason) for r in result.requirements if r.verdict not in ("pass", "fail")]


def _declared(result: PublishedResult) -> list[tuple[str, str]]:
    """The options with the values that the vendor declares; those that are declared to be ``observed`` are shown as observed."""
    readings = result.statement.readings if result.statement else {}
    return [(option, value) for option, value in readings.items() if value != "observed"]
