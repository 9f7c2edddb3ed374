"""Where commands take reports from: a ``report.json``, a certificate, or a folder that has some."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.comparison import Column, decoded_report, read_report
from ucm_cts.harness.results.foreign import one_line

CERTIFICATE = ".ucmcert"

MOST_FILES = 1_000
"""The most reports that one folder may have."""


def columns_in(places: Iterable[Path]) -> tuple[list[Column], list[str]]:
    """The reports in ``places``, and what to say of where they are from. Raises ``WrongUse`` and ``DocumentError``."""
    files = [file for place in places for file in _files(place)]
    remarks = [
        f"{one_line(str(file))}: the report in this certificate was taken as it is; to know that it stands: "
        "ucm-cts verify FILE --trust KEYS"
        for file in files
        if file.suffix == CERTIFICATE
    ]
    return [_column(file) for file in files], remarks


def _files(place: Path) -> Iterator[Path]:
    if not os.path.isdir(place):  # also of a name that is too long to ask for
        yield place
        return
    found = sorted(_below(place))
    if not found:
        raise WrongUse(f"there is no report.json in '{place}', and no certificate")
    if len(found) > MOST_FILES:
        raise WrongUse(f"there are more than {MOST_FILES} reports in '{place}'; name fewer")
    yield from found


def _below(folder: Path) -> Iterator[Path]:
    """Links to folders are not followed."""
    for parent, _, names in os.walk(folder):
        for name in names:
            if name == "report.json" or name.endswith(CERTIFICATE):
                yield Path(parent) / name


def _column(file: Path) -> Column:
    if file.suffix != CERTIFICATE:
        return Column(file, read_report(file))
    need("certificates", "reading a certificate")
    from ucm_cts.harness.certificates import archive
    from ucm_cts.harness.certificates.problems import Unreadable
    from ucm_cts.harness.certificates.reading import content_of

    try:
        members = archive.read(content_of(file))
    except Unreadable as error:
        raise DocumentError(file, None, one_line(error.problems[0].detail, 300)) from None
    return Column(file, decoded_report(file, members[archive.REPORT]))
