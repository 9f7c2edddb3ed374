"""Mutants and variants that are rows of tables: what a tool chain does not report, leaves out, or refuses besides."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.contract.metamodel.reading import Kind, Problem
from ucm_cts.adapters.contract.metamodel.spelling import TAGS
from ucm_cts.adapters.contract.value import Value
from ucm_cts.adapters.mutants.toolchain.checking import deaf, mentions, refusing_text, without
from ucm_cts.adapters.mutants.toolchain.registry import breaks, complaining_where, named, variant
from ucm_cts.adapters.mutants.toolchain.rewriting import table
from ucm_cts.adapters.reference.toolchain.checking import Complaint, Rule
from ucm_cts.adapters.reference.toolchain.program import Program


class Unreported(Value, frozen=True):
    """Problems in reading, by their kind, the tag of the element, and the attribute, if it must be a certain one."""

    kinds: tuple[Kind, ...]
    elements: tuple[str, ...]
    attribute: str = ""

    def holds(self, problem: Problem) -> bool:
        """Whether ``problem`` is one of them."""
        about = not self.attribute or mentions(problem.message, self.attribute)
        return problem.kind in self.kinds and problem.element in self.elements and about


class Refused(Value, frozen=True):
    """Elements of the class with tag ``of`` for which all conditions hold; each condition names fields.

    equal: the field has this value
    contains: the text of the field contains this text
    matches: a part of the field's text matches this regular expression
    more_than: the field has more entries, or is a greater number
    given: the field is not empty
    empty: the field is empty
    refers_to: the field refers to an element of one of these tags
    """

    of: str
    equal: dict[str, Any] = {}
    contains: dict[str, str] = {}
    matches: dict[str, str] = {}
    more_than: dict[str, int] = {}
    given: tuple[str, ...] = ()
    empty: tuple[str, ...] = ()
    refers_to: dict[str, tuple[str, ...]] = {}

    def holds(self, element: Element, scope: Scope) -> bool:
        """Whether ``element``, which stands in ``scope``, is refused."""

        def kinds(tags: tuple[str, ...]) -> tuple[Any, ...]:
            return tuple(TAGS[tag] for tag in tags)

        return (
            all(getattr(element, field) == value for field, value in self.equal.items())
            and all(text in getattr(element, field) for field, text in self.contains.items())
            and all(re.search(pattern, getattr(element, field)) for field, pattern in self.matches.items())
            and all(_size(getattr(element, field)) > number for field, number in self.more_than.items())
            and all(getattr(element, field) for field in self.given)
            and not any(getattr(element, field) for field in self.empty)
            and all(scope.find(getattr(element, field), *kinds(tags)) for field, tags in self.refers_to.items())
        )

    def rule(self) -> Rule:
        """The rule that refuses them."""

        def complaints(element: Element, scope: Scope) -> Iterator[Complaint]:
            if self.holds(element, scope):
                yield element, "this is not how it is done"

        return Rule("overzealous", "", (TAGS[self.of],), complaints)


def _size(value: Any) -> int:
    """``value`` if it is a number, otherwise how many entries it has; 0 for None."""
    if value is None:
        return 0
    return value if isinstance(value, int) else len(value)


class Kept(Value, frozen=True):
    """The complaints of ``rule`` that still count, where all conditions hold.

    undeclared: the field of the wrong element refers to nothing that is declared
    message_without: the message does not contain this text
    shorter_than: the message contains each text less often than this
    among_first: the wrong element is one of the first entries of the field, so many of them
    """

    rule: str
    undeclared: str = ""
    message_without: str = "\0"
    shorter_than: dict[str, int] = {}
    among_first: dict[str, int] = {}

    def holds(self, wrong: Any, element: Any, scope: Scope, message: str) -> bool:
        """Whether a complaint counts; the arguments are those of ``registry.Holds``."""
        return (
            not (self.undeclared and scope.find(getattr(wrong, self.undeclared), Named))
            and self.message_without not in message
            and all(message.count(text) < times for text, times in self.shorter_than.items())
            and all(wrong in getattr(element, field)[:number] for field, number in self.among_first.items())
        )


class Deviation(Value, frozen=True):
    """A tool chain that differs from the reference one; it is a mutant if it breaks something, otherwise a variant.

    says: what it does, in one sentence
    breaks: the requirements that it breaks
    also: requirements that the same defect may break besides
    declares: the readings (``option=value``) that it claims
    unreported: problems in reading that it does not report
    without: rules that it leaves out
    kept: complaints of one rule that it still reports
    refused: legal elements that it refuses
    refused_text: a regular expression; it refuses models whose text contains a match
    """

    says: str
    breaks: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    declares: tuple[str, ...] = ()
    unreported: Unreported | None = None
    without: tuple[str, ...] = ()
    kept: Kept | None = None
    refused: Refused | None = None
    refused_text: str = ""

    def derive(self, program: Program) -> Program:
        """``program`` with this deviation."""
        unreported, refused, kept = self.unreported, self.refused, self.kept
        if unreported is not None:
            program = deaf(program, lambda problem, _: unreported.holds(problem))
        if kept is not None:
            program = complaining_where(program, kept.rule, kept.holds)
        if refused is not None:
            rule = refused.rule()
            program = replace(program, rules={**program.rules, rule.name: rule})
        if self.refused_text:
            program = refusing_text(program, self.refused_text.encode())
        return without(program, *self.without)


def register_table(path: str) -> None:
    """Register each row of the table in the file ``path`` beside this module as a mutant or a variant of its name."""
    for name, row in table(path, dict[str, Deviation]).items():
        derive = named(lambda program, row=row: row.derive(program), name, row.says)  # type: ignore[misc]
        if row.breaks:
            breaks(*row.breaks, also=row.also, declares=row.declares)(derive)
        else:
            variant(declares=row.declares)(derive)
