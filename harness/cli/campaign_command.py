"""``ucm-cts campaign``: its options. What it does is imported when it is asked for: no other command needs a cluster."""

from __future__ import annotations

import os
from pathlib import Path

import click

from ucm_cts.harness.cli.options import out_folder


@click.command()
@click.argument("plan", type=click.Path(dir_okay=False, path_type=Path))
@out_folder("ucm-cts-campaign", "The folder for results, reports and the page.")
@click.option(
    "--scheduler",
    metavar="ADDRESS",
    help="The Dask scheduler of a cluster, as tcp://HOST:8786 or tls://HOST:8786.  [default: workers on this machine]",
)
@click.option(
    "--workers",
    type=click.IntRange(1, 1_000),
    default=os.cpu_count() or 1,
    show_default="one for each processor",
    help="How many workers there are on this machine.",
)
@click.option(
    "--dashboard",
    default="127.0.0.1:0",
    metavar="HOST:PORT",
    help="Where Dask's dashboard is, while workers of this machine work.  [default: this machine, a free port]",
)
@click.option(
    "--database",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Append all whole runs to this history, which 'ucm-cts history' shows.",
)
@click.option(
    "--dry-run", "is_dry", is_flag=True, help="Say how many units there are and how many are missing, and run nothing."
)
def campaign(
    plan: Path, out: Path, scheduler: str | None, workers: int, dashboard: str, database: Path | None, is_dry: bool
) -> None:
    """Run many products, profiles and seeds on many workers.

    PLAN is a TOML file that names them, and self-tests. Each result is kept in --out as soon as it is there: the same command goes on where an
    earlier one ended, however it ended. The page is index.html. Exit status 1 unless all runs are conformant and all self-tests
    as they should be.
    """
    from ucm_cts.harness.cli.campaign_run import Wanted, carry_out_plan

    carry_out_plan(Wanted(plan, out, scheduler, workers, dashboard, database, is_dry))
