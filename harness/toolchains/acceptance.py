"""Judges profile pim: which requirements the responses of a tool chain to all questions keep or break.

A refused broken model counts only if its legal twin was accepted, so a tool chain that refuses everything passes nothing. A refused
legal model breaks the requirement that it was written for, unless a simpler model was refused for the same construct
(minimal_refusals.py) or no model was accepted with a construct whose spelling is unspecified (unspecified_spellings.py). A legal
variant counts only if its twin was accepted.
"""

from __future__ import annotations

import functools
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, REQUIREMENTS_WITH, SIDES, FactEvidence
from ucm_cts.harness.toolchains.campaign import Fact
from ucm_cts.harness.toolchains.commands.processing import Response
from ucm_cts.harness.toolchains.corpus.misplacement import is_broken_in
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
        self._questions = renamed([q for q in chosen if is_broken_in(renaming.dialect, q.name)], renaming)
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
        judged = judge(self._questions, answers)
        causes = causes_of(judged)
        for judgement in judged:
            yield self._fact(judgement, responses[judgement.question.name], causes)
        yield from _on_either_side(judged)

    def _fact(self, judgement: Judgement, response: Response, causes: Mapping[str, Cause]) -> Fact:
        q = judgement.question
        models = (q.twin, q.name) if q.twin else (q.name,)
        if judgement.outcome == "undecided":
            others = judgement.leaves_others
            measure = "models that decide nothing"
            return Fact(q.requirement, models, undecided=judgement.observed, leaves_others=others, measure=measure)
        measure = f"models to {q.due}"
        if judgement.outcome == "kept":
            return Fact(q.requirement, models, measure=measure)
        cause = causes[q.name]
        observed = f"{judgement.observed}{f'; see {cause.shown_by}' if cause.shown_by != q.name else ''}"
        finding = Finding(q.requirement, judgement.rule, cause.name, judgement.expected, observed)
        whole = cause.shown_by in (q.name, "") or cause.requirement == q.requirement
        evidence = FactEvidence(response.processed, self._texts.get(q.twin, "")) if whole else None
        return Fact(q.requirement, models, finding, evidence=evidence, measure=measure)


def _not_applicable(statement: Statement) -> Mapping[str, str]:
    """The requirements of which nothing is asked, or no broken model, under the readings that the vendor declares, and why."""
    source = f"{statement.source} says" if statement.source else "without a statement it holds that"
    found: dict[str, str] = {}
    for requirement, (what, unmet) in unasked(statement).items():
        declared = ", ".join(f"{name} = {statement.value_of(name)}" for name in sorted(unmet))
        found[requirement] = f"{what}: {source} {declared}"
    return found


def unasked(statement: Statement) -> Mapping[str, tuple[str, frozenset[str]]]:
    """The requirements of which nothing is asked, or no broken model: which of both, and the options, or parts, that are to be declared.

    Where legal models are asked all the same, a refusal of one still fails the requirement. A declared reading that accepts what
    another one refuses is asked in full by its legal models. Options of a part that is not claimed say nothing.
    """
    asked: dict[tuple[str, Due], list[Question]] = {}
    breakable = {q.requirement for q in questions() if q.due == "refuse"}
    options: dict[str, set[str]] = {}
    for q in questions():
        if all(map(statement.meets, q.under)):
            asked.setdefault((q.requirement, q.due), []).append(q)
        elif q.due == "refuse" or q.requirement not in breakable:
            unmet = {need.partition("=")[0] for need in q.under if not statement.meets(need)}
            options.setdefault(q.requirement, set()).update(unmet & statement.capabilities.keys() or unmet)
    found: dict[str, tuple[str, frozenset[str]]] = {}
    for requirement, unmet in options.items():
        accepted = asked.get((requirement, "accept"), [])
        never_broken = accepted and requirement not in breakable
        if (requirement, "refuse") in asked or never_broken or _decided_by(accepted, unmet):
            continue
        what = "accepted side only, no broken model is ever asked" if accepted else "it is never asked"
        found[requirement] = what, frozenset(unmet)
    return found


