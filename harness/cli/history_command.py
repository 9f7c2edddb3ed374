"""``ucm-cts history``: appends runs to a history, and says how verdicts and costs changed."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click
import msgspec

from ucm_cts.harness.cli.options import CONFORMANT, leave
from ucm_cts.harness.cli.report_sources import columns_in
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.history.store import append, read
from ucm_cts.harness.history.telling import told
from ucm_cts.harness.history.trends import trends
from ucm_cts.harness.hosting.extras import need


@click.command()
@click.argument("reports", nargs=-1, type=click.Path(path_type=Path), metavar="[REPORT|FOLDER]...")
@click.option(
    "--database",
    type=click.Path(path_type=Path),
    default=Path("ucm-cts-history.duckdb"),
    show_default=True,
    help="The file with the history, a DuckDB database.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the trends as JSON.")
def history(reports: Sequence[Path], database: Path, as_json: bool) -> None:
    """Append reports to a history, and show trends.

    Each REPORT, or those in FOLDER, are appended; without them the history is only shown. It shows the verdicts and costs of each product and profile from run to run, and the first version that did not pass a
    requirement any more. A report that is in the history is not appended again; one of a part of a run is left out.
    """
    need("history", "a history")
    console = Output()
    columns, remarks = columns_in(reports)
    whole = [column for column in columns if not (column.report.incomplete or column.report.selection)]
    if reports:
        for column in columns:
            if column not in whole:
                remarks.append(f"{column.path} is left out: it is of a part of a run")
        new = append(database, [column.report for column in whole])
        number = sum(new)
        remarks.append(f"{number} run{'' if number == 1 else 's'} appended to {database}, {len(new) - number} known")
    found = trends(read(database))
    if as_json:
        console.say(msgspec.json.encode(found).decode())
    else:
        for remark in remarks:
            console.say(remark)
        for trend in found:
            for line in told(trend):
                console.say(line)
    leave(console, CONFORMANT)
