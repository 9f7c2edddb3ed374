"""Measures several ways side by side: medians of rounds taken alternately, so that a slower machine slows all ways."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from rich.table import Table

ROUNDS = 7


def medians(cases: dict[str, Callable[[], float]], rounds: int = ROUNDS) -> dict[str, float]:
    """The median cost of each case; a round more comes first, which warms up and does not count."""
    taken: dict[str, list[float]] = {name: [] for name in cases}
    for turn in range(rounds + 1):
        for name, measure in cases.items():
            cost = measure()
            if turn:
                taken[name].append(cost)
    return {name: statistics.median(costs) for name, costs in taken.items()}


def timed(action: Callable[[], object], times: int, each: int = 1) -> float:
    """Microseconds that ``action`` takes; divided by ``each``, the number of operations in one ``action``."""
    began = time.perf_counter()
    for _ in range(times):
        action()
    return (time.perf_counter() - began) / times / each * 1e6


def empty_table(title: str, heads: str) -> Table:
    """A table without rows; ``heads`` are separated by ``|``. Columns of figures, all but the first one, are justified right."""
    table = Table(title=title, title_justify="left")
    for number, head in enumerate(heads.split("|")):
        table.add_column(head, justify="right" if number else "left")
    return table


def limit(aim: float, *measured: float) -> str:
    """The aim, and whether it is kept."""
    return f"{aim:g} [green]✓[/]" if round(max(measured), 1) <= aim else f"{aim:g} [bold red]✗ missed[/]"
