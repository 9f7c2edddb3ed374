"""``ucm-cts results``: published results of reports and kill matrices, and their pages."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import click

from ucm_cts.harness.cli.options import CONFORMANT, leave, out_folder
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.comparison import read_report
from ucm_cts.harness.report.published import PublishedResult, by_product, published, read_published, to_json
from ucm_cts.harness.report.published_pages import overview, product_page, table
from ucm_cts.harness.report.write import prepare_folder, write_whole
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.selftest.kill_record import KillRecord, file_name, read_matrix, read_record, to_lines

DETECTION, PAGE = "detection", "README.md"


@click.command()
@click.argument("sources", nargs=-1, type=click.Path(path_type=Path), metavar="[REPORT|FOLDER]...")
@out_folder("results", "The folder of results; those of other products stay.")
def results(sources: Sequence[Path], out: Path) -> None:
    """Keep reports for publication in a repository.

    Of each REPORT (report.json or matrix.json), or each of those in FOLDER, it keeps what is the same in every run, and writes
    a page for each product. Without one it writes the pages anew.
    """
    console = Output()
    kept = [_keep(file, out) for source in sources for file in _files(source)]
    if sources and not kept:
        raise WrongUse(f"there is neither report.json nor matrix.json in {', '.join(map(str, sources))}")
    for path in (*kept, *write_pages(out)):
        console.say(str(path))
    leave(console, CONFORMANT)


def _files(source: Path) -> Iterator[Path]:
    if source.is_file():
        yield source
    else:
        yield from sorted(file for name in ("report.json", "matrix.json") for file in source.rglob(name))


def _keep(file: Path, out: Path) -> Path:
    if file.name == "matrix.json":
        matrix = read_matrix(file)
        path, content = out / DETECTION / file_name(matrix), to_lines(matrix)
    else:
        report = read_report(file)
        if report.incomplete or report.selection:
            what = f"incomplete ({one_line(report.incomplete)})" if report.incomplete else "of a selection (-k)"
            raise WrongUse(f"'{file}' is {what}; only reports of whole runs are published")
        return keep(published(report), out)
    return _write(path, content)


def keep(result: PublishedResult, out: Path) -> Path:
    """Write ``result`` into the folder of results ``out``, in place of an older one. Returns its file. Raises ``WrongUse``."""
    return _write(out / result.folder / f"{result.profile}.json", to_json(result))


def _write(path: Path, content: bytes) -> Path:
    prepare_folder(path.parent)
    write_whole(path, content)
    return path


def write_pages(folder: Path) -> list[Path]:
    """Write all pages of the results in ``folder`` anew. Returns their files. Raises ``DocumentError``."""
    written = pages(folder)
    for path, text in written.items():
        write_whole(path, text.encode())
    return [*written]


def pages(folder: Path) -> dict[Path, str]:
    """All pages of the results in ``folder``, by their files. Raises ``DocumentError``."""
    found = read_published(folder)
    records = {path.stem: read_record(path) for path in (folder / DETECTION).glob("*s.jsonl")}
    lines = ["# Results", "", "Made by `ucm-cts results` of the files in this folder; do not edit it.", ""]
    lines += overview(found)
    if records:
        lines += ["", "## Self-tests", "", *_self_tests(records)]
    products = {
        folder / name / PAGE: product_page(group, sorted({p.name for p in (folder / name).glob("*.md")} - {PAGE}))
        for name, group in by_product(found).items()
    }
    return {folder / PAGE: "\n".join(lines) + "\n", **products}


def _self_tests(records: dict[str, KillRecord]) -> list[str]:
    heads = (
        "of",
        "mutants killed",
        "requirements with a killed mutant",
        "variants spared",
        "cheats found out",
        "lines",
    )
    rows = []
    for name, record in sorted(records.items()):
        testable, proved = record.self_test.testable, record.self_test.testable - len(record.self_test.unproved)
        rows.append(
            (
                name,
                _of([mutant.killed for mutant in record.mutants]),
                f"{proved} of {testable}",
                _of([variant.spared for variant in record.variants]),
                _of([cheat.found_out for cheat in record.cheats]),
                f"[{name}.jsonl]({DETECTION}/{name}.jsonl)",
            )
        )
    return table(heads, rows)


def _of(good: Sequence[bool]) -> str:
    return f"{sum(good)} of {len(good)}" if good else ""
