"""``ucm-cts compare``: reports of several runs side by side, or what changed from a baseline."""

from __future__ import annotations

import glob
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

import click
from click.core import ParameterSource

from ucm_cts.harness.cli.options import CONFORMANT, NOT_CONFORMANT, leave, out_file
from ucm_cts.harness.cli.report_sources import columns_in
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.baseline import changes, pairs
from ucm_cts.harness.report.baseline_formats import github_annotations, lines, to_junit
from ucm_cts.harness.report.comparison import compare as lay_side_by_side
from ucm_cts.harness.report.comparison import side_by_side
from ucm_cts.harness.report.comparison_page import to_html
from ucm_cts.harness.report.order import count
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.results.foreign import one_line


@click.command()
@click.argument("reports", nargs=-1, type=click.Path(path_type=Path), metavar="REPORT...")
@out_file("ucm-cts-comparison.html", "The page to write; with --baseline it is written if this is given.")
@click.option(
    "--baseline",
    type=click.Path(path_type=Path),
    metavar="OLD",
    help="Say what changed from OLD to REPORT. Both are reports, folders of them or certificates.",
)
@click.option(
    "--junit",
    type=click.Path(dir_okay=False, path_type=Path),
    help="With --baseline: write the changes for a CI; a regression is a failure, a known failure is skipped.",
)
@click.option("--annotations", "annotated", is_flag=True, help="With --baseline: print annotations for GitHub, too.")
@click.pass_context
def compare(
    context: click.Context,
    reports: Sequence[Path],
    out: Path,
    baseline: Path | None,
    junit: Path | None,
    annotated: bool,
) -> None:
    """Lay reports side by side, or say what has changed.

    Each REPORT is a report.json. The page shows them requirement by requirement, and leads to each report.html. A file that no
    earlier command wrote, or that was changed since, is never replaced.

    With --baseline OLD: say which requirements are fixed, regressed, new, gone or unstable in REPORT. Exit status 1 if one that
    decides verdicts has regressed.
    """
    if baseline is not None:
        is_given = context.get_parameter_source("out") is ParameterSource.COMMANDLINE
        _compare_with(baseline, reports, junit, annotated, out if is_given else None)
    if junit is not None or annotated:
        raise WrongUse(f"{'--junit' if junit is not None else '--annotations'} takes --baseline OLD")
    console = Output()
    comparison = lay_side_by_side(reports)
    _save(out, to_html(comparison, out.parent).encode(), "--out")
    for column in comparison.columns:
        counts = count(column.report.requirements)
        summary = ", ".join(f"{number} {verdict}" for verdict, number in counts.items() if number)
        console.say(f"{one_line(column.name, 80)}: {summary}")
    shared = comparison.shared
    apart = sum(row.differs for row in shared)
    console.say(f"{len(shared)} requirements are asked of all; on {apart} they differ. {out} shows it")
    leave(console, CONFORMANT)


def _compare_with(
    baseline: Path, reports: Sequence[Path], junit: Path | None, annotated: bool, out: Path | None
) -> NoReturn:
    console = Output()
    if not reports:
        raise WrongUse("no REPORT is named to compare with the baseline: ucm-cts compare --baseline OLD NEW")
    old, remarks = columns_in([baseline])
    new, others = columns_in(reports)
    found = [changes(*pair) for pair in pairs(old, new)]
    if out is not None:
        if len(found) > 1:
            raise WrongUse(f"one page shows one product and profile, and these are {len(found)}; leave out --out")
        _save(out, to_html(side_by_side([found[0].old, found[0].new]), out.parent).encode(), "--out")
    if junit is not None:
        _save(junit, to_junit(found), "--junit")
    for remark in dict.fromkeys((*remarks, *others)):
        console.say(remark)
    for each in found:
        for line in lines(each):
            console.say(line)
        for line in github_annotations(each) if annotated else ():
            console.say(line)
    leave(console, NOT_CONFORMANT if any(each.has_regressed for each in found) else CONFORMANT)


def _save(path: Path, content: bytes, option: str) -> None:
    try:
        with OutFolder(path.parent, (glob.escape(path.name),)) as folder:
            folder.save({path.name: content})
    except OSError as error:
        raise WrongUse(f"'{path}' cannot be written: {error.strerror}; choose another {option}") from None
