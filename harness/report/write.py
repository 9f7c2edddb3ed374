"""Writes a report's files, each of them whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import (
    Requirement,
    load_interpretations,
    load_life_cycle,
    load_requirements,
)
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.html import to_html
from ucm_cts.harness.report.json_report import to_json
from ucm_cts.harness.report.junit import to_junit
from ucm_cts.harness.results.failures import FOLDER, STATEMENT, all_files
from ucm_cts.harness.results.foreign import clean_report, one_line
from ucm_cts.harness.results.values import Report
from ucm_cts.harness.statement.writing import to_toml
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable


def prepare_folder(out: Path) -> None:
    """The report's folder, before time is spent on what goes into it. Raises ``WrongUse``."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=out).close()
    except OSError as error:
        raise WrongUse(f"the report cannot be written to '{out}': {error.strerror}; choose another folder") from None


def save_report(report: Report, out: Path) -> None:
    """Write all files of ``report`` into ``out``, with what the suite's own catalogue has for its profile."""
    decisions = {i.id: " ".join(i.lines) for i in load_interpretations()}
    catalogue = [r for r in load_requirements() if r.profile in PARTS[report.profile]]
    write_report(report, catalogue, load_life_cycle(), decisions, out)


def write_report(
    report: Report,
    catalogue: Sequence[Requirement],
    table: LifeCycleTable,
    interpretations: Mapping[str, str],
    out: Path,
) -> None:
    """Write ``report.html``, ``report.json``, ``junit.xml`` and ``failures/*.json`` into ``out``.

    The folder is made if needed. ``interpretations`` maps ids to decisions.
    Failures that an earlier run left in ``out`` are removed.
    """
    cleaned = clean_report(report)
    write_failures(report, out)
    write_whole(out / "report.json", to_json(cleaned, catalogue))
    write_whole(out / "junit.xml", to_junit(cleaned, catalogue))
    write_whole(out / "report.html", to_html(cleaned, catalogue, table, interpretations).encode())


def write_failures(report: Report, out: Path) -> None:
    """Write ``failures/*.json`` into ``out``, and the statement that replays need; failures of an earlier run are removed."""
    cleaned = clean_report(report)
    folder = out / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    names = set()
    for name, content in all_files(report):
        write_whole(out / name, content)
        names.add(out / name)
    if cleaned.statement.source:
        text = to_toml(cleaned.statement, one_line(cleaned.adapter), STATEMENT)
        write_whole(out / STATEMENT, text.encode())
    else:
        (out / STATEMENT).unlink(missing_ok=True)
    for stale in {*folder.glob("*.json"), *folder.glob("*.xml")} - names:
        stale.unlink(missing_ok=True)


def write_whole(path: Path, content: bytes) -> None:
    """Replace the file at ``path`` at once: readers see the old file or the new one."""
    handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
