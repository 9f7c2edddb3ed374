"""Published results: the part of a report that is the same in every run on one product. The files are under version control.

They hold no time, seed, count or path, so a difference between two of them is a changed verdict.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, read_text
from ucm_cts.harness.catalogue.profiles import PARTS, PROFILES
from ucm_cts.harness.catalogue.requirements import Level
from ucm_cts.harness.report.json_report import ReportEntry, StatementEntry
from ucm_cts.harness.report.order import clause_key
from ucm_cts.harness.report.stated import of_profile
from ucm_cts.harness.results.values import Overall, Verdict


class PublishedVerdict(Value, frozen=True):
    """The verdict on one requirement.

    ``title`` and ``reason`` are given only where the verdict is not ``pass``.
    """

    id: str
    level: Level
    verdict: Verdict
    title: str = ""
    reason: str = ""

    @property
    def clause(self) -> str:
        """The clause of the requirement."""
        return self.id.removeprefix("R-").rpartition("-")[0]


class PublishedFailure(Value, frozen=True):
    """One cause of failure. ``waived`` says why it was expected, ``unstable`` why it does not count; both are usually empty."""

    requirement: str
    clause: str
    expected: str
    observed: str
    scenario: str = ""
    waived: str = ""
    unstable: str = ""


class PublishedIncident(Value, frozen=True):
    """A scenario that ended the framework's host."""

    kind: str
    detail: str
    scenario: str


class PublishedResult(Value, frozen=True):
    """The result of one product in one profile.

    ``statement`` is what the vendor stated of the profile, None where the vendor stated nothing. ``readings`` are the
    observed readings of each option that the vendor declares no value of; of others a run may show one value more or less.
    """

    product: str
    version: str
    profile: str
    verdict: Overall
    suite_version: str
    requirements: tuple[PublishedVerdict, ...]
    failures: tuple[PublishedFailure, ...] = ()
    incidents: tuple[PublishedIncident, ...] = ()
    readings: dict[str, tuple[str, ...]] = {}
    statement: StatementEntry | None = None

    @property
    def folder(self) -> str:
        """The folder of the product and version, a name that is safe in paths and links."""
        name = f"{self.product}-{self.version}".lower().replace("+", "p")
        return re.sub(r"[^a-z0-9.]+", "-", name).strip("-.") or "product"

    @property
    def place(self) -> tuple[str, int]:
        """The place of the result among others: by product, and by profile as the profiles are listed."""
        return self.folder, PROFILES.index(self.profile)


def published(report: ReportEntry) -> PublishedResult:
    """What is kept of ``report``, in an order that does not depend on the run."""
    failures = {
        PublishedFailure(r.id, r.clause, f.expected, f.observed, f.scenario, f.waived, f.unstable)
        for r in report.requirements
        for f in r.findings
    }
    incidents = {PublishedIncident(i.kind, i.detail.partition("\n")[0], i.scenario) for i in report.incidents}
    declared = {option for option, value in report.statement.readings.items() if value != "observed"}
    return PublishedResult(
        report.product,
        report.version,
        report.profile,
        report.verdict,
        report.suite_version,
        tuple(
            PublishedVerdict(r.id, r.level, r.verdict, "" if r.verdict == "pass" else r.title, r.reason)
            for r in sorted(report.requirements, key=lambda r: (clause_key(r.clause), r.id))
        ),
        tuple(sorted(failures, key=lambda f: (clause_key(f.clause), msgspec.structs.astuple(f)))),
        tuple(sorted(incidents, key=msgspec.structs.astuple)),
        {option: tuple(sorted(seen)) for option, seen in sorted(report.readings.items()) if option not in declared},
        of_profile(report.statement, PARTS[report.profile]) if report.statement.source else None,
    )


def to_json(result: PublishedResult) -> bytes:
    """The file of ``result``: one line a requirement, a failure, an incident and an option."""
    fields: dict[str, Any] = msgspec.to_builtins(result)
    return ("{\n" + ",\n".join(f" {_text(name)}: {_block(value)}" for name, value in fields.items()) + "\n}\n").encode()


def _block(value: object) -> str:
    match value:
        case [_, *_]:
            return "[\n  " + ",\n  ".join(map(_text, value)) + "\n ]"
        case dict() if value:
            return "{\n  " + ",\n  ".join(f"{_text(name)}: {_text(entry)}" for name, entry in value.items()) + "\n }"
    return _text(value)


def _text(value: object) -> str:
    return msgspec.json.encode(value).decode()


def read_published(folder: Path) -> list[PublishedResult]:
    """All results below ``folder``, by product and profile. Raises ``DocumentError``."""
    return sorted(map(_read, folder.glob("*/*.json")), key=lambda result: result.place)


def _read(path: Path) -> PublishedResult:
    try:
        result = msgspec.json.decode(read_text(path), type=PublishedResult)
    except msgspec.MsgspecError as error:
        raise DocumentError(
            path, None, f"is no published result ({error}); write it anew with ucm-cts results"
        ) from None
    if result.profile not in PROFILES:
        raise DocumentError(path, None, f"names no profile ('{result.profile}'); write it anew with ucm-cts results")
    return result


def by_product(results: Iterable[PublishedResult]) -> dict[str, list[PublishedResult]]:
    """The results by the folder of their product."""
    folders: dict[str, list[PublishedResult]] = {}
    for result in results:
        folders.setdefault(result.folder, []).append(result)
    return folders
