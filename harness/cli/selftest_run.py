"""Runs mutants, variants and cheats for ``ucm-cts selftest``, and shows what came out."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import click
from rich.table import Table

from ucm_cts.harness.cli.options import HARNESS_FAILED
from ucm_cts.harness.cli.terminal import Output, ends_like_interrupts, progress_of
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.report.write import keep_files
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.selftest.cheat_trials import all_cheats
from ucm_cts.harness.selftest.matrix import Matrix, MutantResult, VariantResult
from ucm_cts.harness.selftest.model_variants import model_variants
from ucm_cts.harness.selftest.models_killing import all_models
from ucm_cts.harness.selftest.page import MATRIX_FILES, matrix_files, rows
from ucm_cts.harness.selftest.running import Result, SelfTest
from ucm_cts.harness.selftest.toolchains import ToolChainSubject, all_subjects
from ucm_cts.harness.selftest.trials import Subject, Thoroughness, all_mutants, all_variants, names

PRINT_EVERY = 50
"""Without a terminal, progress is printed each time this many subjects have been examined."""

LISTED = 40
"""How many survivors, spills and failed variants the terminal shows; the page has all."""


@dataclass(frozen=True)
class Wanted:
    """What the options of the command say."""

    names: tuple[str, ...]
    quick: bool
    whole: bool
    real_time: bool
    jobs: int
    seed: int
    out: Path
    toolchains: bool
    listed: bool


def examine(wanted: Wanted) -> None:
    """Examine the subjects that are ``wanted``. Ends the process with status 1 if one is not as it should be. Raises ``WrongUse``."""
    console = Output()
    subjects: Mapping[str, Subject | ToolChainSubject]
    cheats: list[str] = []
    models: tuple[str, ...] = ()
    if wanted.toolchains:
        need("toolchain", "examining tool chains")
        subjects = all_subjects()
        chosen: list[Subject | ToolChainSubject] = list(names(subjects, wanted.names))
    else:
        subjects = {**all_mutants(), **all_variants()}
        chosen = list(names(subjects, wanted.names, all_cheats()))
        cheats = [name for name in all_cheats() if name in wanted.names or not wanted.names]
        models = () if wanted.names else (*all_models(), *(() if wanted.quick else model_variants()))
    if wanted.listed:
        _list(chosen, cheats, models, console)
        return
    conduct = SelfTest(
        [subject for subject in chosen if subject.breaks],
        [subject for subject in chosen if not subject.breaks and not wanted.quick],
        Thoroughness(wanted.seed, wanted.whole, wanted.quick, real_time=wanted.real_time),
        wanted.jobs,
        models,
        cheats if wanted.names or not wanted.quick else [],
        is_all=not (wanted.names or wanted.quick),
        of_toolchains=wanted.toolchains,
    )
    if not conduct.number:
        raise WrongUse("--quick leaves conformant variants out, and no other subject is named; leave out --quick")
    if not wanted.toolchains and not any(isinstance(s, Subject) and s.is_native for s in subjects.values()):
        console.print("native mutants are left out: their executable comes with an installed ucm-cts, and is not here")
    with ends_like_interrupts() as interrupts, OutFolder(wanted.out, MATRIX_FILES) as folder:
        interrupted = _conduct(conduct, console)
        with interrupts.held():
            saved = keep_files(matrix_files(conduct.matrix), folder, MATRIX_FILES)
    console.print(summary(conduct.matrix))
    _print_wrong(conduct.matrix, console)
    if saved.place is not None:
        console.say(f"{saved.place / 'matrix.html'} shows the kill matrix")
    if saved.problem:
        click.echo(f"ucm-cts: the kill matrix cannot be written: {saved.problem}", err=True)
        sys.exit(HARNESS_FAILED)
    if interrupted:
        console.print("interrupted: the matrix holds what was found so far")
    sys.exit(0 if conduct.matrix.is_proved and not interrupted else 1)


def _list(
    chosen: Sequence[Subject | ToolChainSubject], cheats: Sequence[str], models: Sequence[str], console: Output
) -> None:
    for subject in chosen:
        text = f"breaks {', '.join(subject.breaks)}: {subject.lie}" if subject.breaks else "is conformant"
        console.say(f"{subject.name} {text}")
    for name in cheats:
        console.say(f"{name} cheats: {all_cheats()[name].lie}")
    for name in models:
        is_variant = name in model_variants()
        console.say(f"models: {name} is conformant" if is_variant else f"models of {name} are spoilt, in every way")


def _conduct(conduct: SelfTest, console: Output) -> bool:
    """Run all subjects. Returns True if interrupted."""
    done = wrong = 0
    with progress_of(console) as progress:
        total = conduct.number
        task = progress.add_task("examining", total=total)

        def tell(result: Result) -> None:
            nonlocal done, wrong
            done += 1
            wrong += not is_well(result)
            if not console.is_terminal and (done == 1 or done % PRINT_EVERY == 0):
                console.print(f"{done} of {total} examined, {wrong} not as they should be")
                console.file.flush()
            progress.update(task, advance=1, description=f"{wrong} not as they should be, {result.name[:40]}")

        try:
            conduct.run(tell)
        except KeyboardInterrupt:
            return True
    return False


def summary(matrix: Matrix) -> Table:
    """Mutants and requirements by clause."""
    table = Table("clause", "mutants", "killed", "spills", "requirements", "with a killed mutant", title="Kill matrix")
    for row in (row for row in rows(matrix) if row.mutants):
        table.add_row(row.clause, *_counts(row.mutants), str(row.requirements), str(row.covered))
    all_due = [r for r in matrix.testable if matrix.killers[r]]
    table.add_section()
    table.add_row("all", *_counts(matrix.mutants), str(len(matrix.testable)), str(len(all_due)))
    spared = sum(variant.is_spared for variant in matrix.variants)
    found = len(matrix.cheats) - len(matrix.undetected)
    table.caption = (
        f"{spared} of {len(matrix.variants)} conformant variants spared; "
        f"{found} of {len(matrix.cheats)} cheats come out as they should; {matrix.seconds:.0f} s"
    )
    return table


def is_well(result: Result) -> bool:
    """Is the mutant killed without spill, the variant spared, the cheat found out?"""
    match result:
        case MutantResult():
            return result.is_killed and not result.spills
        case VariantResult():
            return result.is_spared
        case _:
            return result.is_as_it_should


def _counts(mutants: Sequence[MutantResult]) -> tuple[str, str, str]:
    killed = sum(mutant.is_killed for mutant in mutants)
    return str(len(mutants)), str(killed), str(sum(bool(mutant.spills) for mutant in mutants))


def _print_wrong(matrix: Matrix, console: Output) -> None:
    lines = [one_line(f"{name} {text}", 300) for name, text in matrix.wrong]
    for line in lines[:LISTED]:
        console.say(line)
    if len(lines) > LISTED:
        console.print(f"and {len(lines) - LISTED} more")
