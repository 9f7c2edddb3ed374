"""Cases and operators against the reference tool chain: two independent readings of clause 9, which must agree."""

from __future__ import annotations

import pytest
from lxml import etree

from ucm_cts.adapters.contract.metamodel.common import SimpleComment
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS, contained
from ucm_cts.adapters.contract.metamodel.writing import Dialect
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.catalogue.requirements import SUITE, load_requirements
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.toolchains.acceptance import Answer, Judgement, judge, lines_of_consequences
from ucm_cts.harness.toolchains.corpus.misplacement import is_broken_in, pairs
from ucm_cts.harness.toolchains.corpus.selection import Question, load_operators, questions
from ucm_cts.harness.toolchains.unspecified_spellings import CONSTRUCTS

PROGRAM = reference()
REQUIREMENTS = {r.id: r for r in load_requirements()}
ALSO = {
    one.requirement: {r for rule in PROGRAM.rules.values() if rule.requirement == one.requirement for r in rule.also}
    for one in PROGRAM.rules.values()
}
"""What rules of a requirement say of others in part."""
DEFAULT: dict[str, list[Question]] = {}
for _question in questions():
    if all(map(default_statement().meets, _question.under)):
        DEFAULT.setdefault(_question.requirement, []).append(_question)


@pytest.mark.parametrize("asked", DEFAULT.values(), ids=DEFAULT.keys())
def test_the_reference_tool_chain_answers_as_it_must(asked: list[Question]) -> None:
    problems = {q.name: problem for q in asked if (problem := _problem(q))}
    assert not problems, "\n".join(f"{name}: {problem}" for name, problem in problems.items())


def _problem(question: Question) -> str:
    """What is wrong with the answer to ``question``, or with why it is given; nothing if it is fine."""
    _, reported = PROGRAM.check(question.text.encode(), "model.xml")
    all_told = "\n".join(map(str, reported))
    if question.due == "accept":
        return all_told
    if not reported:
        return f"accepted, though {question.because}"
    reasons = {reason for d in reported if d.requirement for reason in (d.requirement, *ALSO[d.requirement])}
    return "" if not reasons or question.requirement in reasons else f"refused for something else:\n{all_told}"


def test_questions_have_names_of_their_own_and_known_requirements() -> None:
    names = [q.name for q in questions()]
    assert len(set(names)) == len(names)
    for q in questions():
        assert REQUIREMENTS[q.requirement].profile == "pim", q.name


def test_every_requirement_has_the_models_that_its_rules_promise() -> None:
    """Under one reading or another; where all readings are open nothing is asked until one is declared."""
    asked = {(q.requirement, q.due) for q in questions()}
    for requirement in REQUIREMENTS.values():
        if requirement.profile == "pim":
            for rule, due in (("legal_models_accepted", "accept"), ("broken_models_refused", "refuse")):
                assert ((requirement.id, due) in asked) == (rule in requirement.rules), f"{requirement.id}: {rule}"


def test_every_operator_finds_a_place() -> None:
    used = {q.name.partition("/")[0] for q in questions()}
    assert not load_operators().keys() - used


def test_the_suite_s_own_models_are_legal() -> None:
    """What running frameworks are certified with: the probes, and the core definitions in the spelling of clause 10."""
    core = etree.Element("Model")
    for path in sorted((SUITE / "models" / "core").glob("*.xml")):
        core.append(etree.parse(path).getroot())
    probes = (SUITE / "models" / "probes" / "probes.xml").read_bytes()
    for text in (probes, etree.tostring(core)):
        model, reported = PROGRAM.check(text, "model.xml")
        assert model is not None
        assert not reported, "\n".join(map(str, reported))


ASKED = [q for asked in DEFAULT.values() for q in asked]


def test_all_that_is_not_printed_is_in_some_legal_model() -> None:
    legal = "\n\n".join(q.text for q in ASKED if q.due == "accept")
    elements = {name: pattern for name, pattern in CONSTRUCTS.items() if not name.startswith("root")}
    assert not [name for name, pattern in elements.items() if not pattern.search(legal)]


@pytest.mark.parametrize("construct", CONSTRUCTS)
def test_an_unspecified_spelling_that_is_always_refused_decides_nothing(construct: str) -> None:
    judged = _judged_without({q.name for q in ASKED if CONSTRUCTS[construct].search(q.text)})
    assert not [j.question.name for j in judged if j.outcome == "broken"]
    assert any(j.outcome == "undecided" and not j.leaves_others for j in judged)


@pytest.mark.parametrize("construct", CONSTRUCTS)
def test_an_unspecified_spelling_that_is_accepted_elsewhere_counts(construct: str) -> None:
    having = [q for q in ASKED if q.due == "accept" and not q.twin and CONSTRUCTS[construct].search(q.text)]
    assert any(j.outcome == "broken" for j in _judged_without({min(having, key=lambda q: len(q.text)).name}))


def _judged_without(refused: set[str]) -> list[Judgement]:
    """What becomes of a tool chain that answers as it must, but refuses the models of these names."""
    return judge(ASKED, {q.name: Answer(q.due == "accept" and q.name not in refused) for q in ASKED})


def test_a_checker_may_print_any_one_of_its_findings() -> None:
    """Each diagnostic of a wrong model is related to what is wrong with it, also where it is a consequence."""
    twins = {q.name: q.text for q in ASKED}
    unrelated = [
        f"{q.name}: {diagnostic}"
        for q in ASKED
        if q.due == "refuse" and q.changed
        for diagnostic in PROGRAM.check(q.text.encode(), "model.xml")[1]
        if diagnostic.line not in lines_of_consequences(q, twins)
    ]
    assert not unrelated, "\n".join(unrelated)


def test_every_class_is_misplaced_and_holds_something_misplaced() -> None:
    asked = {(inner, outer) for inner, outer in pairs()}
    for cls in SPELLINGS:
        if cls not in (Model, SimpleComment):
            assert sum(1 for inner, _ in asked if inner is cls) >= 10, cls
        assert sum(1 for _, outer in asked if outer is cls) >= 10, cls
    assert not any(inner in contained(outer) for inner, outer in asked)


def test_a_dialect_with_one_tag_for_two_classes_is_not_asked_to_tell_them_apart() -> None:
    one_tag = Dialect(tags={"StructureField": "Field", "ExceptionField": "Field"})
    assert not is_broken_in(one_tag, "misplaced/StructureField-in-Exception")
    assert is_broken_in(one_tag, "misplaced/StructureField-in-Enumeration")
    assert is_broken_in(one_tag, "structures/broken-1")
