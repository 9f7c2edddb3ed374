"""The test purposes of a profile: those of the scripts and those derived from the life-cycle table."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterable

from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_options, requirements_of
from ucm_cts.harness.purposes.data.scenarios import data_purposes
from ucm_cts.harness.purposes.derived.calls_out import calls_from_callbacks, calls_from_run
from ucm_cts.harness.purposes.derived.index_timers import index_timer_purposes
from ucm_cts.harness.purposes.derived.life_cycle import generated_purposes
from ucm_cts.harness.purposes.derived.log_messages import log_message_purposes
from ucm_cts.harness.purposes.derived.messages import message_purposes
from ucm_cts.harness.purposes.derived.object_timers import object_timer_purposes
from ucm_cts.harness.purposes.derived.paced_calls import paced_call_purposes
from ucm_cts.harness.purposes.derived.paced_connections import paced_connection_purposes
from ucm_cts.harness.purposes.derived.paced_policies import policy_purposes
from ucm_cts.harness.purposes.derived.paced_runs import run_purposes as paced_run_purposes
from ucm_cts.harness.purposes.derived.request_response import request_purposes
from ucm_cts.harness.purposes.derived.schedules import crowd_purposes, overlap_purposes
from ucm_cts.harness.purposes.derived.services import service_purposes
from ucm_cts.harness.purposes.derived.shared_data import shared_data_purposes
from ucm_cts.harness.purposes.derived.unforeseen import unforeseen_purposes
from ucm_cts.harness.purposes.probes import load_probe_types
from ucm_cts.harness.purposes.provocations.boundaries import boundary_purposes
from ucm_cts.harness.purposes.provocations.container_contention import container_contention_purposes
from ucm_cts.harness.purposes.provocations.contention import contention_purposes, service_contention_purposes
from ucm_cts.harness.purposes.provocations.core_boundaries import core_boundary_purposes
from ucm_cts.harness.purposes.provocations.later_use import later_use_purposes
from ucm_cts.harness.purposes.provocations.purposes import duration_purposes, provocation_purposes, run_purposes
from ucm_cts.harness.purposes.scripts import TestPurpose, load_scripts, to_scenario
from ucm_cts.harness.purposes.systematic.purposes import systematic_purposes
from ucm_cts.harness.purposes.tables import purposes_of

_CORE: tuple[Callable[[], list[TestPurpose]], ...] = (
    overlap_purposes,
    crowd_purposes,
    functools.partial(purposes_of, "execution_policies"),
    message_purposes,
    service_purposes,
    calls_from_run,
    log_message_purposes,
    functools.partial(purposes_of, "port_traces"),
)
"""Where the purposes of profile core come from, beside scripts, dimensions and those of data types."""

_EXTENSIONS: tuple[Callable[[], list[TestPurpose]], ...] = (
    request_purposes,
    shared_data_purposes,
    policy_purposes,
    paced_run_purposes,
    paced_call_purposes,
    paced_connection_purposes,
    index_timer_purposes,
    object_timer_purposes,
    calls_from_callbacks,
)
"""Where those of profile extensions come from."""

_DIMENSIONS: tuple[Callable[[], list[TestPurpose]], ...] = (
    provocation_purposes,
    duration_purposes,
    boundary_purposes,
    later_use_purposes,
    contention_purposes,
    container_contention_purposes,
)
"""Where the purposes come from that are derived from dimensions."""

_DIMENSIONS_OF_CORE: tuple[Callable[[], list[TestPurpose]], ...] = (
    service_contention_purposes,
    core_boundary_purposes,
    run_purposes,
)
"""The same for profile core."""


@functools.cache
def load_purposes(profile: str, *readings: str, extra_states: int = 0) -> tuple[TestPurpose, ...]:
    """All test purposes of ``profile``: scripts first, because they read best when they fail.

    Those for other ``readings`` (``option=value``) are left out; of an option that is not declared the first value holds.
    Systematic suites are those for ``extra_states`` additional states.
    """
    known = _readings(readings)
    data = data_purposes(known) if "core" in PARTS[profile] else []
    systematic = systematic_purposes(known, extra_states)
    return tuple(purpose for purpose in (*_all_purposes(profile), *systematic, *data) if _is_for(purpose, known))


def plain_purposes(profile: str, *readings: str) -> tuple[TestPurpose, ...]:
    """Those of ``load_purposes`` that are quickly made: from neither dimensions nor systematic suites."""
    known = _readings(readings)
    data = data_purposes(known) if "core" in PARTS[profile] else []
    return tuple(purpose for purpose in (*_written(profile), *_combined(profile), *data) if _is_for(purpose, known))


def _is_for(purpose: TestPurpose, readings: dict[str, str]) -> bool:
    wanted = (condition.partition("=") for condition in purpose.under)
    return all(readings[option] in values.split("|") for option, _, values in wanted)


def _readings(declared: tuple[str, ...]) -> dict[str, str]:
    first = {option: values[0] for option, values in load_options().items()}
    return first | {option: value for option, _, value in (reading.partition("=") for reading in declared)}


@functools.cache
def _all_purposes(profile: str) -> tuple[TestPurpose, ...]:
    sources = (*_DIMENSIONS, *(_DIMENSIONS_OF_CORE if "core" in PARTS[profile] else ()))
    derived = (dataclasses.replace(purpose, of_dimensions=True) for source in sources for purpose in source())
    return (*_written(profile), *derived, *_combined(profile))


@functools.cache
def _combined(profile: str) -> tuple[TestPurpose, ...]:
    sources = (
        *(_CORE if "core" in PARTS[profile] else ()),
        *(_EXTENSIONS if "extensions" in PARTS[profile] else ()),
    )
    return tuple(purpose for source in sources for purpose in source())


@functools.cache
def _written(profile: str) -> tuple[TestPurpose, ...]:
    clauses = {r.id: r.clause for r in requirements_of(profile)}
    probes = load_probe_types()
    scripted = (
        TestPurpose(
            script.scenario,
            clauses[script.exercises[0]],
            script.purpose,
            script.exercises,
            ((script.scenario, to_scenario(script, probes)),),
            under=script.under,
        )
        for script in load_scripts()
        if script.exercises[0] in clauses
    )
    return (
        *scripted,
        *generated_purposes(load_life_cycle()),
        *purposes_of("start"),
        *purposes_of("peers"),
        *unforeseen_purposes(),
    )


def select(purposes: tuple[TestPurpose, ...], expression: str) -> tuple[TestPurpose, ...]:
    """The purposes whose id, clause or requirements contain one of the words of ``expression`` (separated by ``or``)."""
    words = words_of(expression)
    return tuple(p for p in purposes if any(w in " ".join((p.id, p.clause, *p.requirements)).lower() for w in words))


def asked_by(purposes: Iterable[TestPurpose], expression: str) -> frozenset[str]:
    """The requirements that ``expression`` asks for: all of a purpose whose id or clause it names, else those that it names."""
    words = words_of(expression)
    asked: set[str] = set()
    for purpose in purposes:
        whole = any(word in part.lower() for word in words for part in (purpose.id, purpose.clause))
        asked.update(r for r in purpose.requirements if whole or any(word in r.lower() for word in words))
    return frozenset(asked)


def words_of(expression: str) -> list[str]:
    """The words of ``expression``, in small letters."""
    return [word.strip().lower() for word in expression.split(" or ") if word.strip()]
