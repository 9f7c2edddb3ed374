"""Selects, by the vendor's statement, the scenarios that are run and the requirements that count."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Scenario
from ucm_cts.harness.catalogue.requirements import Need, Requirement, load_capabilities, needs_of_requirement
from ucm_cts.harness.models.core_models import CHECKS
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.results.statement import HOOKS, IMPOSSIBLE, Statement, default_statement
from ucm_cts.harness.results.values import Verdict
from ucm_cts.reference_models.model.execution_policies import protection_of
from ucm_cts.reference_models.model.service_policies import TIMERS

Cases = tuple[tuple[str, Scenario], ...]

_PARTS_OF_POLICIES = {s.INDEX_TIMERS: "index-timers", s.OBJECT_TIMERS: "object-timers"}
"""The parts that have another name than their policy."""


def purposes_for(statement: Statement, profile: str, extra_states: int = 0) -> tuple[TestPurpose, ...]:
    """The test purposes of ``profile``, with the scenarios that need only claimed parts; systematic suites are
    those for ``extra_states`` additional states. A few that have something for every requirement come first.
    """
    stated = msgspec.structs.replace(statement, source="", folder="")  # where it is written decides nothing here
    return _purposes_for(msgspec.json.encode(stated), profile, extra_states)


@functools.lru_cache(maxsize=8)
def _purposes_for(stated: bytes, profile: str, extra_states: int) -> tuple[TestPurpose, ...]:
    """The same for a statement in JSON: self-tests and campaigns ask for the same ones again and again."""
    statement = msgspec.json.decode(stated, type=Statement)
    reduced = (_reduced(purpose, statement) for purpose in _all_purposes(statement, profile, extra_states))
    return _every_requirement_early(tuple(purpose for purpose in reduced if purpose.scenarios))


def _every_requirement_early(purposes: tuple[TestPurpose, ...]) -> tuple[TestPurpose, ...]:
    """``purposes`` in their order, after those with few scenarios that together are for all requirements."""
    first: set[str] = set()
    met: set[str] = set()
    for purpose in sorted(purposes, key=lambda purpose: len(purpose.scenarios)):
        if not met.issuperset(purpose.requirements):
            first.add(purpose.id)
            met.update(purpose.requirements)
    return tuple(sorted(purposes, key=lambda purpose: purpose.id not in first))


def needs_of(scenario: Scenario) -> frozenset[str]:
    """What a vendor must claim for ``scenario`` to be run: parts of 10.1, and test operations of the adapter."""
    applied = {p.definition for declaration in scenario.components.values() for p in declaration.policies}
    applied = {_PARTS_OF_POLICIES.get(definition, definition) for definition in applied}
    return frozenset(applied & _parts() | {step.claim for step in scenario.steps if step.claim})


_KNOWN: dict[int, tuple[Scenario, frozenset[str]]] = {}
"""What scenarios of test purposes need. They live as long as the process, because ``load_purposes`` keeps them."""


def _needs_as_known(scenario: Scenario) -> frozenset[str]:
    """``needs_of`` a scenario of a test purpose."""
    known = _KNOWN.get(id(scenario))
    if known is None:
        known = _KNOWN[id(scenario)] = scenario, needs_of(scenario)
    return known[1]


def why_not(requirement: Requirement, statement: Statement) -> tuple[Verdict, str] | None:
    """Why ``requirement`` is not decided for this vendor, and what its verdict is then; None if it is to be decided.

    A test facility that the adapter does not offer makes it inconclusive; a capability that is not claimed makes it not applicable.
    """
    missing = [unmet for need in needs_of_requirement(requirement.id) for unmet in _unmet(need, statement)]
    if set(requirement.rules) <= CHECKS.keys() and not statement.meets(_WITH_MODELS):
        missing.append((_WITH_MODELS,))
    if not missing:
        return None
    of_tests = [any(_is_test_operation(need, statement) for need in needs) for needs in missing]
    verdict: Verdict = "inconclusive" if all(of_tests) else "not applicable"
    decisive = missing[of_tests.index(True)] if all(of_tests) else missing[of_tests.index(False)]
    said = f"{statement.source} says" if statement.source else "without a statement it holds that"
    return verdict, f"{said} {' and '.join(dict.fromkeys(_shown(need, statement) for need in decisive))}"


@dataclass(frozen=True)
class Line:
    """A line of a statement: ``table`` and ``text``; ``option`` is the option that it declares, empty if it declares none."""

    table: str
    text: str
    option: str = ""

    def __str__(self) -> str:
        return f"[{self.table}] {self.text}"


def lines_for(requirement: Requirement, statement: Statement) -> tuple[Line, ...]:
    """The lines that would let a run decide ``requirement``, which it does not under ``statement``; none if others decide.

    Of several that would do, the first.
    """
    unmet = [needs for need in load_capabilities().of(requirement.id) for needs in _unmet(need, statement)]
    lines = [_line(needs[0]) for needs in unmet]
    if set(requirement.rules) <= CHECKS.keys() and statement.meets(_WITH_MODELS) and not statement.models:
        lines.append(_MODELS)
    return tuple(dict.fromkeys(lines))


_MODELS = Line("models", 'core = ["FOLDER"]', "core-models")


def _line(need: str) -> Line:
    option, _, values = need.partition("=")
    if not values:
        return Line("capabilities", f"{need} = true")
    return Line("readings", f'{option} = "{values.partition("|")[0]}"', option)


def lacking_claims(statement: Statement, profile: str) -> Mapping[str, str]:
    """The capabilities that are not claimed and that every scenario of a requirement needs, by requirement id."""
    lacking: dict[str, set[str]] = {}
    found: set[str] = set()
    for purpose in _all_purposes(statement, profile):
        for _, scenario in purpose.scenarios:
            missing = {need for need in _needs_as_known(scenario) if not statement.meets(need)}
            for requirement in purpose.requirements:
                lacking.setdefault(requirement, set()).update(missing)
            found.update(() if missing else purpose.requirements)
    return {requirement: ", ".join(sorted(parts)) for requirement, parts in lacking.items() if requirement not in found}


def _is_test_operation(need: str, statement: Statement) -> bool:
    """Would the adapter only have to offer it?"""
    option = need.partition("=")[0]
    return option in HOOKS and statement.readings[option] != IMPOSSIBLE


_MISSING_POLICY = "R-10.1.3-02"
ALWAYS_NEEDED = "missing-execution-policy"
"""The option that says whether components of all profiles need an execution policy."""

_REFUSED_WITHOUT = f"{ALWAYS_NEEDED}=refuse"
_ON_COMPONENTS = "protected-active-applicability=onComponent"
_TRACED_PORTS = "port-trace-applicability=onPort|onBoth"
_TRACE_PARAMETERS = "port-trace-parameters=both"
_WITH_MODELS = "core-models=shipped"


def _shown(need: str, statement: Statement) -> str:
    name = need.partition("=")[0]
    return f"{name} = {statement.value_of(name)}"


def _unmet(need: Need, statement: Statement) -> Iterator[tuple[str, ...]]:
    yield from ((one,) for one in need.needs if not statement.meets(one))
    if need.one_of and not any(map(statement.meets, need.one_of)):
        yield need.one_of


@functools.cache
def _parts() -> frozenset[str]:
    return frozenset(capability.id for capability in load_capabilities().capabilities)


def _all_purposes(statement: Statement, profile: str, extra_states: int = 0) -> tuple[TestPurpose, ...]:
    default = default_statement().declared
    declared = (reading for reading in statement.declared if reading not in default)
    return load_purposes(profile, *declared, extra_states=extra_states)


def _reduced(purpose: TestPurpose, statement: Statement) -> TestPurpose:
    draw = purpose.draw
    as_written = _MISSING_POLICY in purpose.requirements
    fitted = draw and (lambda seed, readings: fitting(draw(seed, readings), statement, as_written))
    scenarios = fitting(purpose.scenarios, statement, as_written, _needs_as_known)
    return replace(purpose, scenarios=scenarios, draw=fitted)


def fitting(
    cases: Iterable[tuple[str, Scenario]],
    statement: Statement,
    as_written: bool = False,
    needs: Callable[[Scenario], frozenset[str]] = needs_of,
) -> Cases:
    """The ``cases`` that need only claimed parts, with the declared patience. Components get the execution policy that the framework
    insists on, unless they are taken ``as_written``. ``needs`` says what a scenario needs.
    """
    return tuple(
        (name, _fitted(scenario if as_written else with_policies(scenario, statement), statement))
        for name, scenario in cases
        if all(map(statement.meets, needs(scenario)))
    )


def with_policies(scenario: Scenario, statement: Statement) -> Scenario:
    """``scenario``; if the framework refuses components without execution policy (one-policy-count), each that has none gets the one that
    changes least: of unprotected passive components, or else of protected passive ones, whichever is claimed.
    """
    passive = [kind for kind in (s.UNPROTECTED_PASSIVE, s.PROTECTED_PASSIVE) if statement.meets(kind)]
    if not passive or not statement.meets(_REFUSED_WITHOUT):
        return scenario
    given = {name: _with_policy(declaration, passive[0]) for name, declaration in scenario.components.items()}
    return msgspec.structs.replace(scenario, components=given)


def _with_policy(declaration: Declaration, definition: str) -> Declaration:
    if protection_of(declaration):
        return declaration
    return msgspec.structs.replace(declaration, policies=(s.Policy(definition), *declaration.policies))


def _fitted(scenario: Scenario, statement: Statement) -> Scenario:
    """The scenario with the declared patience, policies where they can be attached, and no ``read_log`` steps if the log cannot be
    read back. Patience is not shortened where policies have times: the wait for what they bring lasts as long as they say.
    """
    patience = round(scenario.patience * statement.ixit["patience"] / default_statement().ixit["patience"])
    policies = [policy for declaration in scenario.components.values() for policy in declaration.policies]
    if any(policy.settings or policy.definition in TIMERS for policy in policies):
        patience = max(patience, scenario.patience)
    steps = scenario.steps
    if not statement.meets("trace-sink=hook"):
        steps = tuple(step for step in steps if not isinstance(step, s.ReadLog))
    components = scenario.components
    if statement.meets(_ON_COMPONENTS):
        components = {name: _active_as_a_whole(declaration) for name, declaration in components.items()}
    if not (statement.meets(_TRACED_PORTS) and statement.meets(_TRACE_PARAMETERS)):
        components = {name: _traced_as_declared(declaration, statement) for name, declaration in components.items()}
    return msgspec.structs.replace(scenario, components=components, patience=max(1, patience), steps=steps)


def _active_as_a_whole(declaration: Declaration) -> Declaration:
    """The active policy is attached to the component, once, instead of its ports (active-applicability)."""
    return _with_each(declaration, s.ACTIVE, lambda _: s.Policy(s.ACTIVE))


def _traced_as_declared(declaration: Declaration, statement: Statement) -> Declaration:
    """Port traces are attached to the component where ports cannot have them, and have no parameters where none are known."""
    changes: dict[str, object] = {} if statement.meets(_TRACED_PORTS) else {"port": None}
    if not statement.meets(_TRACE_PARAMETERS):
        changes["parameters"] = {}
    return _with_each(declaration, s.PORT_TRACE, lambda policy: msgspec.structs.replace(policy, **changes))


def _with_each(declaration: Declaration, definition: str, change: Callable[[s.Policy], s.Policy]) -> Declaration:
    """``declaration`` with a ``change`` of each policy of ``definition``; policies that become equal are kept once."""
    kept: list[s.Policy] = []
    for policy in declaration.policies:
        changed = change(policy) if policy.definition == definition else policy
        if policy.definition != definition or changed not in kept:
            kept.append(changed)
    return msgspec.structs.replace(declaration, policies=tuple(kept))
