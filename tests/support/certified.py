"""Made-up certificates, and a verifier that believes them: what it is given is what it prints, or what it is told to do."""

from __future__ import annotations

import functools
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec
from files import SUPPORT

from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import Requirement, load_requirements
from ucm_cts.harness.catalogue.specification import load_specification
from ucm_cts.harness.certificates.verified import Subject, Uncovered, Verified, Waiver
from ucm_cts.harness.report.json_report import FindingEntry, ReportEntry, RequirementEntry, StatementEntry
from ucm_cts.harness.report.scope import Scope
from ucm_cts.harness.results.tally import overall
from ucm_cts.harness.results.values import Verdict

VERIFIER = (sys.executable, str(SUPPORT / "believing_verifier.py"))


@functools.cache
def decided_in(profile: str) -> tuple[Requirement, ...]:
    """The requirements that a run of ``profile`` decides."""
    return tuple(r for r in load_requirements() if r.profile in PARTS[profile] and not r.untestable and not r.pending)


def report(
    product: str = "Acme UCM", version: str = "1.0", profile: str = "container",
    verdicts: Mapping[str, Verdict] | None = None, observed: str = "It did not.", **changes: Any,
) -> ReportEntry:  # fmt: skip
    """A report in which all requirements pass but those of ``verdicts``."""
    given = verdicts or {}
    entries = tuple(_entry(one, given.get(one.id, "pass"), observed) for one in decided_in(profile))
    made = ReportEntry(
        product=product, version=version, profile=profile, verdict=overall(entries, (), ""), requirements=entries,
        scope=Scope(load_specification(), profile, len(entries), 0, 0),
        incidents=(), transitions=(), adapter="acme", suite_version="0.1.0", seed=42, started="2031-01-02T03:04:05+00:00",
        seconds=1.5, scenarios=4711, events=9000,
        statement=StatementEntry("", product, version, (), {}, {}, {}, ()), readings={"late-add": ("refuse",)},
        measures={}, seconds_by_clause={}, runs=1,
    )  # fmt: skip
    return msgspec.structs.replace(made, **changes)


def _entry(one: Requirement, verdict: Verdict, observed: str) -> RequirementEntry:
    found = FindingEntry("rule", "What the text says.", observed, 3, "", "", "a-scenario", (), "")
    why = "" if verdict in ("pass", "fail") else "No scenario could show it."
    return RequirementEntry(
        one.id, one.clause, one.title, one.level, verdict, 7 if verdict in ("pass", "fail") else 0, why,
        (found,) if verdict == "fail" else (),
    )  # fmt: skip


def verified(of: ReportEntry | None = None, **changes: Any) -> Verified:
    """A certificate of ``of`` that stands."""
    of = of or report()
    untestable = tuple(r.id for r in load_requirements() if r.profile in PARTS.get(of.profile, ()) and r.untestable)
    made = Verified(
        digest="", product=of.product, version=of.version, profile=of.profile, verdict=of.verdict,
        assurance="self-declared", signers=("acme",), issued="2031-02-03T04:05:06+00:00", suite_version=of.suite_version,
        specification="UCM 1.2 (formal/22-02-02)", isolation="bubblewrap", report=of,
        uncovered=Uncovered(untestable, tuple(r.id for r in of.requirements if r.verdict == "not applicable"), (), ("late-add",)),
        subjects=(Subject("libacme.so", "ab" * 32),), word=("That libacme.so is what customers get.",),
    )  # fmt: skip
    return msgspec.structs.replace(made, **changes)


def put(folder: Path, name: str, content: Verified | bytes) -> Path:
    """An archive for the believing verifier."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.ucmcert"
    path.write_bytes(content if isinstance(content, bytes) else msgspec.json.encode(content))
    return path


WAIVER = Waiver("R-11.2.2.1-13", "Mended in 1.3.", "2031-12-31")
