"""``ucm-cts compare``: reports of several runs side by side."""

from __future__ import annotations

import glob
from collections.abc import Sequence
from pathlib import Path

import click

from ucm_cts.harness.cli.options import CONFORMANT, leave, out_file
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.comparison import compare as lay_side_by_side
from ucm_cts.harness.report.comparison_page import to_html
from ucm_cts.harness.report.order import count
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.results.foreign import one_line


@click.command()
@click.argument("reports", nargs=-1, type=click.Path(dir_okay=False, path_type=Path), metavar="REPORT...")
@out_file("ucm-cts-comparison.html", "The page to write.")
def compare(reports: Sequence[Path], out: Path) -> None:
    """Lay the reports in the files REPORT, each a report.json, side by side, requirement by requirement.

    The page needs nothing else, and leads to each report.html beside its report.json. A file that no earlier command wrote, or
    that was changed since, is never replaced.
    """
    console = Output()
    comparison = lay_side_by_side(reports)
    try:
        with OutFolder(out.parent, (glob.escape(out.name),)) as folder:
            folder.save({out.name: to_html(comparison, out.parent).encode()})
    except OSError as error:
        raise WrongUse(f"'{out}' cannot be written: {error.strerror}; choose another --out") from None
    for column in comparison.columns:
        counts = count(column.report.requirements)
        summary = ", ".join(f"{number} {verdict}" for verdict, number in counts.items() if number)
        console.say(f"{one_line(column.name, 80)}: {summary}")
    shared = comparison.shared
    apart = sum(row.differs for row in shared)
    console.say(f"{len(shared)} requirements are asked of all; on {apart} they differ. {out} shows it")
    leave(console, CONFORMANT)
