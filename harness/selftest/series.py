"""Series: the same run many times, or once for each variant of a framework. Finds verdicts that flip (``tox -e series``).

Each run is the command that a user gives, in a process of its own; ``--busy`` keeps that many processors busy meanwhile.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
import msgspec
from rich.console import Console
from rich.progress import track
from rich.table import Table

WIDTH = 140
"""Columns of the table in the terminal, however wide that says it is: it is mostly read from a log."""


@dataclass(frozen=True)
class SeriesRun:
    """One run of a series: its name, its verdict, that of each requirement, and why, where the report says why."""

    name: str
    verdict: str
    verdicts: Mapping[str, str]
    reasons: Mapping[str, str]
    incidents: int
    seconds: float
    measures: Mapping[str, int]

    def flips(self, first: SeriesRun) -> list[str]:
        """The requirements whose verdict is another one than in the ``first`` run."""
        return sorted(r for r in {*self.verdicts, *first.verdicts} if self.verdicts.get(r) != first.verdicts.get(r))


@click.command()
@click.argument("adapter", default="reference-cpp")
@click.option("--profile", default="core", show_default=True)
@click.option("--runs", type=click.IntRange(min=1), default=1, show_default=True, help="Runs of each variant.")
@click.option("--variant", "variants", multiple=True, help="NAME=VALUE: set in the environment of a run; repeatable.")
@click.option("--busy", type=click.IntRange(min=0), default=0, show_default=True, help="Processors to keep busy.")
@click.option(
    "--out", type=click.Path(dir_okay=False, path_type=Path), help="Write the table to this Markdown file, too."
)
def main(adapter: str, profile: str, runs: int, variants: Sequence[str], busy: int, out: Path | None) -> None:
    """Run PROFILE on ADAPTER again and again. Exit status 1 if a run is not conformant or a verdict flips."""
    done: list[SeriesRun] = []
    console = Console(stderr=True)
    with keeping_busy(busy):
        cases = [(variant, number) for variant in variants or ("",) for number in range(1, runs + 1)]
        for variant, number in track(cases, "running", console=console, transient=True):
            done.append(one_run(adapter, profile, variant, number))
            if not console.is_terminal:
                click.echo(f"{len(done)} of {len(cases)}: {done[-1].verdict}, {done[-1].seconds:.1f} s", err=True)
            for flip in flips(done[-1], done[0]):
                click.echo(flip)
    title = f"{adapter}, profile {profile}, {len(done)} runs{f', {busy} busy processors' if busy else ''}"
    Console(width=WIDTH).print(table(title, done))
    if out is not None:
        out.write_text(markdown(title, done), encoding="utf-8")
    steady = all(run.verdict == "conformant" and not run.flips(done[0]) for run in done)
    sys.exit(0 if steady or (variants and all(run.verdict == "conformant" for run in done)) else 1)


def flips(run: SeriesRun, first: SeriesRun) -> Iterator[str]:
    """A line for each requirement whose verdict is another one than in the ``first`` run: why, as the report says."""
    for requirement in run.flips(first):
        reason = run.reasons.get(requirement) or "no reason is given"
        yield f"{run.name}: {requirement} {run.verdicts.get(requirement, 'not judged')}: {reason}"


def one_run(adapter: str, profile: str, variant: str, number: int) -> SeriesRun:
    """Run once; ``number`` is the seed."""
    name, _, value = variant.partition("=")
    environment = {**os.environ, **({name: value} if name else {})}
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "ucm_cts", "run", adapter, "--profile", profile]
        command += ["--seed", str(number), "--out", folder]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        try:
            report = msgspec.json.decode((Path(folder) / "report.json").read_bytes())
        except OSError:
            raise click.ClickException(f"run {number} left no report: {done.stderr.strip()}") from None
    verdicts = {result["id"]: result["verdict"] for result in report["requirements"]}
    reasons = {result["id"]: _reason(result) for result in report["requirements"]}
    incidents = len(report.get("incidents", ()))
    label = value or f"{number}"
    return SeriesRun(
        label, report["verdict"], verdicts, reasons, incidents, report["seconds"], report.get("measures", {})
    )


def _reason(result: Mapping[str, Any]) -> str:
    """Why the verdict of a requirement is as it is, with the first finding about it, if there is one."""
    shown = [f"expected {one['expected']}; observed {one['observed']}" for one in result["findings"][:1]]
    return ": ".join(part for part in (result["reason"], *shown) if part)


@contextlib.contextmanager
def keeping_busy(processors: int) -> Iterator[None]:
    """So many processes do nothing but compute meanwhile."""
    busy = [multiprocessing.Process(target=_compute, daemon=True) for _ in range(processors)]
    for process in busy:
        process.start()
    try:
        yield
    finally:
        for process in busy:
            process.kill()
            process.join()


def _compute() -> None:
    while True:
        sum(range(10_000))


def _rows(done: Sequence[SeriesRun]) -> Iterator[tuple[str, ...]]:
    for run in done:
        counts = Counter(run.verdicts.values())
        figures = [str(counts[verdict]) for verdict in ("pass", "fail", "inconclusive", "not applicable")]
        flips = ", ".join(run.flips(done[0])) or "none"
        yield run.name, run.verdict, *figures, str(run.incidents), f"{run.seconds:.1f}", flips


_COLUMNS = ("run", "verdict", "pass", "fail", "inconclusive", "n/a", "incidents", "s", "other than in the first run")


def table(title: str, done: Sequence[SeriesRun]) -> Table:
    """The series for the terminal."""
    shown = Table(*_COLUMNS, title=title)
    for row in _rows(done):
        shown.add_row(*row)
    return shown


def markdown(title: str, done: Sequence[SeriesRun]) -> str:
    """The series as a page without times: a row for all runs that came out alike."""
    names: dict[tuple[str, ...], list[str]] = {}
    for name, *figures, _, flips in _rows(done):
        names.setdefault((*figures, flips), []).append(name)
    columns = (*_COLUMNS[1:-2], _COLUMNS[-1], "runs", "names")
    rows = [(*figures, str(len(alike)), "; ".join(alike)) for figures, alike in names.items()]
    lines = (columns, ["---"] * len(columns), *rows)
    return "\n".join([f"# {title}", "", *(f"| {' | '.join(line)} |" for line in lines)]) + "\n"


if __name__ == "__main__":
    main()
