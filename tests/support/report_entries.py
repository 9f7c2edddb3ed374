"""Values of ``report.json`` as tests need them: any verdicts, in files as runs leave them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
from made_up_run import CATALOGUE, sample

from ucm_cts.harness.report.json_report import FindingEntry, ReportEntry, RequirementEntry, to_json
from ucm_cts.harness.results.foreign import clean_report
from ucm_cts.harness.results.values import Verdict

SAMPLE = msgspec.json.decode(to_json(clean_report(sample()), CATALOGUE), type=ReportEntry)
FINDING = FindingEntry("rule", "this", "that", 3, "", "", "scenario", (), "failures/x.json")


def requirement(id_: str, verdict: Verdict, observed: str = "that") -> RequirementEntry:
    findings = (msgspec.structs.replace(FINDING, observed=observed),) if verdict == "fail" else ()
    clause, times = id_.removeprefix("R-").rpartition("-")[0], 0 if verdict == "inconclusive" else 7
    return RequirementEntry(id_, clause, f"Title of {id_}", "shall", verdict, times, "", findings)


def report(name: str, *requirements: RequirementEntry, **changes: Any) -> ReportEntry:
    verdicts = {entry.verdict for entry in requirements}
    overall = "not conformant" if "fail" in verdicts else "inconclusive" if "inconclusive" in verdicts else "conformant"
    made: dict[str, Any] = {
        "product": name,
        "version": "1",
        "verdict": overall,
        "requirements": requirements,
        "incidents": (),
        "readings": {},
    }
    made |= changes
    left_out = sum(entry.verdict == "not applicable" for entry in requirements)
    asked = {"profile": made.get("profile", SAMPLE.profile), "asked": len(requirements) - left_out}
    scope = msgspec.structs.replace(SAMPLE.scope, not_applicable=left_out, **asked)
    return msgspec.structs.replace(SAMPLE, scope=scope, **made)


def save(folder: Path, *reports: ReportEntry) -> list[Path]:
    """A folder for each report, as ``ucm-cts run`` leaves it."""
    files = [folder / f"{number}" / "report.json" for number in range(len(reports))]
    for file, content in zip(files, reports, strict=True):
        file.parent.mkdir(exist_ok=True)
        file.write_bytes(msgspec.json.format(msgspec.json.encode(content)))
        file.with_name("report.html").write_text("")
    return files
