"""What ``ucm-cts explain`` can be asked about: a requirement, a clause, or an operation."""

from __future__ import annotations

import difflib
import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.catalogue.requirements import (
    CLAIMABLE,
    Requirement,
    load_capabilities,
    load_life_cycle,
    load_requirements,
)
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.purposes.provocations.dimensions import (
    NOTHING,
    Cell,
    Entrance,
    NamedAction,
    load_cells,
    load_dimensions,
)
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.statement.applicability import needs_of
from ucm_cts.reference_models.model.service_policies import has_timers
from ucm_cts.reference_models.properties.clause_11_2_2 import DECLARED

CELLS = ("provocation/", "refusal/")
"""How the ids of purposes begin whose scenarios are cells of provocation."""

_TEST_STEPS = frozenset(str(kind.__struct_config__.tag) for kind in get_args(s.ConnectorCall))
"""Operations that only tests know: no requirement names them."""

MOST_OF_A_FAMILY = 4
"""How many purposes of one family are listed one by one."""


@dataclass(frozen=True)
class Topic:
    """A clause or an operation: the requirements that concern it, and the test purposes, a line each."""

    heading: str
    requirements: tuple[Requirement, ...]
    purposes: tuple[str, ...] = ()


def found(identifier: str) -> Requirement | Topic:
    """What ``identifier`` names; a requirement may be named without ``R-``. Raises ``WrongUse`` if it names nothing."""
    wanted = identifier.strip().lower()
    requirements = {r.id.lower(): r for r in load_requirements()}
    requirement = requirements.get(wanted) or requirements.get(f"r-{wanted}")
    if requirement is not None:
        return requirement
    if wanted in _clauses():
        within = tuple(r for r in load_requirements() if r.clause == wanted or r.clause.startswith(f"{wanted}."))
        return Topic(f"clause {wanted}", within)
    operations = {name.lower(): name for name in _operations()}
    if wanted in operations:
        return _of_operation(operations[wanted])
    names = {name.lower(): name for name in (*(r.id for r in load_requirements()), *_clauses(), *_operations())}
    near = difflib.get_close_matches(wanted[:100], names, n=3, cutoff=0.4)
    what = "requirement" if wanted.startswith("r-") else "requirement, clause or operation"
    hint = f"; near it: {', '.join(names[n] for n in near)}" if near else ""
    raise WrongUse(f"no {what} '{one_line(identifier, 60)}'{hint}; 'ucm-cts explain' lists all requirements")


def _clauses() -> frozenset[str]:
    """The clauses of the catalogue, and those that they are within."""
    parts = (r.clause.split(".") for r in load_requirements())
    return frozenset(".".join(each[:length]) for each in parts for length in range(1, len(each) + 1))


def _operations() -> tuple[str, ...]:
    """Operations of containers and connectors, callbacks, the parts of 10.1 and the methods of their interfaces."""
    calls = (str(kind.__struct_config__.tag) for kind in get_args(s.ContainerCall))
    parts = (capability.id for capability in load_capabilities().capabilities)
    return tuple(dict.fromkeys((*calls, *sorted(_TEST_STEPS), *get_args(s.Hook), *parts, *sorted(s.STANDARD_METHODS))))


def _of_operation(name: str) -> Topic:
    """What concerns ``name``; of methods and of operations that only tests know, all that scenarios with them exercise."""
    purposes = [p for p in load_purposes("extensions") if any(_uses(scenario, name) for _, scenario in p.scenarios)]
    if name in _TEST_STEPS or name in s.STANDARD_METHODS:
        concerned = {id_ for purpose in purposes for id_ in purpose.requirements}
        concerned |= _concerned(name) if name not in _TEST_STEPS else set()
    else:
        concerned = _concerned(name)
        mentioned = _mentioning(name)
        purposes = [
            p for p in purposes if concerned.intersection(p.requirements) or mentioned.search(f"{p.id} {p.text}")
        ]
    requirements = tuple(r for r in load_requirements() if r.id in concerned)
    return Topic(f"operation {name}", requirements, tuple(_by_family(purposes)))