def _decided_by(accepted: Sequence[Question], options: Collection[str]) -> bool:
    """Whether some of the legal models ``accepted`` are legal by a reading of ``options``."""
    return any(need.partition("=")[0] in options for q in accepted for need in q.under)


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


@dataclass(frozen=True)
class Cause:
    """What several findings have in common: its name, and the model and requirement that show it first."""

    name: str
    shown_by: str
    requirement: str


NOTHING_REFUSED = "no broken model is refused"
"""The one cause of all findings on a checker that accepts everything."""

_MANY = 20
"""Broken models of which at least one must have been refused by a checker that checks anything."""


def causes_of(judged: Sequence[Judgement]) -> Mapping[str, Cause]:
    """The cause of each broken judgement, by its question.

    One missing check is one cause: the models that one operator or one case makes, whichever requirement they are for.
    """
    decided = [j.outcome for j in judged if j.question.due == "refuse" and j.outcome != "undecided"]
    checks_nothing = len(decided) >= _MANY and "kept" not in decided
    first: dict[str, Cause] = {}
    found: dict[str, Cause] = {}
    for judgement in judged:
        q = judgement.question
        if judgement.outcome == "broken":
            name = NOTHING_REFUSED if checks_nothing and q.due == "refuse" else q.family
            found[q.name] = first.setdefault(name, Cause(name, q.name, q.requirement))
    return found


def _on_either_side(judged: Sequence[Judgement]) -> Iterator[Fact]:
    """Remarks that count, for both sides of a checker, models and requirements."""
    for due, (asked, done) in zip(get_args(Due), SIDES.values(), strict=True):
        outcomes: dict[str, list[Outcome]] = {}
        for judgement in judged:
            if judgement.question.due == due and judgement.outcome != "undecided":
                outcomes.setdefault(judgement.question.requirement, []).append(judgement.outcome)
        for requirement, those in outcomes.items():
            yield from (Fact("", (requirement,), measure=asked) for _ in those)
            yield from (Fact("", (requirement,), measure=done) for outcome in those if outcome == "kept")
            yield Fact("", (requirement,), measure=f"{REQUIREMENTS_WITH}{asked}")
            if "broken" not in those:
                yield Fact("", (requirement,), measure=f"{REQUIREMENTS_WITH}{done}")


def judge(chosen: Sequence[Question], answers: Mapping[str, Answer]) -> list[Judgement]:
    """A judgement for each question that was answered."""
    twins = {q.name: q.text for q in chosen}
    legal = {q.name: q.text for q in chosen if q.due == "accept" and q.name in answers and _may_count(q, answers)}
    minimal = MinimalRefusals(legal, {name for name in legal if answers[name].accepted is False})
    unspecified = refused_for_spelling(legal, {name: answers[name].accepted for name in legal})
    return [_judged(q, answers, minimal, unspecified, twins) for q in chosen if q.name in answers]


def _may_count(q: Question, answers: Mapping[str, Answer]) -> bool:
    """Whether the answer to ``q`` decides anything: its twin, if it has one, was accepted."""
    twin = answers.get(q.twin)
    return not q.twin or (twin is not None and bool(twin.accepted))


def lines_of_consequences(q: Question, twins: Mapping[str, str]) -> frozenset[int]:
    """The lines of ``q`` on which a diagnostic of its edit may stand."""
    twin = twins.get(q.twin, "")
    return related_lines(q.text, q.changed, twin, _taken_away(q.text, twin) if twin else frozenset())


@functools.lru_cache(16384)
def _taken_away(text: str, twin: str) -> frozenset[int]:
    """The lines of ``twin`` that ``text`` does not have; computed once, as many tool chains are asked the same."""
    return differing_lines(text, twin)


def _judged(
    q: Question,
    answers: Mapping[str, Answer],
    minimal: MinimalRefusals,
    unspecified: Mapping[str, str],
    twins: Mapping[str, str],
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
        if q.due == "refuse" and answer.lines and q.changed and not answer.lines & lines_of_consequences(q, twins):
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
