"""Writes a report's files, each of them whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ucm_cts.harness.catalogue.requirements import (
    Requirement,
    load_interpretations,
    load_life_cycle,
    requirements_of,
)
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.html import to_html
from ucm_cts.harness.report.json_report import to_json
from ucm_cts.harness.report.junit import to_junit
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.results.failures import FOLDER, STATEMENT, all_files
from ucm_cts.harness.results.foreign import clean_report, one_line
from ucm_cts.harness.results.values import Report
from ucm_cts.harness.statement.writing import to_toml
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable

REPORT_FILES = ("report.html", "report.json", "junit.xml")

FAILURE_FILES = tuple(f"{FOLDER}/{name}" for name in ("R-*.json", "R-*.xml", "unnamed*", "incident-*.json", "ics.toml"))
"""Patterns of the files of failures that a command writes."""


@dataclass(frozen=True)
class Saved:
    """Where a report is: ``place`` is None if no folder took it. ``problem`` says why it is not where it was to be."""

    place: Path | None
    problem: str = ""


def report_folder(out: Path, others: Sequence[str] = ()) -> OutFolder:
    """The folder ``out`` for a report, and for ``others``: patterns of further files."""
    return OutFolder(out, (*REPORT_FILES, *FAILURE_FILES, *others), (FOLDER,))


def prepare_folder(out: Path) -> None:
    """A folder, before time is spent on what goes into it. Raises ``WrongUse``."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=out).close()
    except OSError as error:
        raise WrongUse(f"the report cannot be written to '{out}': {error.strerror}; choose another folder") from None


def keep_report(report: Report, folder: OutFolder, instead_of: Sequence[str] = ()) -> Saved:
    """Write all files of ``report`` into ``folder``, or into a new folder elsewhere if that fails. Own files that match
    ``instead_of`` are removed as well.
    """
    return keep_files(report_files(report), folder, (*REPORT_FILES, *FAILURE_FILES, *instead_of))


def keep_files(files: Mapping[str, bytes], folder: OutFolder, instead_of: Sequence[str]) -> Saved:
    """Write ``files`` into ``folder`` in place of those that match ``instead_of``, or into a new folder elsewhere."""
    try:
        folder.save(files, instead_of)
        return Saved(folder.path)
    except (OSError, ValueError, WrongUse) as error:
        why = getattr(error, "strerror", None) or error
        problem = str(error) if isinstance(error, WrongUse) else f"'{folder.path}': {why}"
    for parent in (folder.path.parent, Path.cwd(), Path(tempfile.gettempdir())):
        place: Path | None = None
        try:
            place = Path(tempfile.mkdtemp(prefix=f"{folder.path.name or 'ucm-cts-report'}-", dir=parent))
            for name, content in files.items():
                (place / name).parent.mkdir(exist_ok=True)
                (place / name).write_bytes(content)
        except OSError:
            if place is not None:
                shutil.rmtree(place, ignore_errors=True)
            continue
        return Saved(place, problem)
    return Saved(None, problem)


def save_report(report: Report, out: Path) -> None:
    """Write all files of ``report`` into ``out``. Raises ``WrongUse`` and ``OSError``."""
    _save(report_files(report), out)


def write_report(
    report: Report,
    catalogue: Sequence[Requirement],
    table: LifeCycleTable,
    interpretations: Mapping[str, str],
    out: Path,
) -> None:
    """The same with the given catalogue and table. ``interpretations`` maps ids to decisions."""
    _save(made_files(report, catalogue, table, interpretations), out)


def _save(files: Mapping[str, bytes], out: Path) -> None:
    with report_folder(out) as folder:
        folder.save(files, (*REPORT_FILES, *FAILURE_FILES))


def report_files(report: Report) -> dict[str, bytes]:
    """All files of ``report``, by their names, with what the suite's own catalogue has for its profile."""
    decisions = {i.id: " ".join(i.lines) for i in load_interpretations()}
    catalogue = requirements_of(report.profile)
    return made_files(report, catalogue, load_life_cycle(), decisions)


def made_files(
    report: Report,
    catalogue: Sequence[Requirement],
    table: LifeCycleTable,
    interpretations: Mapping[str, str],
) -> dict[str, bytes]:
    """``report.html``, ``report.json``, ``junit.xml`` and ``failures/*``. ``interpretations`` maps ids to decisions."""
    cleaned = clean_report(report)
    return {
        **failure_files(report),
        "report.json": to_json(cleaned, catalogue),
        "junit.xml": to_junit(cleaned, catalogue),
        "report.html": to_html(cleaned, catalogue, table, interpretations).encode(),
    }


def failure_files(report: Report) -> dict[str, bytes]:
    """``failures/*``: scenarios or models that fail, and the statement that replays need."""
    files = dict(all_files(report))
    cleaned = clean_report(report)
    if cleaned.statement.source:
        files[STATEMENT] = to_toml(cleaned.statement, one_line(cleaned.adapter), STATEMENT).encode()
    return files


def write_whole(path: Path, content: bytes, mode: int = 0o644) -> None:
    """Replace the file at ``path`` at once: readers see the old file or the new one."""
    handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, mode)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
