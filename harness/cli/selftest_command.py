"""``ucm-cts selftest``: its options. What it does is imported when it is asked for: no other command needs mutants."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import click

from ucm_cts.harness.cli.options import out_folder


@click.command()
@click.argument("names_wanted", metavar="[NAME]...", nargs=-1)
@click.option("--quick", is_flag=True, help="End with each mutant as soon as it is killed, and leave the variants out.")
@click.option(
    "--whole", is_flag=True, help="Run all of profile core on each subject, not only the clauses that it concerns."
)
@click.option(
    "--real-time",
    is_flag=True,
    help="Run in real time what usually runs in virtual time, which takes as long as subjects wait.",
)
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    default=2 * (os.cpu_count() or 1),
    show_default="two for each processor",
    help="How many run at once.",
)
@click.option(
    "--seed", type=int, default=1, show_default=True, help="All names and data that a mutant sees are drawn from it."
)
@out_folder("ucm-cts-selftest", "The folder for the outcome: matrix.html and matrix.json.")
@click.option("--toolchains", is_flag=True, help="Examine tool chains, derived from the reference tool chain.")
@click.option("--list", "listed", is_flag=True, help="Name all mutants and variants, and run nothing.")
def selftest(
    names_wanted: Sequence[str],
    quick: bool,
    whole: bool,
    real_time: bool,
    jobs: int,
    seed: int,
    out: Path,
    toolchains: bool,
    listed: bool,
) -> None:
    """Test the suite itself on products whose verdict is known.

    There are mutants, each with one defect, conformant variants, and cheats, which recognise that they are tested; NAME chooses
    some. A mutant is killed if each requirement that it violates fails, and a finding names the events in which it differs from
    the framework it was made from. Exit status 1 if one survives or fails something else, if a variant fails, or if a cheat is
    not found out.
    """
    from ucm_cts.harness.cli.selftest_run import Wanted, examine

    examine(Wanted(tuple(names_wanted), quick, whole, real_time, jobs, seed, out, toolchains, listed))
