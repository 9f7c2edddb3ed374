"""Is a model well-formed? Walks it once and applies the rules that were registered for each kind of element."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, NamedTuple

from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.names import Names, Scope
from ucm_cts.adapters.contract.metamodel.spelling import fields_towards
from ucm_cts.adapters.reference.toolchain.diagnostics import Diagnostic

Complaint = tuple[Element, str]
"""The element that is wrong, and what is wrong with it and how to mend it."""

FindComplaints = Callable[[Any, Scope], Iterable[Complaint]]

JudgedBy = Callable[[Any], Hashable]
"""What of an element decides, with its kind and its scope, whether a rule has complaints about it. It raises nothing."""

TYPE: JudgedBy = attrgetter("type")
"""The reference to a type."""


def has_name(named: Named) -> bool:
    """Whether it has a name, whatever it is."""
    return bool(named.name)



@dataclass(frozen=True)
class Rule:
    """A well-formedness rule.

    ``name``: its name, unique among the rules.
    ``requirement``: the requirement that it stands for.
    ``kinds``: the elements that it applies to; ``Model`` for the whole.
    ``complaints``: finds what is wrong with one element, given the scope of its references.
    ``under``: the reading (``option=value``) that asks for it where the text is open; empty elsewhere.
    ``also``: requirements that say the same in part; a tool chain without the rule may break them, too.
    ``judged_by``: what the rule looks at, if that is little: once one element is fine, no other of its kind and scope that is
    alike in this is judged again.
    """

    name: str
    requirement: str
    kinds: tuple[type[Element], ...]
    complaints: FindComplaints
    under: str = ""
    also: tuple[str, ...] = ()
    judged_by: JudgedBy | None = None


RULES: dict[str, Rule] = {}
"""All rules, in the order in which they were registered."""


def rule(
    requirement: str,
    *kinds: type[Element],
    under: str = "",
    also: tuple[str, ...] = (),
    judged_by: JudgedBy | None = None,
) -> Callable[[FindComplaints], FindComplaints]:
    """Register a function as the rule for ``requirement`` for elements of ``kinds`` (``Model`` for the whole), which
    only the reading ``under`` asks for; requirements of ``also`` say the same in part. ``Rule`` says what the rest means.

    Several functions may stand for one requirement; their names differ.
    """

    def register(complaints: FindComplaints) -> FindComplaints:
        name = complaints.__name__
        assert name not in RULES, f"two rules are called {name}"
        RULES[name] = Rule(name, requirement, kinds, complaints, under, also, judged_by)
        return complaints

    return register


Plans = dict[type[Element], "_Plan"]
"""What is done with each kind of element, found out once for one set of rules."""


def check(model: Model, file: str, rules: Mapping[str, Rule], plans: Plans) -> list[Diagnostic]:
    """What ``rules`` have against ``model``, in the order of its lines. ``plans`` are those of the same rules, empty at first."""
    names = Names(model)
    found = [d for r in rules.values() if Model in r.kinds for d in _found_by(r, model, names.root, file)]
    fine_in: dict[Scope, dict[type[Element], _PlanHere]] = {}

    def visit(elements: Iterable[Element], scope: Scope) -> None:
        here = fine_in.setdefault(scope, {})
        for element in elements:
            kind = type(element)
            plan = here.get(kind)
            if plan is None:
                plan = here[kind] = _plan_here(kind, rules, plans)
            for judged_by, fine in plan.judged:
                if judged_by(element) not in fine:
                    _judge(element, scope, plan, found, file)
                    break
            else:
                for one, complaints in plan.always:
                    for wrong, message in complaints(element, scope):
                        found.append(_diagnostic(one, wrong, message, file))
            for field in plan.fields:
                held = getattr(element, field)
                if held:
                    visit(held, names.inside(element) if plan.is_module else scope)

    visit(model.modules, names.root)
    return sorted(found, key=lambda diagnostic: diagnostic.line)


def _judge(element: Element, scope: Scope, plan: _PlanHere, found: list[Diagnostic], file: str) -> None:
    """Apply all rules to ``element``, in their order, and note what is fine."""
    wrong_in: set[JudgedBy | None] = set()
    for one in plan.rules:
        before = len(found)
        for wrong, message in one.complaints(element, scope):
            found.append(_diagnostic(one, wrong, message, file))
        if len(found) > before:
            wrong_in.add(one.judged_by)
    for judged_by, fine in plan.judged:
        if judged_by not in wrong_in:
            fine.add(judged_by(element))


class _Plan(NamedTuple):
    """What is done with elements of one kind: their rules, those that are always applied, and the fields that lead to further elements."""

    rules: tuple[Rule, ...]
    always: tuple[tuple[Rule, FindComplaints], ...]
    judged: tuple[JudgedBy, ...]
    fields: tuple[str, ...]
    is_module: bool


class _PlanHere(NamedTuple):
    """The same for one scope; ``judged`` has what is known to be fine there."""

    rules: tuple[Rule, ...]
    always: tuple[tuple[Rule, FindComplaints], ...]
    judged: tuple[tuple[JudgedBy, set[Hashable]], ...]
    fields: tuple[str, ...]
    is_module: bool


def _plan_here(kind: type[Element], rules: Mapping[str, Rule], plans: Plans) -> _PlanHere:
    plan = plans.get(kind)
    if plan is None:
        plan = plans[kind] = _plan(kind, rules)
    fine: tuple[tuple[JudgedBy, set[Hashable]], ...] = tuple((judged_by, set()) for judged_by in plan.judged)
    return _PlanHere(plan.rules, plan.always, fine, plan.fields, plan.is_module)


def _plan(kind: type[Element], rules: Mapping[str, Rule]) -> _Plan:
    applied = tuple(one for one in rules.values() if issubclass(kind, one.kinds))
    always = tuple((one, one.complaints) for one in applied if one.judged_by is None)
    judged = tuple(dict.fromkeys(one.judged_by for one in applied if one.judged_by is not None))
    ruled = tuple(dict.fromkeys(kind for one in rules.values() for kind in one.kinds))
    return _Plan(applied, always, judged, fields_towards(kind, ruled), issubclass(kind, MODULES))


def _found_by(one: Rule, model: Model, root: Scope, file: str) -> Iterator[Diagnostic]:
    for wrong, message in one.complaints(model, root):
        yield _diagnostic(one, wrong, message, file)


def _diagnostic(one: Rule, wrong: Element, message: str, file: str) -> Diagnostic:
    return Diagnostic(file, wrong.line, message, one.requirement)
