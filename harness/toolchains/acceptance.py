"""Judges profile pim: which requirements the responses of a tool chain to all questions keep or break.

A refused broken model counts only if its legal twin was accepted, so a tool chain that refuses everything passes nothing. A refused
legal model breaks the requirement that it was written for, unless a simpler model was refused for the same construct
(minimal_refusals.py) or no model was accepted with a construct whose spelling is unspecified (unspecified_spellings.py). A legal
variant counts only if its twin was accepted.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, FactEvidence
from ucm_cts.harness.toolchains.campaign import Fact
from ucm_cts.harness.toolchains.commands.processing import Response
from ucm_cts.harness.toolchains.corpus.selection import Due, Question, differing_lines, questions
from ucm_cts.harness.toolchains.minimal_refusals import MinimalRefusals
from ucm_cts.harness.toolchains.related_lines import related_lines
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.harness.toolchains.unspecified_spellings import refused_for_spelling
from ucm_cts.reference_models.findings import Finding

RULES = {
    "legal_models_accepted": "A legal model that uses it is accepted, and so is each legal variant of an accepted model.",
    "broken_models_refused": "A model that breaks it, and is legal otherwise, is refused.",
}
"""The rules that the catalogue names, and what each says."""

RULE_FOR: Mapping[Due, str] = {"accept": "legal_models_accepted", "refuse": "broken_models_refused"}

Outcome = Literal["kept", "broken", "undecided"]


@dataclass(frozen=True)
class Answer:
    """What a tool chain answers to a model."""

    accepted: bool | None
    """None if it came to no answer."""
    lines: frozenset[int] = frozenset()
    """The lines that its diagnostics name, none if they name none."""
    first_line: str = ""
    """The first line of its output, or the incident."""
    incident: bool = False
    """Whether the tool crashed, hung or took too much memory."""


@dataclass(frozen=True)
class Judgement:
    """What one answer says of the requirement of its question. ``expected`` and ``observed`` are for people."""

    question: Question
    rule: str
    outcome: Outcome
    expected: str = ""
    observed: str = ""
    leaves_others: bool = False
    """Whether an undecided outcome leaves other judgements of the requirement as they are."""


class Acceptance:
    """The examination of profile pim: all questions for what the vendor declares."""

    def __init__(self, statement: Statement, renaming: Renaming, expression: str = "") -> None:
        """``expression`` selects questions by words of their names or requirements, and the twins of those."""
        chosen = [q for q in questions() if all(map(statement.meets, q.under))]
        words = [word.strip().lower() for word in expression.split(" or ") if word.strip()]
        if words:
            wanted = [q for q in chosen if any(w in f"{q.name} {q.requirement}".lower() for w in words)]
            twins = {q.twin for q in wanted}
            chosen = [q for q in chosen if q in wanted or q.name in twins]
        self._questions = renamed(chosen, renaming)
        self.not_applicable = _not_applicable(statement)
        self._texts = {q.name: q.text for q in self._questions}

    @property
    def models(self) -> Sequence[tuple[str, str]]:
        """Name and text of each question."""
        return tuple(self._texts.items())

    def examine(self, name: str, response: Response) -> tuple[Fact, ...]:
        """No facts: only all answers together decide."""
        return ()

    def judge(self, responses: Mapping[str, Response], shown: Mapping[str, tuple[Fact, ...]]) -> Iterator[Fact]:
        """A fact for each answer."""
        answers = {name: _answer(response) for name, response in responses.items()}
        for judgement in judge(self._questions, answers):
            yield self._fact(judgement, responses[judgement.question.name])

    def _fact(self, judgement: Judgement, response: Response) -> Fact:
        q = judgement.question
        models = (q.twin, q.name) if q.twin else (q.name,)
        measure = f"models to {q.due}"
        if judgement.outcome == "undecided":
            others = judgement.leaves_others
            return Fact(q.requirement, models, undecided=judgement.observed, leaves_others=others, measure=measure)
        if judgement.outcome == "kept":
            return Fact(q.requirement, models, measure=measure)
        finding = Finding(q.requirement, judgement.rule, q.name, judgement.expected, judgement.observed)
        evidence = FactEvidence(response.processed, self._texts.get(q.twin, ""))
        return Fact(q.requirement, models, finding, evidence=evidence, measure=measure)


def _not_applicable(statement: Statement) -> Mapping[str, str]:
    """The requirements that are tested only under readings that the vendor does not declare, and the declared ones."""
    source = f"{statement.source} says" if statement.source else "without a statement it holds that"
    return {
        requirement: f"{source} {', '.join(f'{option} = {statement.readings[option]}' for option in sorted(unmet))}"
        for requirement, unmet in untested(statement).items()
    }


def untested(statement: Statement) -> Mapping[str, frozenset[str]]:
    """The requirements that are tested only under readings that the vendor does not declare, and the options concerned."""
    all_questions = questions()
    tested = {q.requirement for q in all_questions if all(map(statement.meets, q.under))}
    options: dict[str, set[str]] = {}
    for q in all_questions:
        if q.requirement not in tested:
            unmet = {need.partition("=")[0] for need in q.under if not statement.meets(need)}
            options.setdefault(q.requirement, set()).update(unmet)
    return {requirement: frozenset(unmet) for requirement, unmet in options.items()}


def renamed(chosen: Sequence[Question], renaming: Renaming) -> list[Question]:
    """The questions ``chosen`` as a tool chain gets them."""
    if renaming == Renaming():
        return list(chosen)
    texts = {q.name: renaming.apply(q.text) for q in chosen}
    return [
        replace(q, text=texts[q.name], changed=differing_lines(texts[q.twin], texts[q.name]) if q.twin else q.changed)
        for q in chosen
    ]


def _answer(response: Response) -> Answer:
    incident = response.processed.incident
    if incident is None:
        return Answer(response.accepted, response.lines, response.first_line)
    own = incident.kind in FRAMEWORK_INCIDENTS - {"exit"}
    return Answer(None, first_line=f"{incident.kind}: {incident.detail}", incident=own)


def judge(chosen: Sequence[Question], answers: Mapping[str, Answer]) -> list[Judgement]:
    """A judgement for each question that was answered."""
    legal = {q.name: q.text for q in chosen if q.due == "accept" and q.name in answers and _may_count(q, answers)}
    minimal = MinimalRefusals(legal, {name for name in legal if answers[name].accepted is False})
    unspecified = refused_for_spelling(legal, {name: answers[name].accepted for name in legal})
    return [_judged(q, answers, minimal, unspecified) for q in chosen if q.name in answers]


def _may_count(q: Question, answers: Mapping[str, Answer]) -> bool:
    """Whether the answer to ``q`` decides anything: its twin, if it has one, was accepted."""
    twin = answers.get(q.twin)
    return not q.twin or (twin is not None and bool(twin.accepted))


def _judged(
    q: Question, answers: Mapping[str, Answer], minimal: MinimalRefusals, unspecified: Mapping[str, str]
) -> Judgement:
    answer = answers[q.name]
    rule = RULE_FOR[q.due]

    def undecided(observed: str, leaves_others: bool = False) -> Judgement:
        return Judgement(q, rule, "undecided", "", observed, leaves_others)

    if answer.incident:
        expected = f"the model is {'accepted' if q.due == 'accept' else 'refused'}"
        return Judgement(q, rule, "broken", expected, answer.first_line)
    if answer.accepted is None:
        return undecided(f"no answer: {answer.first_line}")
    if not _may_count(q, answers):
        return undecided(f"its legal twin {q.twin} was not accepted", True)
    if answer.accepted == (q.due == "accept"):
        if q.due == "refuse" and answer.lines and q.changed and not answer.lines & related_lines(q.text, q.changed):
            where = ", ".join(map(str, sorted(answer.lines)))
            return undecided(f"refused, but for line {where}, which is not related to the defect: {answer.first_line}")
        return Judgement(q, rule, "kept")
    if q.due == "refuse":
        return Judgement(q, rule, "broken", f"the model is refused: {q.because}", "it was accepted")
    simpler = minimal.simpler_than(q.name)
    if simpler:
        return undecided(f"the simpler model {simpler} was refused, too", True)
    if q.name in unspecified:
        return undecided(f"it was refused, perhaps for the suite's spelling: {unspecified[q.name]}")
    expected = f"the model is accepted{f': {q.because}' if q.because else ''}"
    return Judgement(q, rule, "broken", expected, f"it was refused: {answer.first_line or 'no diagnostic'}")
