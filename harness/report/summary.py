"""The report in the terminal: the verdict, each failure in three lines, and the path of the page."""

from __future__ import annotations

from pathlib import Path

from rich.console import Group, RenderableType
from rich.text import Text

from ucm_cts.harness.report.diagrams.sequence import last_call
from ucm_cts.harness.report.order import SEALS, SYMBOLS, by_own_cause, count, counted, sides, to_fix
from ucm_cts.harness.results.failures import shortest_first
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import all_known
from ucm_cts.harness.results.values import Overall, Report, RequirementResult, Verdict, incidents_of

SHOWN = 12
"""The number of failed requirements, and of incidents, that are listed."""

_COLOURS: dict[Verdict, str] = {
    "fail": "red",
    "error": "magenta",
    "inconclusive": "yellow",
    "pass": "green",
    "not applicable": "dim",
}
_STYLES: dict[Overall, str] = {"conformant": "bold green", "not conformant": "bold red", "inconclusive": "bold yellow"}


def summary(report: Report, out: Path | None = None) -> RenderableType:
    """What to print at the end of a run; ``out`` is the folder the report was written to."""
    name = one_line(f"{report.product} {report.version}", 80)
    known = " (all failures known)" if all_known(report) else ""
    lines = [
        Text.assemble(
            (f"{SEALS[report.verdict]} {report.verdict.upper()}{known}", _STYLES[report.verdict]),
            f"  {name}, profile {one_line(report.profile, 40)}",
        ),
        _counts(report),
        *(Text(f"  {side}", "dim") for side in sides(report)),
    ]
    failed, same_cause = by_own_cause(to_fix(report.requirements))
    for result in failed[:SHOWN]:
        lines += [Text(), *_failure(result)]
    if len(failed) > SHOWN:
        lines += [Text(), Text(f"and {len(failed) - SHOWN} more failed requirements", "dim")]
    if same_cause:
        lines += [Text(), Text(f"and {same_cause} more requirements that fail for causes shown above", "dim")]
    incidents = incidents_of(report)
    if incidents:
        lines.append(Text())
    for item in incidents[:SHOWN]:
        during = last_call(item.execution)
        detail = one_line(f"{item.incident.detail}{f', during {during}' if during else ''}", 160)
        lines.append(cut(Text.assemble(("⚡ ", "magenta"), (item.incident.kind, "bold magenta"), f"  {detail}")))
    if len(incidents) > SHOWN:
        lines.append(Text(f"and {len(incidents) - SHOWN} more incidents", "dim"))
    if out is not None:
        lines += [Text(), Text.assemble("report  ", (str(out / "report.html"), "bold"), overflow="fold")]
    return Group(*lines)


def _counts(report: Report) -> Text:
    line = Text("  ")
    for verdict, number in count(report.requirements).items():
        if number:
            line.append(f"{SYMBOLS[verdict]} {number} {verdict}", _COLOURS[verdict]).append("   ")
    amounts = "".join(f"{number:,} {unit}, " for number, unit in counted(report))
    line.append(f"{amounts}{report.seconds:.1f} s", "dim")
    return line


def _failure(result: RequirementResult) -> list[Text]:
    head = Text.assemble(("✗ ", "red"), (result.id, "bold"), f"  {one_line(result.title)}")
    if not result.findings:
        return [cut(head), cut(Text(f"  {one_line(result.reason)}"))]
    finding = shortest_first(result.findings)[0].finding
    waived = result.findings[:1] if all(f.waived for f in result.findings) else ()
    return [
        cut(head),
        cut(Text.assemble(("  expected  ", "green"), one_line(finding.expected, 300))),
        cut(Text.assemble(("  observed  ", "red"), one_line(finding.observed, 300))),
        *(cut(Text.assemble(("  known     ", "yellow"), one_line(f.waived, 300))) for f in waived),
    ]


def cut(text: Text) -> Text:
    """``text`` on one line, cut where the terminal ends."""
    text.no_wrap, text.overflow = True, "ellipsis"
    return text
