"""From a plan to its units: runs with their parts, and trials. What is on this machine is read first; the rest is a function of that."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from ucm_cts.harness.campaigns.plan import Plan, PlannedProduct, SelfTest
from ucm_cts.harness.campaigns.products import (
    executable_digest,
    product_digest,
    purposes_of,
    statement_at,
    statement_digest,
)
from ucm_cts.harness.campaigns.units import (
    Conclusion,
    GeneratedTrial,
    PlannedRun,
    Slice,
    Trial,
    Unit,
    slices,
)
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.certificates.suite_build import bundled_digest, suite_digest
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.results.known_failures import KnownFailure, known_today
from ucm_cts.harness.selftest.generated import python_programs
from ucm_cts.harness.selftest.generated.mutants import GeneratedMutant, drawn
from ucm_cts.harness.selftest.trials import Subject, Thoroughness, all_mutants, all_variants, names


@dataclass(frozen=True)
class RunOfPlan:
    """One run with its ``parts``. ``name``: ``product/profile/seed-N`` or ``product/variant/profile/seed-N``, unique in its plan."""

    name: str
    product: str
    run: PlannedRun
    parts: tuple[Slice, ...]
    known: tuple[KnownFailure, ...]

    def conclusion(self, lost: Sequence[Slice]) -> Conclusion:
        """The unit that ends it, without the parts that are ``lost``."""
        kept = tuple(part for part in self.parts if part not in lost)
        return Conclusion(self.run, kept, self.known, tuple(lost))


@dataclass(frozen=True)
class Work:
    """All units of a plan. ``trials``: by the names under which a self-test shows them, with the seed before them."""

    runs: tuple[RunOfPlan, ...]
    trials: Mapping[tuple[int, str], Trial | GeneratedTrial]

    def first(self) -> Iterator[Unit]:
        """The units that need no other one. Those of several runs take turns, so that early results are of all of them."""
        yield from self.trials.values()
        longest = max((len(run.parts) for run in self.runs), default=0)
        for place in range(longest):
            yield from (run.parts[place] for run in self.runs if place < len(run.parts))


def work_of(plan: Plan) -> Work:
    """The units of ``plan``. Paths in it are taken from the current folder. Raises ``DocumentError`` with the line of what is wrong."""
    runs = tuple(run for product in plan.products for run in _runs(plan, product))
    trials = dict(_trials(plan, plan.self_test)) if plan.self_test is not None else {}
    return Work(runs, trials)


def _runs(plan: Plan, product: PlannedProduct) -> Iterator[RunOfPlan]:
    """The runs of one product: its files are read once."""
    try:
        endpoint = locate(product.adapter, sandbox=product.sandbox, virtual_time=product.virtual_time)
        statement = statement_at(product.statement, product.adapter, product.sandbox)
        known = known_today(Path(product.known_failures) if product.known_failures else None)
        usual = PlannedRun(
            suite=suite_digest(),
            product=product_digest(endpoint, product.artifacts),
            stated=statement_digest(statement),
            adapter=product.adapter,
            statement=product.statement,
            artifacts=product.artifacts,
            profile="",
            seed=0,
            select=product.select,
            systematic=product.systematic,
            virtual_time=product.virtual_time,
            sandbox=product.sandbox,
            timeout=product.timeout,
            memory=product.memory,
            incident_time=product.incident_time,
        )
        for profile in product.profiles:
            if profile not in statement.profiles:
                raise WrongUse(
                    f"the statement of {product.name} does not claim profile '{profile}'; claim it, or leave it out here"
                )
            of_profile = msgspec.structs.replace(usual, profile=profile)
            purposes = purposes_of(of_profile, statement)
            if not purposes:
                raise WrongUse(
                    f"{product.name} selects '{product.select}', which matches no test purpose of profile {profile}; "
                    "try a requirement, a clause or an operation"
                )
            for seed in product.seeds:
                run = msgspec.structs.replace(of_profile, seed=seed)
                parts = slices(run, purposes, plan.scenarios)
                yield RunOfPlan(f"{product.name}/{profile}/seed-{seed}", product.name, run, parts, known)
    except WrongUse as problem:
        raise DocumentError(plan.path, product.line, str(problem)) from None


def _trials(plan: Plan, wanted: SelfTest) -> Iterator[tuple[tuple[int, str], Trial | GeneratedTrial]]:
    try:
        subjects, generated = tuple(_subjects(wanted)), tuple(_generated(wanted))
    except WrongUse as problem:
        raise DocumentError(plan.path, plan.line, str(problem)) from None
    suite = bundled_digest()
    for seed in wanted.seeds:
        how = Thoroughness(seed, wanted.whole, wanted.quick, real_time=wanted.real_time)
        for subject in subjects:
            executable = executable_digest() if subject.is_native else ""
            yield (
                (seed, subject.name),
                Trial(suite, subject.name, how, executable, wanted.real_time or subject.is_native),
            )
        for mutant in generated:
            yield (seed, mutant.key), GeneratedTrial(suite, mutant, seed)


def _subjects(wanted: SelfTest) -> Iterator[Subject]:
    """The bundled subjects: those that are named, none for an empty list, else all; with ``quick`` no variants that are not named."""
    if wanted.names != ():
        subjects = names({**all_mutants(), **all_variants()}, wanted.names or ())
        yield from (one for one in subjects if one.breaks or wanted.names or not wanted.quick)


def _generated(wanted: SelfTest) -> Iterator[GeneratedMutant]:
    if not wanted.generated:
        return
    if importlib.util.find_spec("universalmutator") is None:
        raise WrongUse(
            "generated mutants take universalmutator, which this environment lacks: pip install universalmutator==1.14.1"
        )
    candidates, _ = python_programs.candidates()
    yield from drawn(candidates, wanted.generated)
