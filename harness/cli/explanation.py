"""The output of ``ucm-cts explain``: one requirement, or the requirements of a clause, of an operation, or all."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Group, RenderableType
from rich.text import Text

from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES, PARTS, PROFILES
from ucm_cts.harness.catalogue.requirements import (
    Need,
    Requirement,
    decides,
    load_capabilities,
    load_interpretations,
    load_requirements,
)
from ucm_cts.harness.cli.explained import CELLS, Topic, cells_of, found
from ucm_cts.harness.execution.leftovers import HOST_CHECKS
from ucm_cts.harness.models.core_models import CHECKS
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.toolchains.corpus.selection import questions
from ucm_cts.harness.toolchains.examinations import TOOLCHAIN_CHECKS
from ucm_cts.reference_models.properties.table import PROPERTIES


def explanation(identifier: str) -> RenderableType:
    """Everything about the requirement, clause or operation ``identifier``. Raises ``WrongUse`` if there is none."""
    topic = found(identifier)
    return _explained(topic) if isinstance(topic, Requirement) else _listed(topic)


def _explained(requirement: Requirement) -> RenderableType:
    interpretations = {i.id: i for i in load_interpretations()}
    lines: list[RenderableType] = [
        Text(f"{requirement.id}  {requirement.title}", style="bold"),
        Text(f"clause {requirement.clause}, {requirement.force}, {_profiles(requirement.profile)}"),
        Text(),
        Text(requirement.meaning),
    ]
    for label, text in (
        ("Derived", requirement.derived),
        (
            "Recommendation",
            "" if decides(requirement.level) else "not following it does not make a product non-conformant",
        ),
        ("Not tested", requirement.untestable),
        ("Not checked yet", requirement.pending),
        ("Observed", requirement.observed),
    ):
        lines += _paragraph(f"{label}: ", text) if text else []
    for name in requirement.interpretations:
        entry = interpretations[name]
        options = [f"{option}: {', '.join(readings)}" for option, readings in entry.options.items()]
        lines += _paragraph(f"Interpretation {name}: ", entry.reason, *entry.lines[1:], *options)
    for need in load_capabilities().of(requirement.id):
        lines += _paragraph("Applies where the vendor states: ", _needed(need))
    checks = CHECKS | TOOLCHAIN_CHECKS | HOST_CHECKS
    for rule in requirement.rules:
        doc = checks[rule] if rule in checks else (PROPERTIES[rule].evaluate.__doc__ or "").strip().splitlines()[0]
        lines += _paragraph(f"Checked by {rule}: ", doc)
    offered = load_purposes(requirement.profile) if requirement.profile in FRAMEWORK_PROFILES else ()
    purposes = [p for p in offered if requirement.id in p.requirements and not p.id.startswith(CELLS)]
    if purposes:
        scenarios = [f"{p.id}: {p.text} ({_count(len(p.scenarios))})" for p in purposes]
        lines += _paragraph("Scenarios that exercise it:", "", *scenarios)
    cells = cells_of(requirement.id) if offered else []
    if cells:
        lines += _paragraph("Cells of provocation: ", "what a body does where it is entered, and what follows", *cells)
    cases = [q for q in questions() if q.requirement == requirement.id] if requirement.profile == "pim" else []
    if cases:
        models = [f"{q.due} {q.name}{f': {q.because}' if q.because else ''}" for q in cases]
        lines += _paragraph("Models that ask about it:", "", *models)
    return Group(*lines)


def _profiles(family: str) -> str:
    """The first profile that asks for requirements of ``family``; all of them if it is what several have in common."""
    if family in PROFILES:
        return f"profile {family}"
    return f"profiles {', '.join(profile for profile in PROFILES if family in PARTS[profile])}"


def _paragraph(label: str, text: str, *lines: str) -> list[Text]:
    """A blank line, ``text`` behind its bold label, and ``lines`` below it."""
    return [Text(), Text(label, style="bold") + Text(text), *(Text(f"  {line}") for line in lines)]


def _listed(topic: Topic) -> RenderableType:
    lines: list[RenderableType] = [Text(topic.heading, style="bold"), *_rows(topic.requirements)]
    if topic.purposes:
        lines += _paragraph("Scenarios that concern it:", "", *topic.purposes)
    return Group(*lines)


def overview() -> RenderableType:
    """The whole catalogue, a line a requirement."""
    return Group(*_rows(load_requirements()))


def _rows(requirements: Iterable[Requirement]) -> list[Text]:
    """A line for each: id, clause, level and title, below a line that says so."""
    rows = [("requirement", "clause", "level", "title")]
    for r in requirements:
        remark = " (not testable)" if r.untestable else " (not checked yet)" if r.pending else ""
        rows.append((r.id, r.clause, r.force, r.title + remark))
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    lines = [Text("  ".join((*map(str.ljust, row, widths), row[-1]))) for row in rows]
    lines[0].stylize("bold")
    return lines


def _needed(need: Need) -> str:
    all_of, one_of = ", ".join(need.needs), " or ".join(need.one_of)
    return (", ".join(filter(None, (all_of, one_of)))).replace("=", " = ")


def _count(number: int) -> str:
    return f"{number} scenario{'s' if number != 1 else ''}"
