"""Failing scenarios as files: names, text, and the command that replays them."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from typing import Any

import msgspec
import yaml

from ucm_cts.harness.results import values as v
from ucm_cts.harness.results.foreign import one_line

FOLDER = "failures"

STATEMENT = f"{FOLDER}/ics.toml"
"""The vendor's statement, for replays; it is there if a vendor gave one."""

_ODD = re.compile(r"[^A-Za-z0-9._-]+")


def file_name(requirement: str, number: int, kind: str = "json") -> str:
    """Where the ``number``-th failure (from 0, the shortest) of a requirement is saved, relative to the report.

    ``kind`` is ``json`` for a scenario, ``xml`` for a model.
    """
    stem = _ODD.sub("-", requirement)[:80].lstrip(".")
    stem = stem if stem.startswith("R-") else f"unnamed-{stem}"
    return f"{FOLDER}/{stem}{f'-{number + 1}' if number else ''}.{kind}"


def shortest_first(findings: tuple[v.ReportedFinding, ...]) -> list[v.ReportedFinding]:
    """Findings by the length of their scenarios; those without come first."""
    return sorted(findings, key=reading_length)


def reading_length(failed: v.ReportedFinding) -> tuple[int, int]:
    """The length for a reader: a scenario's steps, then events; or a model's lines."""
    if isinstance(failed.evidence, v.FactEvidence):
        return failed.evidence.processed.model.count("\n"), 0
    return length(failed.execution)


def length(execution: v.Execution | None) -> tuple[int, int]:
    """The length for a reader: steps, then events."""
    return (len(execution.scenario.steps), len(execution.trace)) if execution is not None else (0, 0)


def incident_file(number: int) -> str:
    """Where the scenario of the ``number``-th incident (from 0) is saved, relative to the report."""
    return f"{FOLDER}/incident-{number + 1}.json"


def replay_command(file: str, report: v.Report) -> str:
    """The command that replays a saved scenario, in the report's folder."""
    statement = f" --ics {STATEMENT}" if report.statement.source else ""
    return f"ucm-cts replay {file} {shlex.quote(one_line(report.adapter))}{statement}"


def repeat_command(report: v.Report) -> str:
    """The command that repeats the whole run."""
    adapter, profile = shlex.quote(one_line(report.adapter)), shlex.quote(one_line(report.profile))
    source = report.statement.source
    statement = f" --ics {shlex.quote(one_line(source))}" if source else ""
    selection = f" -k {shlex.quote(one_line(report.selection))}" if report.selection else ""
    statement = selection + statement
    if not isinstance(report, v.FrameworkReport):
        return f"ucm-cts run --toolchain {adapter} --profile {profile} --seed {report.seed}{statement}"
    runs = f" --repeat {report.runs}" if report.runs > 1 else ""
    return f"ucm-cts run {adapter} --profile {profile} --seed {report.seed}{runs}{statement}"


def saved(execution: v.Execution, exercises: tuple[str, ...]) -> dict[str, Any]:
    """The text of a scenario file: a script with one scenario."""
    return {"scenario": execution.name, "exercises": list(exercises), **msgspec.to_builtins(execution.scenario)}


def all_files(report: v.Report) -> Iterator[tuple[str, bytes]]:
    """Every file to write, by its name relative to the report."""
    for result in report.requirements:
        for number, failed in enumerate(shortest_first(result.findings)):
            match failed.evidence:
                case v.TraceEvidence(execution=execution):
                    yield file_name(result.id, number), _json(saved(execution, (result.id,)))
                case v.FactEvidence(processed=processed):
                    yield file_name(result.id, number, "xml"), processed.model.encode(errors="replace")
    for number, incident in enumerate(v.incidents_of(report)):
        yield incident_file(number), _json(saved(incident.execution, ()))


def _json(content: dict[str, Any]) -> bytes:
    return msgspec.json.format(msgspec.json.encode(content), indent=2) + b"\n"


def scenario_text(execution: v.Execution, longest: int = 60) -> str:
    """The scenario for a reader: components, then one step a line."""
    content = msgspec.to_builtins(execution.scenario)
    rows = [f"scenario: {_flow(execution.name)}", "components:"]
    rows += [f"  {_flow(name)}: {_flow(declaration)}" for name, declaration in content.get("components", {}).items()]
    rows.append("steps:")
    steps = content.get("steps", [])
    rows += [f"  - {_flow(step)}" for step in steps[:longest]]
    if len(steps) > longest:
        rows.append(f"  # {len(steps) - longest} more steps; the saved file has them all")
    return "\n".join(rows)


def _flow(value: Any) -> str:
    text = yaml.safe_dump(value, default_flow_style=True, sort_keys=False, width=10_000, allow_unicode=True)
    text = text.removesuffix("\n").removesuffix("\n...")
    return text if len(text) <= 1_000 else text[:999] + "…"
