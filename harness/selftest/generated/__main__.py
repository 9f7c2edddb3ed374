"""Runs generated mutants: ``python -m ucm_cts.harness.selftest.generated python`` (or ``cpp``)."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import click

from ucm_cts.adapters.reference import cpp as reference_cpp
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.selftest.generated import python_programs
from ucm_cts.harness.selftest.generated.cpp_programs import CONCERNED, EQUIVALENTS, CppFramework, DoesNotCompile
from ucm_cts.harness.selftest.generated.mutants import GENERATED, SEED, GeneratedMutant, drawn
from ucm_cts.harness.selftest.generated.page import Tally, page
from ucm_cts.harness.selftest.generated.quick_trial import QuickTrials
from ucm_cts.harness.selftest.generated.record import Result, append, read_equivalents, read_results
from ucm_cts.harness.selftest.generated.trial import Outcome, ordered, stated, try_out

INTRO = """Made by universalmutator, run through profile core; what this means stands in docs/detection.md."""

results_option = click.option(
    "--results", type=click.Path(dir_okay=False, path_type=Path), required=True, help="What is known; it is added to."
)
limit_option = click.option("--limit", type=int, help="No more than so many mutants, drawn by chance from all.")
part_option = click.option(
    "--part",
    default="1/1",
    help="2/3: the second third of them, so that three processes can share one file of results.",
)
again_option = click.option("--again", default="", help="Try those out once more whose fate or key contains this.")


@click.group()
def main() -> None:
    """Mutants that a tool makes of the reference frameworks go through profile core; what is known is kept in a file."""


@main.command()
@results_option
@limit_option
@part_option
@again_option
@click.option("--quick-only", is_flag=True, help="Leave out mutants that only the whole pipeline decides.")
@click.option("--glance-only", is_flag=True, hidden=True)  # the former name of --quick-only
def python(results: Path, limit: int | None, part: str, again: str, quick_only: bool, glance_only: bool) -> None:
    """Mutants of the Python reference framework."""
    candidates, census = python_programs.candidates()
    _print(f"{len(candidates)} mutants to run; {dict(census)}")
    statement = stated(python_programs.HOME / "ics.toml")
    quick_trials = QuickTrials(statement, ordered(statement, ()), SEED)
    quick_trials.learn(Engine(ReferenceAdapter))
    known = read_results(results)
    drawn = _drawn(candidates, limit, part)
    for mutant in _left(drawn, known, again):
        with python_programs.python_endpoint(mutant) as endpoint:
            trial = quick_trials.try_out(endpoint, python_programs.CONCERNED[mutant.file])
        known[mutant.digest] = trial.outcome or Outcome("open", trial.suspect)
        append(results, mutant, known[mutant.digest])
    reasons = read_equivalents(python_programs.EQUIVALENTS)
    for mutant in [] if quick_only or glance_only else drawn:
        outcome = known[mutant.digest]
        if outcome.fate == "open" and mutant.key not in reasons:
            with python_programs.python_endpoint(mutant) as endpoint:
                outcome = try_out(endpoint, statement, python_programs.CONCERNED[mutant.file], outcome.by, SEED)
            append(results, mutant, outcome)
            _print(f"{outcome.fate} {outcome.by} {outcome.scenario} ({outcome.seconds} s): {mutant.key}")


@main.command()
@results_option
@limit_option
@part_option
@again_option
@click.option("--root", type=click.Path(exists=True, path_type=Path), default=Path(), help="The source tree.")
@click.option("--build", type=click.Path(path_type=Path), required=True, help="A folder for what is compiled once.")
def cpp(results: Path, limit: int | None, part: str, again: str, root: Path, build: Path) -> None:
    """Mutants of the C++ reference framework."""
    framework = CppFramework(root.absolute(), build.absolute())
    _print("compiling the framework as it is")
    framework.prepare()
    statement = stated(reference_cpp.STATEMENT)
    with framework.endpoint("", None) as endpoint:
        control = try_out(endpoint, statement, (), "", SEED)
    if control.fate != "survived":
        raise click.ClickException(f"the framework as it is does not pass: {control}")
    candidates = list(framework.candidates())
    known = read_results(results)
    _print(f"{len(candidates)} mutants generated")
    for mutant in _left(_drawn(candidates, limit, part), known, again):
        outcome = _try_cpp(framework, mutant, statement)
        append(results, mutant, outcome)
        if outcome.fate not in ("not compiled", "same program"):
            _print(f"{outcome.fate} {outcome.by} {outcome.scenario} ({outcome.seconds} s): {mutant.key}")


@main.command(name="page")
@click.argument("language", type=click.Choice(("python", "cpp")))
@results_option
@click.option("--root", type=click.Path(exists=True, path_type=Path), default=Path(), help="The source tree.")
@click.option("--out", type=click.Path(dir_okay=False, path_type=Path), required=True, help="A Markdown file.")
def write_page(language: str, results: Path, root: Path, out: Path) -> None:
    """Write what is known as a page. Exit status 1 if a survivor is open, or an equivalent one was killed."""
    known = read_results(results)
    if language == "python":
        candidates, census = python_programs.candidates()
        listed, title = python_programs.EQUIVALENTS, "Generated mutants of the Python reference framework"
    else:
        candidates = list(CppFramework(root.absolute(), Path()).candidates())
        census = Counter({GENERATED: len(candidates)})
        listed, title = EQUIVALENTS, "Generated mutants of the C++ reference framework"
    tried = [Result(mutant, known[mutant.digest]) for mutant in candidates if mutant.digest in known]
    tally = Tally(census, len(candidates), tried, read_equivalents(listed))
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(page(title, INTRO, tally), encoding="utf-8")
    _print(f"{tally.rate:.1f} % killed of those that are not equivalent, {len(tally.open)} open: {out}")
    sys.exit(1 if tally.open or tally.wrongly_listed else 0)


def _try_cpp(framework: CppFramework, mutant: GeneratedMutant, statement: Statement) -> Outcome:
    with TemporaryDirectory(prefix="mutant-") as folder:
        try:
            made = framework.compile(mutant, Path(folder))
            if framework.is_same(mutant.file, made):
                return Outcome("same program")
            with framework.endpoint(mutant.file, made) as endpoint:
                return try_out(endpoint, statement, CONCERNED.get(mutant.file, ()), "", SEED)
        except DoesNotCompile as error:
            return Outcome("not compiled", detail=str(error))


def _drawn(candidates: list[GeneratedMutant], limit: int | None, part: str) -> list[GeneratedMutant]:
    number, _, parts = part.partition("/")
    return drawn(candidates, limit)[int(number) - 1 :: int(parts)]


def _left(drawn: list[GeneratedMutant], known: dict[str, Outcome], again: str) -> Iterator[GeneratedMutant]:
    done = 0
    for number, mutant in enumerate(drawn, 1):
        outcome = known.get(mutant.digest)
        if outcome is None or (again and (again == outcome.fate or again in mutant.key)):
            yield mutant
            done += 1
            if done % 50 == 0:
                _print(f"{number} of {len(drawn)}")


def _print(line: str) -> None:
    click.echo(line, err=True)


if __name__ == "__main__":
    main()
