"""What came out of a campaign: a report for each run, the kill matrix of each self-test, and a page with all of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

import ucm_cts
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.campaigns.agenda import Agenda
from ucm_cts.harness.campaigns.planning import RunOfPlan, Work
from ucm_cts.harness.campaigns.store import Store
from ucm_cts.harness.campaigns.units import GeneratedTrial, Trial, address
from ucm_cts.harness.campaigns.working import Done, unpacked
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.order import VERDICTS, count
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.report.page import rendered
from ucm_cts.harness.report.write import save_report
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import succeeded
from ucm_cts.harness.results.values import FrameworkReport, Overall
from ucm_cts.harness.selftest.generated import python_programs
from ucm_cts.harness.selftest.generated.page import Tally
from ucm_cts.harness.selftest.generated.record import Result, read_equivalents
from ucm_cts.harness.selftest.matrix import Matrix
from ucm_cts.harness.selftest.page import MATRIX_FILES, matrix_files
from ucm_cts.harness.selftest.running import testable

PAGE, SUMMARY = "index.html", "campaign.json"

FORMAT = 1
"""The version of the format of ``campaign.json``."""


class RunLine(Value, frozen=True):
    """One run: ``report`` is where its report is, relative; ``why``: why it has none, or why it is incomplete."""

    name: str
    product: str
    profile: str
    seed: int
    verdict: Overall | None = None
    counts: dict[str, int] = {}
    is_well: bool = False
    scenarios: int = 0
    seconds: float = 0.0
    report: str = ""
    why: str = ""


class SelfTestLine(Value, frozen=True):
    """One self-test with a seed. ``wrong``: what is not as it should be, a line each; ``left``: trials without a result."""

    seed: int
    mutants: int
    killed: int
    variants: int
    spared: int
    generated: int
    generated_killed: int
    wrong: tuple[str, ...]
    left: int
    matrix: str = ""

    @property
    def is_well(self) -> bool:
        """Is everything as it should be?"""
        return not (self.wrong or self.left)


class Lost(Value, frozen=True):
    """A unit that gave no result, and why."""

    unit: str
    why: str


class Summary(Value, frozen=True):
    """``campaign.json``. ``left``: how many units have not ended, because the campaign was interrupted."""

    format: int
    suite_version: str
    plan: str
    units: int
    left: int
    runs: tuple[RunLine, ...]
    self_tests: tuple[SelfTestLine, ...]
    lost: tuple[Lost, ...]

    @property
    def is_well(self) -> bool:
        """Did every unit end, is every product conformant but for known failures, and every self-test as it should be?"""
        return (
            not self.left
            and not self.lost
            and all(one.is_well for one in self.runs)
            and all(one.is_well for one in self.self_tests)
        )


@dataclass(frozen=True)
class Outcome:
    """The ``summary``, the ``reports`` of the runs that are concluded, by their names, and the matrix of each self-test, by its seed."""

    summary: Summary
    reports: Mapping[str, FrameworkReport]
    matrices: Mapping[int, Matrix]


def outcome_of(plan: Path, agenda: Agenda, store: Store) -> Outcome:
    """What ``store`` has of the work of ``agenda``."""
    work = agenda.work
    reports: dict[str, FrameworkReport] = {}
    for run in work.runs:
        done = _done(store, agenda.conclusions.get(run.name, ""))
        if done is not None and done.report is not None:
            reports[run.name] = done.report
    matrices, tests = {}, []
    for seed in dict.fromkeys(seed for seed, _ in work.trials):
        results = [done for unit in _trials(work, seed) if (done := _done(store, address(unit))) is not None]
        matrices[seed] = _matrix(seed, results, len(_trials(work, seed)))
        tests.append(_self_test(seed, matrices[seed], _generated(work, seed, store)))
    lost = (Lost(agenda.names[place], one_line(why, 400)) for place, why in agenda.lost.items())
    summary = Summary(
        FORMAT,
        ucm_cts.__version__,
        plan.name,
        agenda.number,
        agenda.number - agenda.before - agenda.done - len(agenda.lost),
        tuple(_line(run, reports.get(run.name), agenda) for run in work.runs),
        tuple(tests),
        tuple(sorted(lost, key=lambda one: one.unit)),
    )
    return Outcome(summary, reports, matrices)


def write_outcome(outcome: Outcome, folder: OutFolder) -> str:
    """Write reports and matrices below the open ``folder``, and the page into it.

    Returns why something could not be written, empty if all was. Nothing is lost then: the results of the units are kept.
    """
    content = msgspec.json.format(msgspec.json.encode(outcome.summary), indent=1) + b"\n"
    try:
        for name, report in outcome.reports.items():
            save_report(report, folder.path / "reports" / name)
        for seed, matrix in outcome.matrices.items():
            with OutFolder(folder.path / _place_of(seed), MATRIX_FILES) as place:
                place.save(matrix_files(matrix), MATRIX_FILES)
        folder.save({SUMMARY: content, PAGE: to_html(outcome.summary).encode()})
    except WrongUse as problem:
        return str(problem)
    except OSError as error:
        return (
            f"reports cannot be written below '{folder.path}': {error.strerror or error}; the same command writes them"
        )
    return ""


def to_html(summary: Summary) -> str:
    """The page with all results."""
    return rendered("campaign.html.jinja", summary=summary, order=VERDICTS)


def _place_of(seed: int) -> str:
    return f"self-test/seed-{seed}"


def _line(run: RunOfPlan, report: FrameworkReport | None, agenda: Agenda) -> RunLine:
    line = RunLine(run.name, run.product, run.run.profile, run.run.seed)
    if report is None:
        why = agenda.lost.get(agenda.conclusions.get(run.name, ""), "it was not run to its end")
        return msgspec.structs.replace(line, why=one_line(why, 300))
    counts = {verdict: number for verdict, number in count(report.requirements).items() if number}
    return msgspec.structs.replace(
        line,
        verdict=report.verdict,
        counts=counts,
        is_well=succeeded(report),
        scenarios=report.scenarios,
        seconds=report.seconds,
        report=f"reports/{run.name}/report.html",
        why=one_line(report.incomplete, 300),
    )


def _trials(work: Work, seed: int) -> list[Trial]:
    return [unit for (own, _), unit in work.trials.items() if own == seed and isinstance(unit, Trial)]


def _matrix(seed: int, results: Sequence[Done], asked: int) -> Matrix:
    mutants = sorted((done.mutant for done in results if done.mutant is not None), key=lambda one: one.name)
    variants = sorted((done.variant for done in results if done.variant is not None), key=lambda one: one.name)
    return Matrix(
        ucm_cts.__version__,
        seed,
        round(sum(one.seconds for one in mutants) + sum(one.seconds for one in variants), 1),
        testable(),
        tuple(mutants),
        tuple(variants),
        whole=False,
        left_out=asked - len(results),
    )


def _generated(work: Work, seed: int, store: Store) -> tuple[Tally, int]:
    """The generated mutants, and how many of them have no result."""
    units = [unit for (own, _), unit in work.trials.items() if own == seed and isinstance(unit, GeneratedTrial)]
    results = [
        Result(unit.mutant, done.outcome)
        for unit in units
        if (done := _done(store, address(unit))) is not None and done.outcome is not None
    ]
    reasons = read_equivalents(python_programs.EQUIVALENTS) if units else {}
    return Tally({}, len(units), results, reasons), len(units) - len(results)


def _self_test(seed: int, matrix: Matrix, generated: tuple[Tally, int]) -> SelfTestLine:
    tally, left = generated
    wrong = [
        *(f"{name} {text}" for name, text in matrix.wrong),
        *(f"{one.mutant.key} survives: {one.outcome.fate} {one.outcome.by}".rstrip() for one in tally.open),
        *(f"{one.mutant.key} is listed as equivalent, and was killed" for one in tally.wrongly_listed),
    ]
    return SelfTestLine(
        seed,
        len(matrix.mutants),
        sum(one.is_killed for one in matrix.mutants),
        len(matrix.variants),
        sum(one.is_spared for one in matrix.variants),
        len(tally.results),
        len(tally.killed),
        tuple(one_line(text, 400) for text in wrong),
        matrix.left_out + left,
        f"{_place_of(seed)}/matrix.html",
    )


def _done(store: Store, place: str) -> Done | None:
    content = store.get(place) if place else None
    return unpacked(content) if content is not None else None
