"""The output of ``ucm-cts explain``: one requirement, or the whole catalogue."""

from __future__ import annotations

import difflib

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES
from ucm_cts.harness.catalogue.requirements import (
    Need,
    Requirement,
    decides,
    load_capabilities,
    load_interpretations,
    load_requirements,
)
from ucm_cts.harness.execution.leftovers import HOST_CHECKS
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.models.core_models import CHECKS
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.toolchains.corpus.selection import questions
from ucm_cts.harness.toolchains.examinations import TOOLCHAIN_CHECKS
from ucm_cts.reference_models.properties.table import PROPERTIES


def explanation(identifier: str) -> RenderableType:
    """Everything about the requirement ``identifier``. Raises ``WrongUse`` if there is none."""
    requirement = _find(identifier)
    interpretations = {i.id: i for i in load_interpretations()}
    lines: list[RenderableType] = [
        Text(f"{requirement.id}  {requirement.title}", style="bold"),
        Text(f"clause {requirement.clause}, {requirement.force}, profile {requirement.profile}"),
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
    purposes = [p for p in offered if requirement.id in p.requirements]
    if purposes:
        scenarios = [f"{p.id}: {p.text} ({_count(len(p.scenarios))})" for p in purposes]
        lines += _paragraph("Scenarios that exercise it:", "", *scenarios)
    cases = [q for q in questions() if q.requirement == requirement.id] if requirement.profile == "pim" else []
    if cases:
        models = [f"{q.due} {q.name}{f': {q.because}' if q.because else ''}" for q in cases]
        lines += _paragraph("Models that ask about it:", "", *models)
    return Group(*lines)


def _paragraph(label: str, text: str, *lines: str) -> list[Text]:
    """A blank line, ``text`` behind its bold label, and ``lines`` below it."""
    return [Text(), Text(label, style="bold") + Text(text), *(Text(f"  {line}") for line in lines)]


def overview() -> RenderableType:
    """The whole catalogue, a line a requirement."""
    table = Table(box=None, pad_edge=False)
    for column in ("requirement", "clause", "level", "title"):
        table.add_column(column)
    for r in load_requirements():
        remark = " (not testable)" if r.untestable else " (not checked yet)" if r.pending else ""
        table.add_row(r.id, r.clause, r.force, r.title + remark)
    return table


def _needed(need: Need) -> str:
    all_of, one_of = ", ".join(need.needs), " or ".join(need.one_of)
    return (", ".join(filter(None, (all_of, one_of)))).replace("=", " = ")


def _find(identifier: str) -> Requirement:
    by_id = {r.id.lower(): r for r in load_requirements()}
    found = by_id.get(identifier.lower()) or by_id.get(f"r-{identifier.lower()}")
    if found is None:
        near = difflib.get_close_matches(identifier.lower(), by_id, n=3, cutoff=0.4)
        hint = f"; near it: {', '.join(by_id[n].id for n in near)}" if near else ""
        raise WrongUse(f"no requirement '{identifier}'{hint}; 'ucm-cts explain' lists all")
    return found


def _count(number: int) -> str:
    return f"{number} scenario{'s' if number != 1 else ''}"
