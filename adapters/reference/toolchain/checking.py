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

FindComplaints = Callable[[Any, Scope], Iterable[Complaint]]


@dataclass(frozen=True)
class Rule:
    """A well-formedness rule.

    ``name``: its name, unique among the rules.
    ``requirement``: the requirement that it stands for.
    ``kinds``: the elements that it applies to; ``Model`` for the whole.
    ``complaints``: finds what is wrong with one element, given the scope of its references.
    ``under``: the reading (``option=value``) that asks for it where the text is open; empty elsewhere.
    ``also``: requirements that say the same in part; a tool chain without the rule may break them, too.
    """

    name: str
    requirement: str
    kinds: tuple[type[Element], ...]
    complaints: FindComplaints
    under: str = ""
    also: tuple[str, ...] = ()


RULES: dict[str, Rule] = {}
"""All rules, in the order in which they were registered."""


def rule(
    requirement: str, *kinds: type[Element], under: str = "", also: tuple[str, ...] = ()
) -> Callable[[FindComplaints], FindComplaints]:
    """Register a function as the rule for ``requirement`` for elements of ``kinds`` (``Model`` for the whole), which
    only the reading ``under`` asks for; requirements of ``also`` say the same in part.

    Several functions may stand for one requirement; their names differ.
    """

    def register(complaints: FindComplaints) -> FindComplaints:
        name = complaints.__name__
        assert name not in RULES, f"two rules are called {name}"
        RULES[name] = Rule(name, requirement, kinds, complaints, under, also)
        return complaints

    return register


Plans = dict[type[Element], "_Plan"]
"""What is done with each kind of element, found out once for one set of rules."""


def check(model: Model, file: str, rules: Mapping[str, Rule], plans: Plans) -> list[Diagnostic]:
    """What ``rules`` have against ``model``, in the order of its lines. ``plans`` are those of the same rules, empty at first."""
    names = Names(model)
    found = [d for r in rules.values() if Model in r.kinds for d in _found_by(r, model, names.root, file)]

    def visit(elements: Iterable[Element], scope: Scope) -> None:
        for element in elements:
            kind = type(element)
            plan = plans.get(kind)
            if plan is None:
                plan = plans[kind] = _plan(kind, rules)
            for one, complaints in plan.rules:
                for wrong, message in complaints(element, scope):
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

    rules: tuple[tuple[Rule, FindComplaints], ...]
    fields: tuple[str, ...]
    is_module: bool


def _plan(kind: type[Element], rules: Mapping[str, Rule]) -> _Plan:
    applied = tuple((one, one.complaints) for one in rules.values() if issubclass(kind, one.kinds))
    return _Plan(applied, child_fields(kind), issubclass(kind, MODULES))


def _found_by(one: Rule, model: Model, root: Scope, file: str) -> Iterator[Diagnostic]:
    for wrong, message in one.complaints(model, root):
        yield _diagnostic(one, wrong, message, file)


def _diagnostic(one: Rule, wrong: Element, message: str, file: str) -> Diagnostic:
    return Diagnostic(file, wrong.line, message, one.requirement)
