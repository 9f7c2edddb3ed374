"""All questions of profile pim: models that a tool chain must accept, and models that it must refuse, each beside a legal twin."""

from __future__ import annotations

import difflib
import functools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Literal

from lxml import etree

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read, read_text
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.toolchains.corpus.cases import Case, Variant, changed, load_cases
from ucm_cts.harness.toolchains.corpus.misplacement import UNDER, Legal, misplaced
from ucm_cts.harness.toolchains.operators.operator import OPERATORS, Applications, Operator

LEGAL = SUITE / "models" / "legal"

Due = Literal["accept", "refuse"]


@dataclass(frozen=True)
class Question:
    """A model, and what must become of it.

    ``twin`` is the legal model it was made of, empty for one that stands for itself; ``changed`` are the lines of ``text`` in
    which it differs from its twin, and those beside a place where something was taken out.
    """

    name: str
    requirement: str
    due: Due
    text: str
    because: str = ""
    twin: str = ""
    changed: frozenset[int] = frozenset()
    under: tuple[str, ...] = ()

    @property
    def family(self) -> str:
        """What it has in common with the models that the same operator, or the same case, makes."""
        made_by = self.name.partition("/")[0]
        operator = OPERATORS.get(made_by)
        return operator.family if operator is not None else made_by


class WholeModel(Value, frozen=True):
    """A legal model of ``suite/models/legal``: refusing it breaks ``accepts``, unless a simpler one is refused, too."""

    file: str
    accepts: str
    under: tuple[str, ...] = ()


@functools.cache
def questions() -> tuple[Question, ...]:
    """All of them, legal models before what is made of them. Raises ``DocumentError``."""
    legal = (*_whole_models(), *_of_cases())
    return (*legal, *_of_operators(legal), *_misplaced(legal))


@functools.cache
def load_operators() -> Mapping[str, Operator]:
    """All operators of the modules in ``operators/``."""
    for path in sorted(Path(__file__).parents[1].joinpath("operators").glob("*.py")):
        import_module(f"ucm_cts.harness.toolchains.operators.{path.stem}")
    return OPERATORS


def _whole_models() -> Iterator[Question]:
    for whole in read(LEGAL / "models.yaml", list[WholeModel]):
        path = LEGAL / whole.file
        text = etree.tostring(etree.fromstring(read_text(path).encode()), encoding="unicode")
        yield Question(path.stem, whole.accepts, "accept", text, under=whole.under)


def _misplaced(legal: Sequence[Question]) -> Iterator[Question]:
    """Elements where the meta-model has no room for them."""
    of_all = [q for q in legal if all("=" in need for need in q.under)]  # not those of a part that is to be claimed
    models = [Legal(q.name, q.text, q.under) for q in of_all if q.due == "accept" and not q.twin]
    for one in misplaced(models):
        changed = differing_lines(one.twin.text, one.text)
        under = (*one.twin.under, *UNDER)
        yield Question(one.name, one.requirement, "refuse", one.text, one.because, one.twin.name, changed, under)


def _of_operators(legal: Sequence[Question]) -> Iterator[Question]:
    """The questions that the operators make of legal models which are not variants themselves."""
    roots = [(q, etree.fromstring(q.text)) for q in legal if q.due == "accept" and not q.twin]
    for operator in load_operators().values():
        yield from _of_operator(operator, roots)


def _of_operator(operator: Operator, roots: Sequence[tuple[Question, etree._Element]]) -> Iterator[Question]:
    applications = Applications(operator)
    for twin, root in roots:
        for number, (place, spoilt) in enumerate(applications.within(root)):
            text = etree.tostring(spoilt, encoding="unicode")
            yield Question(
                f"{operator.name}/{twin.name}-{number + 1}",
                operator.requirement,
                "refuse" if operator.breaks else "accept",
                text,
                f"{place}: {operator.because}",
                twin.name,
                differing_lines(twin.text, text),
                (*twin.under, *operator.under),
            )


def _of_cases() -> Iterator[Question]:
    for case in load_cases():
        yield Question(case.name, case.accepts or case.requirement, "accept", case.legal, under=case.under)
        for number, variant in enumerate(case.broken):
            yield _of_variant(case, variant, f"broken-{number + 1}", "refuse")
        for number, variant in enumerate(case.also_legal):
            yield _of_variant(case, variant, f"legal-{number + 1}", "accept")


def _of_variant(case: Case, variant: Variant, suffix: str, due: Due) -> Question:
    text = changed(case, variant)
    return Question(
        f"{case.name}/{suffix}",
        variant.requirement or case.requirement,
        due,
        text,
        variant.because,
        case.name,
        differing_lines(case.legal, text),
        (*case.under, *variant.under),
    )


def differing_lines(before: str, after: str) -> frozenset[int]:
    """The lines of ``after``, from 1, that are not as in ``before``, and the two beside each place where lines are missing."""
    old, new = before.splitlines(), after.splitlines()
    lines: set[int] = set()
    for tag, _, _, first, last in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if tag == "delete":
            lines |= {first, first + 1}
        elif tag != "equal":
            lines |= set(range(first + 1, last + 1))
    return frozenset(line for line in lines if 0 < line <= len(new))
