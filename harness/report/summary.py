"""The report in the terminal: the verdict, each failure in three lines, and the path of the page."""

from __future__ import annotations

from pathlib import Path

from rich.console import Group, RenderableType
from rich.text import Text

from ucm_cts.harness.report.diagrams.sequence import last_call
from ucm_cts.harness.report.order import (
    ISOLATIONS,
    SEALS,
    SYMBOLS,
    Fix,
    Shown,
    count,
    counted,
    not_followed,
    of_same_causes,
    shown,
    sides,
    to_fix,
)
from ucm_cts.harness.report.scope import scope_of
from ucm_cts.harness.report.wanting import wanting
from ucm_cts.harness.results.failures import shortest_first
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.incidents import is_unexplained
from ucm_cts.harness.results.known_failures import all_known
from ucm_cts.harness.results.values import (
    FrameworkReport,
    IncidentReport,
    Overall,
    Report,
    RequirementResult,
    incidents_of,
)

SHOWN = 12
"""The number of failed requirements, and of incidents, that are listed."""

EXPLAINED = 6
"""The number of other requirements that are named as explained by a failure."""

_COLOURS: dict[Shown, str] = {
    "fail": "red",
    "error": "magenta",
    "inconclusive": "yellow",
    "not followed": "yellow",
    "pass": "green",
    "not applicable": "dim",
}
_STYLES: dict[Overall, str] = {"conformant": "bold green", "not conformant": "bold red", "inconclusive": "bold yellow"}


def summary(report: Report, out: Path | None = None, whole: bool = False, everything: bool = False) -> RenderableType:
    """What to print at the end of a run; ``out`` is the folder the report was written to.

    A ``whole`` summary lists all failures and incidents, and cuts no line; ``everything`` is each cause of a failure and each
    undecided requirement as well.
    """
    name = one_line(f"{report.product} {report.version}", 80)
    known = " (all failures known)" if all_known(report) else ""
    only = f", only -k {one_line(report.selection, 80)}" if report.selection else ""
    lines = [
        Text.assemble(
            (f"{SEALS[report.verdict]} {report.verdict.upper()}{known}", _STYLES[report.verdict]),
            f"  {name}, profile {one_line(report.profile, 40)}{only}",
        ),
        Text(f"  {scope_of(report).text}", "dim"),
        _counts(report),
        Text(
            f"  {'hosts' if isinstance(report, FrameworkReport) else 'commands'} ran {ISOLATIONS[report.isolation]}",
            "dim",
        ),
        *(Text(f"  {side}", "dim") for side in sides(report)),
        *(Text(f"  warning: {one_line(warning, 600)}", "yellow") for warning in getattr(report, "warnings", ())),
    ]
    if report.incomplete:
        lines.append(Text(f"  incomplete: {one_line(report.incomplete)}", "bold yellow"))
    fixes = to_fix(report)
    incidents = [fix.report for fix in fixes if fix.report is not None]
    incidents.sort(key=lambda item: not is_unexplained(item.execution))
    incidents += [item for item in incidents_of(report) if item.incident.kind == "untried"]
    failed = [fix for fix in fixes if fix.result is not None]
    ignored = not_followed(report.requirements)
    most = max(len(incidents), len(failed), len(ignored)) if whole or everything else SHOWN
    if incidents:
        lines.append(Text())
    lines += [_incident(item) for item in incidents[:most]]
    if len(incidents) > most:
        lines.append(Text(f"and {len(incidents) - most} more incidents (--all lists them)", "dim"))
    for fix in failed[:most]:
        lines += [Text(), *_failure(fix, everything)]
    if len(failed) > most:
        lines += [Text(), Text(f"and {len(failed) - most} more failed requirements (--all lists them)", "dim")]
    if same_cause := len(of_same_causes(report)):
        lines += [Text(), Text(f"and {same_cause} more requirements that fail for causes shown above", "dim")]
    for result in ignored[:most]:
        lines += [Text(), *_described(result, everything)]
    if len(ignored) > most:
        lines += [Text(), Text(f"and {len(ignored) - most} more recommendations that were not followed", "dim")]
    lines += _wanting(report)
    if everything:
        lines += _undecided(report)
    if out is not None:
        lines += [Text(), Text.assemble("report  ", (str(out / "report.html"), "bold"), overflow="fold")]
    return Group(*lines) if not (whole or everything) else Group(*map(_uncut, lines))


