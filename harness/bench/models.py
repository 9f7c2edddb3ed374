"""Measures what the reference tool chain does with models of several sizes, beside parsing them with lxml.

The command is ``python -m ucm_cts.harness.bench.models``. Each way runs in a process of its own, which has its own memory. lxml's parsing
is the measure, and the physical limit is expat that calls empty functions. The last columns say whether an element of the largest model
costs as much as one of the smallest.
"""

from __future__ import annotations

import functools
import gc
import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple
from xml.parsers import expat

import click
from lxml import etree
from rich.console import Console
from rich.table import Table

from ucm_cts.adapters.contract.metamodel.common import walk
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.contract.metamodel.writing import write_model
from ucm_cts.adapters.reference.toolchain.program import Program, reference
from ucm_cts.harness.bench.large_model import large_model
from ucm_cts.harness.bench.measuring import empty_table, limit
from ucm_cts.harness.toolchains.corpus.schema import parser, schema

SIZES = (10_000, 100_000, 1_000_000)
"""About how many elements the models have, the smallest first."""

LINEAR = 1.5
"""What an element of the largest model may cost, as a multiple of what one of the smallest costs: caches of processors are small."""

_ROUNDS = 3


class Aim(NamedTuple):
    """The limits of a way: multiples of parsing with lxml, and megabytes; None for no limit. All but lxml's own must be linear."""

    times: float | None = None
    megabytes: float | None = None


def _lxml(path: Path, _program: Program) -> None:
    etree.parse(path, parser())


def _lxml_with_schema(path: Path, _program: Program) -> None:
    assert schema().validate(etree.parse(path, parser()))


def _expat(path: Path, _program: Program) -> None:
    """What Python pays for being told of each element, whatever it makes of it: no program in it reads a model for less."""
    parsing = expat.ParserCreate()
    parsing.StartElementHandler = lambda _tag, _values: None
    parsing.EndElementHandler = lambda _tag: None
    with path.open("rb") as stream:
        parsing.ParseFile(stream)


def _read(path: Path, _program: Program) -> None:
    with path.open("rb") as stream:
        assert not read_model(stream, path.name).problems


def _check(path: Path, program: Program) -> None:
    with path.open("rb") as stream:
        _, problems = program.check(stream, path.name)
    assert not problems, problems[:3]


def _generate(task: str, path: Path, program: Program) -> None:
    with path.open("rb") as stream:
        files, problems = program.generate(task, stream, path.name)
    assert files, problems[:3]


PARSING = "lxml"
TASKS = ("check", "idl", "cpp11", "cpp03")

WAYS: dict[str, Callable[[Path, Program], None]] = {
    PARSING: _lxml,
    "lxml + schema": _lxml_with_schema,
    "expat, nothing kept": _expat,
    "reading": _read,
    "check": _check,
    **{task: functools.partial(_generate, task) for task in TASKS[1:]},
}
"""What is done with the model at a path; tasks begin with reading it, and those that generate with checking it."""

AIMS = {"check": Aim(3, 200), "idl": Aim(10), "cpp11": Aim(), "cpp03": Aim()}


class Cost(NamedTuple):
    """Seconds of processor time, and megabytes at most."""

    seconds: float
    megabytes: float


class Measured(NamedTuple):
    """What each way costs with one model."""

    elements: int
    bytes: int
    costs: Mapping[str, Cost]

    def each(self, way: str) -> float:
        """Seconds for one element."""
        return self.costs[way].seconds / self.elements


def _alone(*arguments: str) -> Any:
    """What this module prints when it runs in a process of its own."""
    command = [sys.executable, "-m", __spec__.name, *arguments]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)


def costs(path: Path) -> dict[str, Cost]:
    """Median seconds and most megabytes of each way with the model at ``path``, all taken in turn."""
    taken: dict[str, list[Cost]] = {way: [] for way in WAYS}
    for _ in range(_ROUNDS):
        for way in WAYS:
            taken[way].append(Cost(*_alone("--way", way, str(path))))
    return {
        way: Cost(statistics.median(one.seconds for one in all_), max(one.megabytes for one in all_))
        for way, all_ in taken.items()
    }


def table(measured: Iterable[Measured]) -> Table:
    """The costs of models side by side, the smallest model first."""
    models = list(measured)
    shown = empty_table(
        f"models, medians of {_ROUNDS} rounds",
        "|seconds|times lxml|at most|MB|at most|an element, × the smallest model's|at most",
    )
    for model in models:
        shown.add_section()
        shown.add_row(f"{model.elements:,} elements, {model.bytes / 1e6:.1f} MB")
        for way, cost in model.costs.items():
            aim = AIMS.get(way, Aim())
            times, growth = cost.seconds / model.costs[PARSING].seconds, model.each(way) / models[0].each(way)
            is_last = model is models[-1] and len(models) > 1
            shown.add_row(
                f"  {way}",
                f"{cost.seconds:.2f}",
                f"{times:.1f}",
                _limit(aim.times, times) if model is models[-1] else "",
                f"{cost.megabytes:.0f}",
                _limit(aim.megabytes, cost.megabytes),
                f"{growth:.2f}" if is_last else "",
                limit(LINEAR, growth) if is_last and way in AIMS else "",
            )
    return shown


def _limit(aim: float | None, measured: float) -> str:
    return limit(aim, measured) if aim is not None else ""


def of_large_models(sizes: Iterable[int] = SIZES) -> Table:
    """Measure each way with models of about so many elements."""
    return table([_of_a_model(size) for size in sorted(sizes)])


def _of_a_model(elements: int) -> Measured:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "large.xml"
        count = _alone("--make", "--elements", str(elements), str(path))
        return Measured(count, path.stat().st_size, costs(path))


@click.command()
@click.option("--make", is_flag=True, help="Only write a model, of the first size, to PATH.")
@click.option("--way", type=click.Choice(list(WAYS)), help="Only measure this, with the model at PATH.")
@click.option("--elements", type=int, multiple=True, default=SIZES, show_default=True, help="A size; give several.")
@click.argument("path", type=click.Path(path_type=Path), required=False)
def main(make: bool, way: str | None, elements: tuple[int, ...], path: Path | None) -> None:
    """Make large models and print the cost of each way. This process stays small, because child processes start with its memory."""
    if path is None:
        Console(width=120).print(of_large_models(elements))
    elif make:
        made = large_model(elements[0])
        path.write_bytes(write_model(made))
        click.echo(json.dumps(sum(1 for _ in walk(made)) - 1))
    elif way is not None:
        click.echo(json.dumps(_measured(WAYS[way], path)))


def _measured(way: Callable[[Path, Program], None], path: Path) -> Cost:
    """The cost as the program itself runs: without garbage collection. What is done only once, such as imports, was done before."""
    gc.disable()
    program = reference()
    with tempfile.TemporaryDirectory() as folder:
        small = Path(folder) / "small.xml"
        small.write_bytes(write_model(large_model(0)))
        way(small, program)
    began = time.process_time()
    way(path, program)
    return Cost(time.process_time() - began, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


if __name__ == "__main__":
    main()
