"""Is a model well-formed? Walks it once and applies the rules that were registered for each kind of element."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
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
    places: dict[Scope, _Place] = {}

    def visit(elements: Sequence[Element], scope: Scope) -> None:
        place = places.get(scope)
        if place is None:
            place = places[scope] = _Place(rules, plans)
        if len(elements) > _FEW:
            first = type(elements[0])
            plan = place.plans.get(first) or place.plan(first)
            if not plan.always and plan.all_fine(elements):
                return
        for element in elements:
            kind = type(element)
            plan = place.plans.get(kind) or place.plan(kind)
            for decides, known in plan.fine:
                if decides(element) not in known:
                    found.extend(plan.judged(element, scope, file))
                    break
            else:
                for one, complaints in plan.always:
                    for wrong, message in complaints(element, scope):
                        found.append(_diagnostic(one, wrong, message, file))
            inner = names.inside(element) if plan.is_module else scope
            for field in plan.fields:
                held = getattr(element, field)
                if held:
                    visit(held, inner)
            if plan.is_module:
                places.pop(inner, None)  # nobody asks again, unless a module beside it has the same name

    if model.modules:
        visit(model.modules, names.root)
    return sorted(found, key=lambda diagnostic: diagnostic.line)


_FEW = 2
"""So few elements are judged one by one."""

Applied = tuple[tuple[Rule, FindComplaints], ...]
"""Rules that are applied one after the other."""


class _Plan(NamedTuple):
    """What is done with elements of one kind.

    ``rules``: all of theirs.
    ``always``: those that are applied to each element.
    ``judged``: the others, by what they look at.
    ``fields``: those that lead to further elements with rules.
    """

    rules: Applied
    always: Applied
    judged: Mapping[JudgedBy, Applied]
    fields: tuple[str, ...]
    is_module: bool


def _plan(kind: type[Element], rules: Mapping[str, Rule]) -> _Plan:
    applied = tuple((one, one.complaints) for one in rules.values() if issubclass(kind, one.kinds))
    judged: dict[JudgedBy, Applied] = {}
    for one, complaints in applied:
        if one.judged_by is not None:
            judged[one.judged_by] = (*judged.get(one.judged_by, ()), (one, complaints))
    always = tuple((one, complaints) for one, complaints in applied if one.judged_by is None)
    ruled = tuple(dict.fromkeys(kind for one in rules.values() for kind in one.kinds))
    return _Plan(applied, always, judged, fields_towards(kind, ruled), issubclass(kind, MODULES))


class _PlanHere(NamedTuple):
    """The plan for one kind in one scope; ``fine`` has what is known to be fine there, by what it was taken from."""

    plan: _Plan
    fine: tuple[tuple[JudgedBy, set[Hashable]], ...]
    always: Applied
    fields: tuple[str, ...]
    is_module: bool

    def all_fine(self, elements: Sequence[Element]) -> bool:
        """Whether ``elements`` are of this kind, are known to be fine, and hold nothing with rules: asked at once, because they are many."""
        return (
            len(set(map(type, elements))) == 1
            and all(known.issuperset(map(decides, elements)) for decides, known in self.fine)
            and not any(any(map(attrgetter(field), elements)) for field in self.fields)
        )

    def judged(self, element: Element, scope: Scope, file: str) -> list[Diagnostic]:
        """What all rules have against ``element``, in their order; what is fine is noted."""
        fresh = [(by, known) for by, known in self.fine if by(element) not in known]
        wrong = {by for by, _ in fresh for _, find in self.plan.judged[by] if any(True for _ in find(element, scope))}
        for by, known in fresh:
            if by not in wrong:
                known.add(by(element))
        applied = self.plan.rules if wrong else self.always
        return [_diagnostic(one, at, said, file) for one, find in applied for at, said in find(element, scope)]


class _Place:
    """The plans for the elements of one scope. Kinds with the same rules share what is known to be fine."""

    def __init__(self, rules: Mapping[str, Rule], plans: Plans) -> None:
        self.plans: dict[type[Element], _PlanHere] = {}
        self._rules = rules
        self._plans = plans
        self._fine: dict[tuple[JudgedBy | FindComplaints, ...], set[Hashable]] = {}

    def plan(self, kind: type[Element]) -> _PlanHere:
        """The plan for ``kind``."""
        plan = self._plans.get(kind)
        if plan is None:
            plan = self._plans[kind] = _plan(kind, self._rules)
        fine = tuple(
            (by, self._fine.setdefault((by, *(find for _, find in applied)), set()))
            for by, applied in plan.judged.items()
        )
        here = self.plans[kind] = _PlanHere(plan, fine, plan.always, plan.fields, plan.is_module)
        return here


def _found_by(one: Rule, model: Model, root: Scope, file: str) -> Iterator[Diagnostic]:
    for wrong, message in one.complaints(model, root):
        yield _diagnostic(one, wrong, message, file)


def _diagnostic(one: Rule, wrong: Element, message: str, file: str) -> Diagnostic:
    return Diagnostic(file, wrong.line, message, one.requirement)
