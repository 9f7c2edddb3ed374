"""Reads what failed in the last run from its report in the folder of ``--out``: ``--failed-first`` begins with it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.report.comparison import read_report


@dataclass(frozen=True)
class Failed:
    """``requirements`` that failed, or whose scenarios met incidents; ``models`` of a tool chain that showed failures."""

    requirements: frozenset[str] = frozenset()
    models: frozenset[str] = frozenset()


def failed_in(out: Path, console: Output) -> Failed:
    """What failed in the last run into ``out``; nothing, with a line, if there is no report of one."""
    try:
        last = read_report(out / "report.json")
    except DocumentError as problem:
        console.say(f"--failed-first changes nothing: {problem}")
        return Failed()
    failed = [entry for entry in last.requirements if entry.verdict in ("fail", "error")]
    lost = (requirement for incident in last.incidents for requirement in incident.requirements)
    return Failed(
        frozenset({*(entry.id for entry in failed), *lost}),
        frozenset(finding.scenario for entry in failed for finding in entry.findings),
    )
