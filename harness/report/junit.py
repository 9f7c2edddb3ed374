"""``junit.xml``: one test case for each requirement, so that every CI shows the verdicts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lxml import etree

from ucm_cts.harness.catalogue.requirements import Requirement
from ucm_cts.harness.report.diagrams.excerpt import excerpt
from ucm_cts.harness.report.diagrams.sequence import last_call
from ucm_cts.harness.report.diagrams.sequence_text import failure_text, to_text
from ucm_cts.harness.report.scope import scope_of
from ucm_cts.harness.report.toolchain_body import command_text, fact_text
from ucm_cts.harness.results import values as v
from ucm_cts.harness.results.failures import file_name, incident_file, replay_command, shortest_first
from ucm_cts.harness.results.foreign import clean, one_line

FINDINGS = 3
"""The number of causes of one requirement that are written in full."""


def to_junit(report: v.Report, catalogue: Sequence[Requirement]) -> bytes:
    """The report as JUnit XML, grouped by clause. The report must be clean (``foreign.clean_report``).

    ``inconclusive`` is a failure of type ``inconclusive``: a skip looks green in a CI, and it must not. A failure that is known
    is skipped, as the exit status of the run does not count it.
    """
    only = f", -k {report.selection}" if report.selection else ""
    name = one_line(f"{report.product} {report.version}, profile {report.profile}{only}: {report.verdict}")
    root = etree.Element("testsuites", name=name)
    suites: dict[str, etree._Element] = {}
    scope = scope_of(report, catalogue).text
    levels = {requirement.id: requirement.level for requirement in catalogue}
    if report.incomplete:
        case = _case(root, suites, "run", "the run is complete", report.seconds)
        _child(case, "error", report.incomplete, "incomplete", "The report holds what was measured until then.")
    for result in report.requirements:
        case = _case(root, suites, f"clause {result.clause}", f"{result.id} {result.title}", result.seconds)
        properties = {"requirement": result.id, "clause": result.clause, "verdict": result.verdict}
        if result.id in levels:
            properties["level"] = levels[result.id]
        _properties(case, properties, result)
        _verdict(case, result, report)
    reported = {result.id for result in report.requirements}
    for requirement in catalogue:
        if requirement.untestable and requirement.id not in reported:
            case = _case(root, suites, f"clause {requirement.clause}", f"{requirement.id} {requirement.title}")
            _properties(case, {"requirement": requirement.id, "clause": requirement.clause, "level": requirement.level})
            _child(case, "skipped", f"not testable: {requirement.untestable}")
    for number, incident in enumerate(v.incidents_of(report)):
        title = one_line(f"{incident.incident.kind} in {incident.execution.name}")
        case = _case(root, suites, "incidents", title)
        _properties(case, {"scenarios": str(incident.occurrences), "requirements": " ".join(incident.requirements)})
        _incident(case, incident, number, report)
    for suite in suites.values():
        _count(suite)
        suite.set("time", f"{sum(float(case.get('time', '0')) for case in suite.findall('testcase')):.3f}")
        suite.set("timestamp", clean(report.started, 40))
        about = etree.Element("properties")
        etree.SubElement(about, "property", name="scope", value=one_line(scope, 300))
        suite.insert(0, about)
    _count(root)
    root.set("time", f"{report.seconds:.3f}")
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def _case(
    root: etree._Element, suites: dict[str, etree._Element], suite: str, title: str, seconds: float = 0
) -> etree._Element:
    if suite not in suites:
        suites[suite] = etree.SubElement(root, "testsuite", name=one_line(suite))
    classname = "ucm." + one_line(suite).replace(" ", "_").replace(".", "_")
    return etree.SubElement(suites[suite], "testcase", classname=classname, name=one_line(title), time=f"{seconds:.3f}")


def _properties(case: etree._Element, properties: Mapping[str, str], result: v.RequirementResult | None = None) -> None:
    """What programs ask of a test case; each known failure is one of them."""
    parent = etree.SubElement(case, "properties")
    known = dict.fromkeys(failed.waived for failed in result.findings if failed.waived) if result is not None else ()
    for name, value in (*properties.items(), *(("known-failure", reason) for reason in known)):
        etree.SubElement(parent, "property", name=name, value=one_line(value, 300))


def _verdict(case: etree._Element, result: v.RequirementResult, report: v.Report) -> None:
    match result.verdict:
        case "pass":
            waived = [failed for failed in result.findings if failed.waived]
            text = "".join(f"waived ({failed.waived}): {failed.finding.observed}\n" for failed in waived)
            etree.SubElement(case, "system-out").text = clean(f"exercised {result.exercised} times\n{text}", 4_000)
        case "fail" if result.findings and all(failed.waived for failed in result.findings):
            reasons = "; ".join(dict.fromkeys(failed.waived for failed in result.findings))
            _child(case, "skipped", f"known failure: {reasons}")
            etree.SubElement(case, "system-out").text = clean(_story(result, report), 40_000)
        case "fail":
            shortest = shortest_first(result.findings)
            message = shortest[0].finding.observed if shortest else result.reason
            if not result.decides:
                _child(case, "skipped", f"recommendation not followed: {message}", "", _story(result, report))
                return
            _child(case, "failure", message, "fail", _story(result, report))
        case "inconclusive" if not result.decides:
            _child(case, "skipped", f"recommendation, inconclusive: {result.reason or 'never exercised'}")
        case "inconclusive":
            reason = result.reason or "never exercised"
            story = _story(result, report) if result.findings else f"clause {result.clause}"
            _child(case, "failure", f"inconclusive: {reason}", "inconclusive", f"{story}\n{reason}")
        case "not applicable":
            _child(case, "skipped", f"not applicable: {result.reason}".rstrip(": "))
        case "error":
            _child(case, "error", result.reason or "lost to the adapter", "error", result.reason)


def _story(result: v.RequirementResult, report: v.Report) -> str:
    shortest = shortest_first(result.findings)
    parts = [f"{result.id} {result.title} (clause {result.clause})"]
    for number, failed in enumerate(shortest[:FINDINGS]):
        finding = failed.finding
        parts.append(
            f"expected: {finding.expected}\nobserved: {finding.observed}\n"
            f"seen {failed.occurrences} times; found by {finding.rule}"
            + (f"; scenario {failed.execution.name}\n" if failed.execution is not None else "\n")
            + (f"waived: {failed.waived}\n" if failed.waived else "")
        )
        match failed.evidence:
            case v.TraceEvidence(execution=execution, steady=steady):
                parts[-1] += f"replay:   {replay_command(file_name(result.id, number), report)}\n\n"
                parts[-1] += failure_text(finding, execution)
                if steady is not None:
                    parts.append(f"not shown when it was run again:\n\n{to_text(excerpt(steady))}")
            case v.FactEvidence(processed=processed):
                command = command_text(processed, file_name(result.id, number, "xml"))
                parts[-1] += f"again, in the folder of this report:    {command}\n\n{fact_text(failed.evidence)}"
    if len(shortest) > FINDINGS:
        parts.append(f"{len(shortest) - FINDINGS} more causes: see report.html")
    return "\n\n".join(parts)


def _incident(case: etree._Element, report_of: v.IncidentReport, number: int, report: v.Report) -> None:
    incident, execution = report_of.incident, report_of.execution
    story = [
        incident.detail,
        f"met in {report_of.occurrences} scenarios" if report_of.occurrences > 1 else "met in one scenario",
        f"last call: {last_call(execution) or 'none'}",
        f"reproduced: {'yes' if incident.reproduced else 'no'}",
        f"replay:    {replay_command(incident_file(number), report)}",
        "",
        to_text(excerpt(execution)),
        *(["", "stacks", incident.stacks] if incident.stacks else []),
    ]
    _child(case, "error", f"{incident.kind}: {incident.detail}", incident.kind, "\n".join(story))


def _child(case: etree._Element, tag: str, message: str, kind: str = "", text: str = "") -> None:
    child = etree.SubElement(case, tag, message=one_line(message, 300))
    if kind:
        child.set("type", kind)
    if text:
        child.text = clean(text, 40_000)


def _count(suite: etree._Element) -> None:
    suite.set("tests", str(len(suite.findall(".//testcase"))))
    suite.set("failures", str(len(suite.findall(".//failure"))))
    suite.set("errors", str(len(suite.findall(".//error"))))
    suite.set("skipped", str(len(suite.findall(".//skipped"))))
