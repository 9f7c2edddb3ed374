"""``matrix.html`` and ``matrix.json``: the kill matrix as a picture, with every survivor, spill and wronged variant."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import msgspec
from markupsafe import Markup, escape

from ucm_cts.harness.report.order import clause_key
from ucm_cts.harness.report.page import rendered
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.selftest.matrix import Matrix, MutantResult, by_clause

CELL = 4
"""Pixels of one mutant against one requirement."""

LEFT, TOP = 70, 18


@dataclass(frozen=True)
class ClauseRow:
    """One clause's line of the summary."""

    clause: str
    mutants: tuple[MutantResult, ...]
    requirements: int
    covered: int

    @property
    def killed(self) -> int:
        """Mutants that are killed."""
        return sum(mutant.is_killed for mutant in self.mutants)


MATRIX_FILES = ("matrix.json", "matrix.html")


def matrix_files(matrix: Matrix) -> dict[str, bytes]:
    """Both files, by their names."""
    content = msgspec.json.format(msgspec.json.encode(matrix), indent=1) + b"\n"
    return dict(zip(MATRIX_FILES, (content, to_html(matrix).encode()), strict=True))


def to_html(matrix: Matrix) -> str:
    """The whole page."""
    killers = matrix.killers
    covered = sum(bool(killers[requirement]) for requirement in matrix.testable)
    return rendered(
        "matrix.html.jinja", matrix=matrix, rows=rows(matrix), killers=killers, covered=covered, picture=picture(matrix)
    )


def rows(matrix: Matrix) -> list[ClauseRow]:
    """The summary, clause by clause."""
    groups, killers = by_clause(matrix.mutants), matrix.killers
    clauses = sorted({*groups, *map(_clause, matrix.testable)}, key=clause_key)
    due = {clause: [r for r in matrix.testable if _clause(r) == clause] for clause in clauses}
    return [ClauseRow(c, tuple(groups.get(c, ())), len(due[c]), sum(bool(killers[r]) for r in due[c])) for c in clauses]


def picture(matrix: Matrix) -> Markup:
    """All mutants, a line each, against all requirements, a column each."""
    failed = {kill.requirement for mutant in matrix.mutants for kill in mutant.kills}
    named = {requirement for mutant in matrix.mutants for requirement in mutant.breaks}
    columns = sorted({*matrix.testable, *failed, *named}, key=_place)
    column_of = {requirement: place for place, requirement in enumerate(columns)}
    mutants = sorted(matrix.mutants, key=lambda m: (clause_key(m.clause), _place(m.breaks[0]), m.name))
    width, height = LEFT + CELL * len(columns) + 4, TOP + CELL * len(mutants) + 4
    marks = [mark for line, mutant in enumerate(mutants) for mark in _marks(line, mutant, column_of)]
    label = f"{len(mutants)} mutants against {len(columns)} requirements"
    head = f'<svg class="matrix" viewBox="0 0 {width} {height}" width="{width}" role="img" aria-label="{label}">'
    return Markup("".join([head, *_bands(columns, mutants, width, height), *marks, "</svg>"]))


def _marks(line: int, mutant: MutantResult, column_of: dict[str, int]) -> Iterator[str]:
    for kill in mutant.kills:
        if kill.requirement in mutant.breaks:
            kind = "killed" if kill.names_the_place else "misplaced"
        else:
            is_spill = kill in mutant.spills
            kind = "spill" if is_spill else "also"
        yield _mark(line, column_of[kill.requirement], kind, f"{mutant.name}, {kill.requirement}: {kill.observed}")
    shown = {kill.requirement for kill in mutant.kills}
    for requirement in mutant.breaks:
        if requirement not in shown:
            yield _mark(line, column_of[requirement], "missed", f"{mutant.name} does not fail {requirement}")


def _mark(line: int, column: int, kind: str, title: str) -> str:
    x, y = LEFT + CELL * column, TOP + CELL * line
    return f'<rect class="{kind}" x="{x}" y="{y}" width="{CELL - 1}" height="{CELL - 1}"><title>{escape(one_line(title, 200))}</title></rect>'


def _bands(columns: list[str], mutants: list[MutantResult], width: int, height: int) -> Iterator[str]:
    """A line where another clause begins, and its number where there is room."""
    room = -100
    for place, requirement in enumerate(columns):
        if place == 0 or _clause(requirement) != _clause(columns[place - 1]):
            x = LEFT + CELL * place
            yield f'<line x1="{x}" y1="{TOP - 4}" x2="{x}" y2="{height}"/>'
            if x - room > 50:
                yield f'<text x="{x + 1}" y="{TOP - 6}">{escape(_clause(requirement))}</text>'
                room = x
    room = -100
    for place, mutant in enumerate(mutants):
        if place == 0 or mutant.clause != mutants[place - 1].clause:
            y = TOP + CELL * place
            yield f'<line x1="{LEFT - 4}" y1="{y}" x2="{width}" y2="{y}"/>'
            if y - room > 11:
                yield f'<text x="{LEFT - 6}" y="{y + 9}" text-anchor="end">{escape(mutant.clause)}</text>'
                room = y


def _place(requirement: str) -> tuple[tuple[int, ...], str]:
    """By clause, then by number."""
    return clause_key(_clause(requirement)), requirement


def _clause(requirement: str) -> str:
    return requirement.removeprefix("R-").rpartition("-")[0]
