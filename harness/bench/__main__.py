"""Print what testing costs: ``python -m ucm_cts.harness.bench``."""

from __future__ import annotations

from rich.console import Console

from ucm_cts.harness.bench import endpoints, growth, judging, models

EVENTS = 1_000_000

WIDTH = 120
"""The width, in columns, of output to a file: no table is squeezed."""


def main() -> None:
    """Measure, and print each table when it is there. Memory is measured first, before anything else uses it."""
    console = Console()
    if not console.is_terminal:
        console.width = WIDTH
    with console.status("judging a million events ..."):
        life = judging.of_a_long_life(EVENTS)
    with console.status("judging the suite's own scenarios ..."):
        own = [judging.of_the_suite(profile) for profile in ("container", "core")]
    console.print(judging.table([life, *own]))
    with console.status("judging scenarios with many parts ..."):
        console.print(growth.table())
    with console.status("going through the endpoints ..."):
        for table in endpoints.tables():
            console.print(table)
    with console.status("checking and generating from models of up to a million elements ..."):
        console.print(models.of_large_models())


if __name__ == "__main__":
    main()
