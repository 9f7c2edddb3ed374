"""Measures reading and checking a large model, beside parsing it with lxml.

The command is ``python -m ucm_cts.harness.bench.models``. Each way runs in a process of its own, which has its own memory.
"""

from __future__ import annotations

import gc
import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
from lxml import etree
from rich.console import Console
from rich.table import Table

from ucm_cts.adapters.contract.metamodel.common import walk
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.contract.metamodel.writing import write_model
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.bench.large_model import large_model
from ucm_cts.harness.bench.measuring import empty_table, limit
from ucm_cts.harness.toolchains.corpus.schema import parser, schema

ELEMENTS = 1_000_000

TIMES = 6
"""The limit of reading and checking, as a multiple of parsing with lxml."""

MEGABYTES = 1000
"""Reading and checking take at most so much memory."""

_ROUNDS = 3


def _parse(path: Path) -> None:
    etree.parse(path, parser())


def _validate(path: Path) -> None:
    assert schema().validate(etree.parse(path, parser()))


def _read(path: Path) -> None:
    with path.open("rb") as stream:
        assert not read_model(stream, path.name).problems


def _check(path: Path) -> None:
    with path.open("rb") as stream:
        _, problems = reference().check(stream, path.name)
    assert not problems, problems[:3]


WAYS: dict[str, Callable[[Path], None]] = {
    "lxml": _parse,
    "lxml + schema": _validate,
    "reading": _read,
    "reading + checking": _check,
}


def _alone(*arguments: str) -> Any:
    """What this module prints when it runs in a process of its own."""
    command = [sys.executable, "-m", __spec__.name, *arguments]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)


def costs(path: Path) -> dict[str, tuple[float, float]]:
    """Median seconds of processor time and most megabytes of each way with the model at ``path``, all taken in turn."""
    taken: dict[str, list[tuple[float, float]]] = {way: [] for way in WAYS}
    for _ in range(_ROUNDS):
        for way in WAYS:
            seconds, megabytes = _alone("--way", way, str(path))
            taken[way].append((seconds, megabytes))
    return {
        way: (statistics.median(s for s, _ in measured), max(m for _, m in measured)) for way, measured in taken.items()
    }


def table(elements: int, size: int, measured: dict[str, tuple[float, float]]) -> Table:
    """The costs side by side."""
    parsing = measured["lxml"][0]
    title = f"a model of {elements:,} elements, {size / 1e6:.0f} MB; medians of {_ROUNDS} rounds"
    shown = empty_table(title, "|seconds|times lxml|at most|MB|at most")
    for way, (seconds, megabytes) in measured.items():
        times = seconds / parsing
        bounds = (limit(TIMES, times), limit(MEGABYTES, megabytes)) if way == "reading + checking" else ("", "")
        shown.add_row(way, f"{seconds:.2f}", f"{times:.1f}", bounds[0], f"{megabytes:.0f}", bounds[1])
    return shown


def of_a_large_model(elements: int = ELEMENTS) -> Table:
    """Measure each way with a model of about ``elements`` elements."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "large.xml"
        count = _alone("--make", "--elements", str(elements), str(path))
        return table(count, path.stat().st_size, costs(path))


@click.command()
@click.option("--make", is_flag=True, help="Only write the model to PATH.")
@click.option("--way", type=click.Choice(list(WAYS)), help="Only measure this, with the model at PATH.")
@click.option("--elements", default=ELEMENTS, show_default=True)
@click.argument("path", type=click.Path(path_type=Path), required=False)
def main(make: bool, way: str | None, elements: int, path: Path | None) -> None:
    """Make a large model and print the cost of each way. This process stays small, because child processes start with its memory."""
    if path is None:
        Console(width=100).print(of_a_large_model(elements))
    elif make:
        made = large_model(elements)
        path.write_bytes(write_model(made))
        click.echo(json.dumps(sum(1 for _ in walk(made)) - 1))
    elif way is not None:
        click.echo(json.dumps(_measured(WAYS[way], path)))


def _measured(way: Callable[[Path], None], path: Path) -> tuple[float, float]:
    """Seconds of processor time, and megabytes at most, as the program itself runs: without garbage collection."""
    gc.disable()
    began = time.process_time()
    way(path)
    return time.process_time() - began, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    main()