def _incident(item: IncidentReport) -> Text:
    during = last_call(item.execution)
    when = f", during {during}" if during else ", between two calls"
    what = "fails no requirement: " if is_unexplained(item.execution) else ""
    often = f" {item.occurrences} times" if item.occurrences > 1 and item.incident.kind != "untried" else ""
    said = f": {item.incident.last_line}" if item.incident.last_line else ""
    detail = one_line(f"{what}{item.incident.detail}{when if during or what else ''}{said}", 300)
    return cut(Text.assemble(("⚡ ", "magenta"), (f"{item.incident.kind}{often}", "bold magenta"), f"  {detail}"))


def _wanting(report: Report) -> list[Text]:
    """The lines of the vendor's statement that would let a run decide more."""
    wanted = wanting(report)
    if wanted is None:
        return []
    number = f"{wanted.requirements} inconclusive requirement{'s' if wanted.requirements > 1 else ''}"
    head = Text.assemble((f"{SYMBOLS['inconclusive']} ", "yellow"), (f"{number} for want of a statement", "bold"))
    lines = [Text.assemble(("  ", ""), (str(line), "bold"), f"  {times}") for line, times in wanted.lines.items()]
    return [Text(), cut(head), *map(cut, lines), cut(Text(f"  {wanted.remedy}", "dim"))]


def _undecided(report: Report) -> list[Text]:
    """Requirements without a verdict, with the reason."""
    undecided = [result for result in report.requirements if result.verdict in ("error", "inconclusive")]
    rows = [
        Text.assemble(
            (f"{SYMBOLS[result.verdict]} ", _COLOURS[result.verdict]),
            (result.id, "bold"),
            f"  {one_line(result.title)}: {one_line(result.reason, 300)}",
        )
        for result in undecided
    ]
    return [Text(), *rows] if rows else []


def _counts(report: Report) -> Text:
    line = Text("  ")
    for verdict, number in count(report.requirements).items():
        if number:
            line.append(f"{SYMBOLS[verdict]} {number} {verdict}", _COLOURS[verdict]).append("   ")
    amounts = "".join(f"{number:,} {unit}, " for number, unit in counted(report))
    line.append(f"{amounts}{report.seconds:.1f} s", "dim")
    return line


def _failure(fix: Fix, everything: bool) -> list[Text]:
    """A failed requirement, and those that may have failed because of it."""
    assert fix.result is not None
    lines = _described(fix.result, everything)
    followers = [other.id for other in fix.followers]
    if followers:
        lines.append(cut(Text.assemble(("  with it   ", "dim"), f"{', '.join(followers)}, which may follow from it")))
    known = {fix.result.id, *followers}
    explained = list(dict.fromkeys(id_ for found in fix.result.findings for id_ in found.explains if id_ not in known))
    if explained:
        others = f" and {len(explained) - EXPLAINED} others" if len(explained) > EXPLAINED else ""
        lines.append(
            cut(Text(f"  explains {', '.join(explained[:EXPLAINED])}{others}: broken after it, in the same scenarios"))
        )
    return lines


def _described(result: RequirementResult, everything: bool) -> list[Text]:
    verdict = shown(result)
    remark = "" if result.decides else " (recommendation, not followed)"
    head = Text.assemble(
        (f"{SYMBOLS[verdict]} ", _COLOURS[verdict]), (result.id, "bold"), f"  {one_line(result.title)}{remark}"
    )
    if not result.findings:
        return [cut(head), cut(Text(f"  {one_line(result.reason)}"))]
    shortest = shortest_first(result.findings)
    waived = result.findings[:1] if all(f.waived for f in result.findings) else ()
    lines = [cut(head)]
    for failed in shortest if everything else shortest[:1]:
        finding = failed.finding
        lines.append(cut(Text.assemble(("  expected  ", "green"), one_line(finding.expected, 300))))
        lines.append(cut(Text.assemble(("  observed  ", "red"), one_line(finding.observed, 300))))
    return [*lines, *(cut(Text.assemble(("  known     ", "yellow"), one_line(f.waived, 300))) for f in waived)]


def cut(text: Text) -> Text:
    """``text`` on one line, cut where the terminal ends."""
    text.no_wrap, text.overflow = True, "ellipsis"
    return text


def _uncut(text: Text) -> Text:
    """``text`` on one line, however long."""
    text.no_wrap, text.overflow = True, "ignore"
    return text
