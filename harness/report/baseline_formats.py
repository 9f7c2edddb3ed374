"""The changes from a baseline as lines for people, as annotations of GitHub, and as JUnit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lxml import etree

from ucm_cts.harness.report.baseline import MEANINGS, Baseline, Change, Difference
from ucm_cts.harness.report.comparison import Column
from ucm_cts.harness.report.order import SEALS
from ucm_cts.harness.results.foreign import clean, one_line

LISTED: tuple[Change, ...] = ("regressed", "unstable", "new", "gone", "fixed", "known")
"""Changes whose requirements are listed; the others are counted."""


def lines(baseline: Baseline) -> Iterator[str]:
    """What people read: the two reports in their order, then each change with its requirements."""
    old, new = baseline.old.report, baseline.new.report
    yield f"{one_line(new.product, 60)}, profile {one_line(new.profile, 40)}"
    yield f"  baseline  {_run(baseline.old)}"
    yield f"  now       {_run(baseline.new)}"
    if baseline.is_backwards:
        yield "  warning: the baseline is the later run: is the order right? It is --baseline OLD NEW"
    if old.suite_version != new.suite_version:
        versions = f"{one_line(old.suite_version, 40)} and {one_line(new.suite_version, 40)}"
        yield f"  warning: the reports are of UCM-CTS {versions}, which may ask other things by the same names"
    for report, which in ((old, "the baseline"), (new, "this report")):
        if report.selection:
            yield f"  warning: {which} has only what -k {one_line(report.selection, 80)} selected"
    for change in MEANINGS:
        found = baseline.of(change)
        if found and change in LISTED:
            yield f"  {len(found)} {change}: {MEANINGS[change]}"
            yield from (f"    {_line(difference)}" for difference in found)
        elif found:
            yield f"  {len(found)} {change}: {MEANINGS[change]}"
    if baseline.is_worse:
        yield f"  the verdict was '{old.verdict}' and is '{new.verdict}'"
    yield f"  {'REGRESSED' if baseline.has_regressed else 'no regression'}"


def github_annotations(baseline: Baseline) -> Iterator[str]:
    """Workflow commands of GitHub: an error for each regression, a warning for each verdict that flips."""
    for difference in baseline.differences:
        if difference.counts or difference.change == "unstable":
            kind = "error" if difference.counts else "warning"
            yield _annotation(kind, f"{difference.id} {difference.change}", _line(difference))
    if baseline.is_worse:
        new, old = baseline.new.report, baseline.old.report
        yield _annotation("error", f"{new.product} {new.version}", f"was '{old.verdict}' and is '{new.verdict}'")


def to_junit(baselines: Sequence[Baseline]) -> bytes:
    """JUnit XML: a test case for each requirement. A regression is a failure; what failed before, or is gone, is skipped."""
    root = etree.Element("testsuites", name="changes from the baseline")
    for baseline in baselines:
        new = baseline.new.report
        suite = etree.SubElement(
            root, "testsuite", name=one_line(f"{new.product} {new.version}, profile {new.profile}")
        )
        whole = _case(suite, "verdict of the whole", 0)
        if baseline.is_worse:
            message = f"was '{baseline.old.report.verdict}' and is '{new.verdict}'"
            etree.SubElement(whole, "failure", message=message, type="regressed")
        for difference in baseline.differences:
            case = _case(suite, f"{difference.id} {difference.title}", difference.seconds)
            if difference.counts:
                failure = etree.SubElement(case, "failure", message=_story(difference), type="regressed")
                failure.text = clean(difference.detail, 4_000)
            elif difference.change not in ("same", "fixed"):
                etree.SubElement(case, "skipped", message=_story(difference))
        for name, tag in (("tests", "testcase"), ("failures", "failure"), ("skipped", "skipped")):
            suite.set(name, str(sum(1 for _ in suite.iter(tag))))
        suite.set("errors", "0")
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def _run(column: Column) -> str:
    report = column.report
    version = f"{one_line(report.version, 40) or 'no version'}, {SEALS[report.verdict]} {report.verdict}"
    return f"{version}, run {one_line(report.started, 40)}: {column.path}"


def _line(difference: Difference) -> str:
    path = f"{difference.before or 'not asked'} -> {difference.after or 'not in the report'}"
    remark = "" if difference.decides else " (recommendation)"
    detail = f": {one_line(difference.detail, 160)}" if difference.detail else ""
    return f"{difference.id}  {path}{remark}  {one_line(difference.title, 80)}{detail}"


def _story(difference: Difference) -> str:
    return one_line(f"{difference.change}: {_line(difference)}", 300)


def _case(suite: etree._Element, name: str, seconds: float) -> etree._Element:
    return etree.SubElement(suite, "testcase", classname="ucm.baseline", name=one_line(name), time=f"{seconds:.3f}")


def _annotation(kind: str, title: str, text: str) -> str:
    """One command, whatever the texts hold: a line break or a separator in them would begin another."""
    escaped = one_line(text, 400).replace("%", "%25")
    head = one_line(title, 100).replace("%", "%25").replace(":", "%3A").replace(",", "%2C")
    return f"::{kind} title={head}::{escaped}"
