"""Where commands take reports from: a ``report.json``, a folder that has some, or a certificate."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.comparison import Column, read_report

MOST_FILES = 1_000
"""The most reports that one folder may have."""


def columns_in(places: Iterable[Path]) -> tuple[list[Column], list[str]]:
    """The reports in ``places``, and what to say of where they are from. Raises ``WrongUse`` and ``DocumentError``."""
    return [Column(file, read_report(file)) for place in places for file in _files(place)], []


def _files(place: Path) -> Iterator[Path]:
    if not place.is_dir():
        yield place
        return
    found = list(_reports_below(place))
    if not found:
        raise WrongUse(f"there is no report.json in '{place}'")
    if len(found) > MOST_FILES:
        raise WrongUse(f"there are more than {MOST_FILES} reports in '{place}'; name fewer")
    yield from sorted(found)


def _reports_below(folder: Path) -> Iterator[Path]:
    """Links to folders are not followed."""
    for parent, _, names in os.walk(folder):
        if "report.json" in names:
            yield Path(parent) / "report.json"
