"""Judges profile pim: what a tool chain made of each question, and which requirements that keeps or breaks.

Refusing a broken model counts only if its legal twin was accepted, so nobody passes by refusing everything. A refused legal model is
held against the requirement that it was written for unless a simpler one is to blame (blame.py) or nothing with a construct
that no text prints was accepted (unprinted.py), a legal variant only if its twin was accepted, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import msgspec

from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS
from ucm_cts.harness.toolchains.campaign import Fact
from ucm_cts.harness.toolchains.commands.processing import Made
from ucm_cts.harness.toolchains.corpus.selection import Due, Question, differing_lines, questions
from ucm_cts.harness.toolchains.minimal_refusals import Blame
from ucm_cts.harness.toolchains.related_lines import vicinity
from ucm_cts.harness.toolchains.renaming import Dress
from ucm_cts.harness.toolchains.unspecified_spellings import refused_for_spelling
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
    elsewhere: bool = False


class Acceptance:
    """The examination of profile pim: all questions for what the vendor declares."""

    def __init__(self, statement: Statement, dress: Dress, expression: str = "") -> None:
        """All models are dressed. Of the questions only those whose name or requirement holds one of the words of ``expression``,
        and their twins.
        """
        asked = [q for q in questions() if all(map(statement.meets, q.under))]
        words = [word.strip().lower() for word in expression.split(" or ") if word.strip()]
        if words:
            wanted = [q for q in asked if any(w in f"{q.name} {q.requirement}".lower() for w in words)]
            twins = {q.twin for q in wanted}
            asked = [q for q in asked if q in wanted or q.name in twins]
        self._questions = dressed(asked, dress)
        self.not_asked = _not_asked(statement)
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
            told = judgement.observed
            return Fact(q.requirement, asked, unclear=told, elsewhere=judgement.elsewhere, measure=measure)
        if judgement.outcome == "kept":
            return Fact(q.requirement, asked, measure=measure)
        finding = Finding(q.requirement, judgement.rule, q.name, judgement.expected, judgement.observed)
        processed = msgspec.structs.replace(made.processed, twin=self._texts.get(q.twin, ""))
        return Fact(q.requirement, asked, finding, processed=processed, measure=measure)


def _not_asked(statement: Statement) -> Mapping[str, str]:
    """The requirements that only other readings than the declared ones ask about, and which readings hold instead."""
    all_questions = questions()
    asked = {q.requirement for q in all_questions if all(map(statement.meets, q.under))}
    options: dict[str, set[str]] = {}
    for q in all_questions:
        if q.requirement not in asked:
            unmet = {need.partition("=")[0] for need in q.under if not statement.meets(need)}
            options.setdefault(q.requirement, set()).update(unmet)
    said = f"{statement.source} says" if statement.source else "without a statement it holds that"
    told = {
        requirement: ", ".join(f"{option} = {statement.readings[option]}" for option in sorted(unmet))
        for requirement, unmet in options.items()
    }
    return {requirement: f"{said} {readings}" for requirement, readings in told.items()}


def dressed(asked: Sequence[Question], dress: Dress) -> list[Question]:
    """The questions ``asked`` as a tool chain gets them."""
    if dress == Dress():
        return list(asked)
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
    legal = {q.name: q.text for q in asked if q.due == "accept" and q.name in answers and _stands(q, answers)}
    blame = Blame(legal, {name for name in legal if answers[name].accepted is False})
    misspelt = refused_for_spelling(legal, {name: answers[name].accepted for name in legal})
    return [_judged(q, answers, blame, misspelt) for q in asked if q.name in answers]


def _stands(q: Question, answers: Mapping[str, Answer]) -> bool:
    """Whether ``q`` may be held against anybody: its twin, if it has one, was accepted."""
    twin = answers.get(q.twin)
    return not q.twin or (twin is not None and bool(twin.accepted))


def _judged(q: Question, answers: Mapping[str, Answer], blame: Blame, misspelt: Mapping[str, str]) -> Judgement:
    answer = answers[q.name]
    rule = RULE_FOR[q.due]
    if answer.died:
        return Judgement(
            q, rule, "broken", f"the model is {'accepted' if q.due == 'accept' else 'refused'}", answer.told
        )
    if answer.accepted is None:
        return Judgement(q, rule, "unclear", observed=f"no answer: {answer.told}")
    if not _stands(q, answers):
        return Judgement(q, rule, "unclear", "", f"its legal twin {q.twin} was not accepted", elsewhere=True)
    if q.due == "accept":
        return _of_legal(q, answer, rule, blame, misspelt)
    if answer.accepted:
        return Judgement(q, rule, "broken", f"the model is refused: {q.because}", "it was accepted")
    if answer.lines and q.changed and not answer.lines & vicinity(q.text, q.changed):
        where = ", ".join(map(str, sorted(answer.lines)))
        observed = f"refused, but for something in line {where}, which has nothing to do with it: {answer.told}"
        return Judgement(q, rule, "unclear", observed=observed)
    return Judgement(q, rule, "kept")


def _of_legal(q: Question, answer: Answer, rule: str, blame: Blame, misspelt: Mapping[str, str]) -> Judgement:
    if answer.accepted:
        return Judgement(q, rule, "kept")
    instead = blame.instead_of(q.name)
    if instead:
        return Judgement(q, rule, "unclear", "", f"the simpler model {instead} was refused, too", elsewhere=True)
    if q.name in misspelt:
        return Judgement(q, rule, "unclear", "", f"it was refused, and may be for our spelling: {misspelt[q.name]}")
    expected = f"the model is accepted{f': {q.because}' if q.because else ''}"
    return Judgement(q, rule, "broken", expected, f"it was refused: {answer.told or 'without a word'}")