def _concerned(name: str) -> set[str]:
    """The requirements that mention ``name``, need it to be claimed, or are broken by what it may not do.

    Those of a part of 10.2 to 10.5 name it themselves.
    """
    concerned = {DECLARED.get(name, "")}
    concerned |= {
        id_ for row in load_life_cycle().rows if row.operation == name for id_ in (row.requirement, row.missing)
    }
    concerned |= {id_ for one in load_dimensions().entrances for id_ in one.exercises if name in (one.hook, one.by)}
    for r in load_requirements():
        needed = {each for need in load_capabilities().of(r.id) for each in (*need.needs, *need.one_of)}
        is_mentioned = name not in CLAIMABLE and _mentioning(name).search(f"{r.title} {r.meaning} {r.observed}")
        if name in needed or is_mentioned:
            concerned.add(r.id)
    return concerned


def _mentioning(name: str) -> re.Pattern[str]:
    return re.compile(rf"(?<![\w-]){re.escape(name)}(?![\w-])")


def _uses(scenario: Scenario, name: str) -> bool:
    """Does a step of ``scenario`` call ``name``, or a body call it or act in it, or a component have it as policy or connector?"""
    plans = [actions for one in scenario.components.values() for actions in one.plan.values()]
    return (
        any(name == getattr(action, "method", "") for actions in plans for action in actions)
        or any(name in (s.operation(step), getattr(step, "connector", ""), step.claim) for step in scenario.steps)
        or any(name in declaration.plan for declaration in scenario.components.values())
        or any(name == policy.definition for one in scenario.components.values() for policy in one.policies)
        or name in needs_of(scenario)
        or (name == s.ON_TIMEOUT and any(has_timers(one, s.INDEX_TIMERS) for one in scenario.components.values()))
        or (name == s.ON_TRIGGER and any(one.handlers for one in scenario.components.values()))
    )


def _by_family(purposes: Iterable[TestPurpose]) -> Iterator[str]:
    """A line for each purpose; families of many purposes have one in common."""
    families: dict[str, list[TestPurpose]] = {}
    for purpose in purposes:
        families.setdefault(purpose.id.partition("/")[0], []).append(purpose)
    for family, members in families.items():
        if len(members) <= MOST_OF_A_FAMILY:
            yield from (f"{p.id}: {p.text} ({_count(p.scenarios)})" for p in members)
        else:
            scenarios = [one for p in members for one in p.scenarios]
            yield f"{family}/...: {len(members)} test purposes as '{members[0].id}' ({_count(scenarios)})"


def _count(scenarios: Iterable[object]) -> str:
    number = len(list(scenarios))
    return f"{number} scenario{'s' if number != 1 else ''}"


def cells_of(requirement: str) -> list[str]:
    """The cells of provocation whose entrances concern ``requirement``: lines for people, with the reason of each empty cell."""
    dimensions = load_dimensions()
    lines = []
    for entrance in dimensions.entrances_and_refusals().values():
        if requirement in entrance.exercises:
            if entrance.hook is None:
                lines.append(f"{entrance.name}: {_aftermaths(entrance, NOTHING)}")
                continue
            lines.append(f"{entrance.name}:")
            lines += [f"  {action.name}: {_aftermaths(entrance, action)}" for action in dimensions.actions]
    return lines


def _aftermaths(entrance: Entrance, action: NamedAction) -> str:
    """How many aftermaths of ``action`` have scenarios, and why the others have none."""
    dimensions = load_dimensions()
    cells = [aftermath for one, of, aftermath in _chosen() if (one, of) == (entrance.name, action.name)]
    missing: dict[str, list[str]] = {}
    for aftermath in dimensions.aftermaths:
        if aftermath not in cells:
            missing.setdefault(_why_empty(entrance, action, aftermath), []).append(aftermath)
    covered = len({*cells})
    every = f"{_count(cells)}, {'each' if not missing else covered} of {len(dimensions.aftermaths)} aftermaths"
    if not covered:
        return f"none. {' '.join(missing)}"
    return "; ".join((every, *(f"not {', '.join(names)}: {reason}" for reason, names in missing.items())))


def _chosen() -> list[tuple[str, str, str]]:
    return [(cell.entrance.name, cell.action.name, cell.aftermath) for cell in load_cells()]


def _why_empty(entrance: Entrance, action: NamedAction, aftermath: str) -> str:
    """Why there is no scenario, whatever the place, position and kind."""
    dimensions = load_dimensions()
    places = itertools.product(dimensions.places, dimensions.positions, dimensions.kinds)
    reasons = dict.fromkeys(dimensions.why_empty(Cell(entrance, action, aftermath, *others)) for others in places)
    return " ".join(reasons)
