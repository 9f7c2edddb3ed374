"""Mutants that ship core models with one thing wrong in them: are they found out, without running anything?"""

from __future__ import annotations

import time
from collections import defaultdict

from ucm_cts.harness.models.core_models import ModelResult
from ucm_cts.harness.selftest.matrix import Kill, MutantResult
from ucm_cts.harness.selftest.spoilt_models import Mutation, declarations, repeating, spoilt_results


def examine_models(requirement: str) -> MutantResult:
    """Every way to spoil the declaration that ``requirement`` speaks of, as one mutant; it survives if one of them does.

    What is changed inside a declaration may be the matter of another requirement, which then must fail.
    """
    began = time.monotonic()
    declaration = declarations()[requirement]
    clear = [(mutation, results) for mutation, results in spoilt_results(requirement) if mutation.clear]
    due = {mutation.requirement for mutation, _ in clear}
    shown: dict[str, list[tuple[Mutation, ModelResult]]] = defaultdict(list)
    for mutation, results in clear:
        for result in results.values():
            if result.status == "broken":
                shown[result.requirement].append((mutation, result))
    missed = {mutation.requirement for mutation, results in clear if results[mutation.requirement].status != "broken"}
    return MutantResult(
        f"models of {requirement}",
        f"ships core models in which {declaration.place} of {declaration.file} is spoilt in one of {len(clear)} ways",
        requirement.removeprefix("R-").rpartition("-")[0],
        tuple(sorted(due)),
        tuple(sorted({also for each in due for also in repeating(each)})),
        tuple(_kill(*found[0], each not in missed, len(found)) for each, found in sorted(shown.items())),
        (),
        0,
        round(time.monotonic() - began, 3),
    )


def _kill(mutation: Mutation, result: ModelResult, every_way: bool, ways: int) -> Kill:
    told = result.expected, result.observed
    return Kill(result.requirement, f"models: {mutation.what}", result.check, *told, (), every_way, ways)
