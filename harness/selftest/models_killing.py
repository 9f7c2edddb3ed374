"""Mutants that ship models with one defect; they are killed without running a framework."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence

from ucm_cts.harness.models.core_models import ModelResult
from ucm_cts.harness.selftest.matrix import Kill, MutantResult
from ucm_cts.harness.selftest.spoilt_models import Mutation, Place, declarations, repeating, spoilt_results, statements

Spoilt = tuple[Mutation, str, Mapping[str, ModelResult]]
"""A way to spoil models, the requirement that it must break, and what came of it."""

_CONTRADICTING = {"is": ("Union",), "there": ("dropped", "name=")}
"""What contradicts a statement that something is of its kind, or is there; of others it is to change what they name."""


def all_models() -> tuple[str, ...]:
    """The requirements on models: those about a declaration, then those about several only."""
    return tuple(dict.fromkeys((*declarations(), *statements())))


def examine_models(requirement: str) -> MutantResult:
    """All ways to spoil the declarations of ``requirement``, as one mutant; it survives if one way does."""
    places = declarations().get(requirement, ())
    repeated = statements()[requirement].of if requirement in statements() else {}
    what = [f"{place.path} of {place.file}" for place in places[:1]]
    if repeated:
        what.append(f"what it says of {', '.join(declarations()[of][0].path for of in repeated)}")
    spoilt = (*_of_declarations(requirement, places), *_of_statement(requirement, repeated))
    return _examined(requirement, ", or ".join(what), spoilt)


def _of_declarations(requirement: str, places: Sequence[Place]) -> Iterator[Spoilt]:
    """What is changed inside a declaration may be the matter of another requirement, which then must fail."""
    for _, mutation, results in spoilt_results(requirement) if places else ():
        if mutation.clear:
            yield mutation, mutation.requirement, results


def _of_statement(requirement: str, repeated: Mapping[str, tuple[str, ...]]) -> Iterator[Spoilt]:
    """Its own requirement must fail beside that of the declaration: the first of those that this speaks of."""
    for declaration, facts in repeated.items():
        ways = tuple(way for fact in facts for way in _CONTRADICTING.get(fact, (f"{fact}=",)))
        for place, mutation, results in spoilt_results(declaration):
            if mutation.clear and mutation.what.startswith(ways) and place == declarations()[declaration][0]:
                yield mutation, requirement, results


def _examined(requirement: str, what: str, spoilt: Iterable[Spoilt]) -> MutantResult:
    began = time.monotonic()
    shown: dict[str, list[tuple[Mutation, ModelResult]]] = defaultdict(list)
    due: set[str] = set()
    own: set[str] = set()
    missed: set[str] = set()
    number = 0
    for mutation, breaks, results in spoilt:
        number += 1
        due.add(breaks)
        own.add(mutation.requirement)
        missed.update({breaks} if results[breaks].status != "broken" else ())
        for result in results.values():
            if result.status == "broken":
                shown[result.requirement].append((mutation, result))
    return MutantResult(
        f"models of {requirement}",
        f"ships models in which {what} is spoilt in one of {number} ways",
        requirement.removeprefix("R-").rpartition("-")[0],
        tuple(sorted(due)),
        tuple(sorted((own | {also for each in due | own for also in repeating(each)}) - due)),
        tuple(_kill(*found[0], each not in missed, len(found)) for each, found in sorted(shown.items())),
        (),
        0,
        round(time.monotonic() - began, 3),
    )


def _kill(mutation: Mutation, result: ModelResult, every_way: bool, ways: int) -> Kill:
    shown_by = result.expected, result.observed
    return Kill(result.requirement, f"models: {mutation.what}", result.check, *shown_by, (), every_way, ways)
