"""Is a model well-formed? Walks it once and applies the rules that were registered for each kind of element."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from ucm_cts.adapters.contract.metamodel.common import Element, child_fields
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.names import Names, Scope
from ucm_cts.adapters.reference.toolchain.diagnostics import Diagnostic

Complaint = tuple[Element, str]
"""The element that is wrong, and what is wrong with it and how to mend it."""

Look = Callable[[Any, Scope], Iterable[Complaint]]


@dataclass(frozen=True)
class Rule:
    """``look`` is asked about each element of ``kinds``, with the scope in which its references are looked up.

    ``under`` is the reading (``option=value``) that asks for the rule where the text leaves it open, and empty elsewhere; ``also``
    are requirements that say the same in part, so that a tool chain without the rule may break them, too.
    """

    name: str
    requirement: str
    kinds: tuple[type[Element], ...]
    look: Look
    under: str = ""
    also: tuple[str, ...] = ()


RULES: dict[str, Rule] = {}
"""All rules, in the order in which they were registered."""


def rule(
    requirement: str, *kinds: type[Element], under: str = "", also: tuple[str, ...] = ()
) -> Callable[[Look], Look]:
    """Register a function as the rule for ``requirement`` that looks at elements of ``kinds`` (``Model`` for the whole), which
    only the reading ``under`` asks for; requirements of ``also`` say the same in part.

    Several functions may stand for one requirement; their names differ.
    """

    def register(look: Look) -> Look:
        name = look.__name__
        assert name not in RULES, f"two rules are called {name}"
        RULES[name] = Rule(name, requirement, kinds, look, under, also)
        return look

    return register


Plans = dict[type[Element], "_Plan"]
"""What is done with each kind of element, found out once for one set of rules."""


def check(model: Model, file: str, rules: Mapping[str, Rule], plans: Plans) -> list[Diagnostic]:
    """What ``rules`` have against ``model``, in the order of its lines. ``plans`` are those of the same rules, empty at first."""
    names = Names(model)
    found = [d for r in rules.values() if Model in r.kinds for d in _told(r, model, names.root, file)]

    def visit(elements: Iterable[Element], scope: Scope) -> None:
        for element in elements:
            kind = type(element)
            plan = plans.get(kind)
            if plan is None:
                plan = plans[kind] = _plan(kind, rules)
            for one, look in plan.looks:
                for wrong, message in look(element, scope):
                    found.append(_diagnostic(one, wrong, message, file))
            inner = names.inside(element) if plan.is_module else scope
            for field in plan.fields:
                held = getattr(element, field)
                if held:
                    visit(held, inner)

    visit(model.modules, names.root)
    return sorted(found, key=lambda diagnostic: diagnostic.line)


class _Plan(NamedTuple):
    """What is done with elements of one kind: their rules, and the fields that hold the next elements."""

    looks: tuple[tuple[Rule, Look], ...]
    fields: tuple[str, ...]
    is_module: bool


def _plan(kind: type[Element], rules: Mapping[str, Rule]) -> _Plan:
    looks = tuple((one, one.look) for one in rules.values() if issubclass(kind, one.kinds))
    return _Plan(looks, child_fields(kind), issubclass(kind, MODULES))


def _told(one: Rule, model: Model, root: Scope, file: str) -> Iterator[Diagnostic]:
    for wrong, message in one.look(model, root):
        yield _diagnostic(one, wrong, message, file)


def _diagnostic(one: Rule, wrong: Element, message: str, file: str) -> Diagnostic:
    return Diagnostic(file, wrong.line, message, one.requirement)
