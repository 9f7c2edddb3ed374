"""Judges profile pim: what a tool chain made of each question, and which requirements that keeps or breaks.

Refusing a broken model counts only if its legal twin was accepted, so nobody passes by refusing everything. A refused legal model is
held against the requirement that it was written for only if no simpler legal model was refused; a legal variant only
if its twin was accepted.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import msgspec
from lxml import etree

from ucm_cts.harness.results import FRAMEWORK_INCIDENTS
from ucm_cts.harness.stating.statement import Statement
from ucm_cts.harness.toolchains.campaign import Fact
from ucm_cts.harness.toolchains.corpus import Due, Question, differing_lines, questions
from ucm_cts.harness.toolchains.dressing import Dress
from ucm_cts.harness.toolchains.processing import Made
from ucm_cts.reference_models.findings import Finding

RULES = {
    "legal_models_accepted": "A legal model that uses it is accepted, and so is each legal variant of an accepted model.",
    "broken_models_refused": "A model that breaks it, and is legal otherwise, is refused.",
}
"""The rules that the catalogue names, and what each says."""

RULE_FOR: Mapping[Due, str] = {"accept": "legal_models_accepted", "refuse": "broken_models_refused"}

Outcome = Literal["kept", "broken", "unclear"]


@dataclass(frozen=True)
class Answer:
    """What a tool chain made of a model: ``accepted`` is None if it came to no answer. ``lines`` are those that its diagnostics
    point to, none if it does not tell them; ``told`` is the first one. ``died`` says that the tool did not end in order.
    """

    accepted: bool | None
    lines: frozenset[int] = frozenset()
    told: str = ""
    died: bool = False


@dataclass(frozen=True)
class Judgement:
    """What one answer says of the requirement of its question. ``expected`` and ``observed`` are for people."""

    question: Question
    rule: str
    outcome: Outcome
    expected: str = ""
    observed: str = ""


class Acceptance:
    """The examination of profile pim: all questions for what the vendor declares."""

    def __init__(self, statement: Statement, dress: Dress, expression: str = "") -> None:
        """All models are dressed. Of the questions only those whose name or requirement holds one of the words of ``expression``, and their twins."""
        asked = [q for q in questions() if all(map(statement.meets, q.under))]
        words = [word.strip().lower() for word in expression.split(" or ") if word.strip()]
        if words:
            wanted = [q for q in asked if any(w in f"{q.name} {q.requirement}".lower() for w in words)]
            twins = {q.twin for q in wanted}
            asked = [q for q in asked if q in wanted or q.name in twins]
        self._questions = dressed(asked, dress)
        self._texts = {q.name: q.text for q in self._questions}

    @property
    def models(self) -> Sequence[tuple[str, str]]:
        """Name and text of each question."""
        return tuple(self._texts.items())

    def look(self, name: str, made: Made) -> tuple[Fact, ...]:
        """Nothing: only all answers together say something."""
        return ()

    def judge(self, made: Mapping[str, Made], looked: Mapping[str, tuple[Fact, ...]]) -> Iterator[Fact]:
        """What the answers say."""
        answers = {name: _answer(one) for name, one in made.items()}
        for judgement in judge(self._questions, answers):
            yield self._fact(judgement, made[judgement.question.name])

    def _fact(self, judgement: Judgement, made: Made) -> Fact:
        q = judgement.question
        asked = (q.twin, q.name) if q.twin else (q.name,)
        measure = f"models to {q.due}"
        if judgement.outcome == "unclear":
            return Fact(q.requirement, asked, unclear=judgement.observed, measure=measure)
        if judgement.outcome == "kept":
            return Fact(q.requirement, asked, measure=measure)
        finding = Finding(q.requirement, judgement.rule, q.name, judgement.expected, judgement.observed)
        processed = msgspec.structs.replace(made.processed, twin=self._texts.get(q.twin, ""))
        return Fact(q.requirement, asked, finding, processed=processed, measure=measure)


def dressed(asked: Sequence[Question], dress: Dress) -> list[Question]:
    """The questions ``asked`` as a tool chain gets them."""
    texts = {q.name: dress.of(q.text) for q in asked}
    return [
        replace(q, text=texts[q.name], changed=differing_lines(texts[q.twin], texts[q.name]) if q.twin else q.changed)
        for q in asked
    ]


def _answer(made: Made) -> Answer:
    incident = made.processed.incident
    if incident is None:
        first = next((line for line in made.processed.output.splitlines() if line.strip()), "")
        return Answer(made.accepted, made.lines, first.strip()[:300])
    told = f"{incident.kind}: {incident.detail}"
    return Answer(None, told=told, died=incident.kind in FRAMEWORK_INCIDENTS - {"exit"})


def judge(asked: Sequence[Question], answers: Mapping[str, Answer]) -> list[Judgement]:
    """A judgement for each question that was answered."""
    by_name = {q.name: q for q in asked}
    refused = {
        name: constructs(by_name[name].text)
        for name, answer in answers.items()
        if answer.accepted is False and by_name[name].due == "accept" and not by_name[name].twin
    }
    return [_judged(q, answers, refused) for q in asked if q.name in answers]


def _judged(q: Question, answers: Mapping[str, Answer], refused: Mapping[str, frozenset[str]]) -> Judgement:
    answer = answers[q.name]
    rule = RULE_FOR[q.due]
    if answer.died:
        return Judgement(
            q, rule, "broken", f"the model is {'accepted' if q.due == 'accept' else 'refused'}", answer.told
        )
    if answer.accepted is None:
        return Judgement(q, rule, "unclear", observed=f"no answer: {answer.told}")
    twin = answers.get(q.twin) if q.twin else None
    if q.twin and (twin is None or not twin.accepted):
        return Judgement(q, rule, "unclear", observed=f"its legal twin {q.twin} was not accepted")
    if q.due == "accept":
        return _of_legal(q, answer, rule, refused)
    if answer.accepted:
        return Judgement(q, rule, "broken", f"the model is refused: {q.because}", "it was accepted")
    if answer.lines and q.changed and not answer.lines & _about(q):
        where = ", ".join(map(str, sorted(answer.lines)))
        observed = f"refused, but for something in line {where}, which has nothing to do with it: {answer.told}"
        return Judgement(q, rule, "unclear", observed=observed)
    return Judgement(q, rule, "kept")


def _of_legal(q: Question, answer: Answer, rule: str, refused: Mapping[str, frozenset[str]]) -> Judgement:
    if answer.accepted:
        return Judgement(q, rule, "kept")
    if not q.twin:
        simpler = next((name for name, used in refused.items() if used < refused[q.name]), None)
        if simpler is not None:
            return Judgement(q, rule, "unclear", observed=f"the simpler model {simpler} was refused, too")
    expected = f"the model is accepted{f': {q.because}' if q.because else ''}"
    return Judgement(q, rule, "broken", expected, f"it was refused: {answer.told or 'without a word'}")


@functools.lru_cache(8192)
def _about(q: Question) -> frozenset[int]:
    """The lines of what was changed, of what that is part of or consists of, and of all that shares a name with it."""
    try:
        root = etree.fromstring(q.text.encode())
    except etree.XMLSyntaxError:
        return frozenset(range(1, q.text.count("\n") + 2))
    elements = [e for e in root.iter(etree.Element) if isinstance(e.tag, str)]
    touched = [inner for e in elements if _line(e) in q.changed for inner in e.iter(etree.Element)]
    named = {word for element in touched for word in _words(element)}
    related = [*touched, *(e for e in elements if named.intersection(_words(e)))]
    lines = {_line(e) for one in related for e in (one, *one.iterancestors())} | set(q.changed)
    return frozenset(line for end in lines for line in _start_tag(q.text.splitlines(), end))


def _line(element: etree._Element) -> int:
    return int(str(element.sourceline or 0))


def _start_tag(lines: Sequence[str], end: int) -> Iterator[int]:
    """The lines of the start tag that ends in line ``end``; parsers differ in which of them they tell."""
    line = end
    yield line
    while 1 < line <= len(lines) and "<" not in lines[line - 1]:
        line -= 1
        yield line


def _words(element: etree._Element) -> set[str]:
    """The last parts of all names in the element's attributes."""
    return {text.replace(".", "::").rpartition("::")[2] for text in map(str, element.attrib.values())} - {""}


_LITERALS = frozenset(
    ("kind", "direction", "mode", "nature", "multiplicity", "applicability", "charBase", "indexType", "defaultCase")
)


@functools.lru_cache(8192)
def constructs(text: str) -> frozenset[str]:
    """The kinds of things that a model uses: elements inside others, attributes, and the words that attributes choose from."""
    found: set[str] = set()
    for element in etree.fromstring(text.encode()).iter(etree.Element):
        parent = element.getparent()
        found.add(f"{str(parent.tag) if parent is not None else ''}/{element.tag!s}")
        for attribute, value in ((str(a), str(v)) for a, v in element.attrib.items()):
            found.add(f"{element.tag!s}@{attribute}={value if attribute in _LITERALS else ''}")
    return frozenset(found)
