"""Which subject that must be spared takes which value of which option of the interpretations."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping

from ucm_cts.adapters.mutants.python.subjects import VARIANTS
from ucm_cts.adapters.mutants.toolchain.registry import variants
from ucm_cts.harness.catalogue.requirements import Interpretation, load_interpretations, load_options, load_requirements
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.selftest.model_variants import model_variants
from ucm_cts.harness.statement.files import stated_by

REFERENCE_FRAMEWORKS = ("reference-py", "reference-cpp", "reference-cpp-typed")
REFERENCE_TOOL_CHAIN = "the reference tool chain"
OBSERVED = "observed"
"""The value of an option that binds nothing."""

_TASKS: Mapping[str, tuple[str, ...]] = {"pim": ("check",), "idl": ("idl",), "cpp": ("cpp11", "cpp03")}
"""The tasks of tool chains, by the profile that has the option."""

OptionValue = tuple[str, str]


def values_taken() -> Mapping[OptionValue, tuple[str, ...]]:
    """The names of the subjects that take each value of each option; none for a value that nobody takes.

    A subject takes what it declares of the options that concern it. The references take ``observed``, too, where they declare nothing;
    any other default must be declared by somebody, for the references may do more than it says.
    """
    found: dict[OptionValue, list[str]] = {
        (option, value): [] for option, values in load_options().items() for value in values
    }
    for name, option, value in _taken():
        found[option, value].append(name)
    return {taken: tuple(names) for taken, names in found.items()}


def _taken() -> Iterator[tuple[str, str, str]]:
    entries = {option: entry for entry in load_interpretations() for option in entry.options}
    of_tool_chains = {option for option, entry in entries.items() if entry.profile in _TASKS}
    for reference in REFERENCE_FRAMEWORKS:
        stated = stated_by(None, reference).readings
        own = ((option, value) for option, value in stated.items() if option not in of_tool_chains)
        yield from ((reference, *taken) for taken in own if taken[1] in (OBSERVED, *_others(taken[0])))
    default = default_statement().readings
    nothing = (option for option in sorted(of_tool_chains) if default[option] == OBSERVED)
    yield from ((REFERENCE_TOOL_CHAIN, option, OBSERVED) for option in nothing)
    for framework in VARIANTS.values():
        for option, value in framework.readings.items():
            if option not in of_tool_chains and _concerns(framework.clauses, entries[option].id):
                yield framework.name, option, value
    for models in model_variants().values():
        if models.option in load_options():  # not one of a part that is in the making
            yield f"models: {models.name}", models.option, models.value
    for tool_chain in variants().values():
        for reading in tool_chain.declares:
            option, _, value = reading.partition("=")
            if tool_chain.task in _TASKS.get(entries[option].profile, ()):
                yield tool_chain.name, option, value


def _others(option: str) -> tuple[str, ...]:
    """The values of ``option`` but for the default."""
    return load_options()[option][1:]


def _concerns(clauses: tuple[str, ...], interpretation: str) -> bool:
    """Whether test purposes for some of the ``clauses`` show what an option of the ``interpretation`` decides."""
    return any(clause.startswith(clauses) for clause in _clauses()[interpretation])


@functools.cache
def _clauses() -> Mapping[str, frozenset[str]]:
    """By the id of an interpretation: its clauses, and those of the requirements that name it."""
    return {entry.id: frozenset(entry.clauses) | _of_requirements(entry) for entry in load_interpretations()}


def _of_requirements(entry: Interpretation) -> frozenset[str]:
    return frozenset(
        requirement.clause for requirement in load_requirements() if entry.id in requirement.interpretations
    )
