"""Runs a self-test: all mutants, conformant variants and cheats, several at a time, each in the ordinary pipeline."""

from __future__ import annotations

import multiprocessing
import signal
import time
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field

import ucm_cts
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.execution.leftovers import HOST_CHECKS
from ucm_cts.harness.models.core_models import CHECKS
from ucm_cts.harness.selftest.cheat_trials import all_cheats, examine_cheat
from ucm_cts.harness.selftest.matrix import CheatResult, Matrix, MutantResult, VariantResult
from ucm_cts.harness.selftest.model_variants import examine_model_variant, model_variants
from ucm_cts.harness.selftest.models_killing import examine_models
from ucm_cts.harness.selftest.toolchains import ToolChainSubject, examine_toolchain, testable_of_toolchains
from ucm_cts.harness.selftest.trials import (
    Subject,
    Thoroughness,
    examine_mutant,
    examine_variant,
)
from ucm_cts.reference_models.properties.table import PROPERTIES

Result = MutantResult | VariantResult | CheatResult


@dataclass
class SelfTest:
    """A self-test that is running; ``matrix`` has the results so far, also after an interrupt."""

    mutants: Sequence[Subject | ToolChainSubject]
    variants: Sequence[Subject | ToolChainSubject]
    how: Thoroughness
    jobs: int
    models: Sequence[str] = ()
    cheats: Sequence[str] = ()
    is_all: bool = False
    of_toolchains: bool = False
    _done: dict[str, Result] = field(default_factory=dict)
    _began: float = field(default_factory=time.monotonic)

    def run(self, report: Callable[[Result], None]) -> None:
        """Examine all subjects; ``report`` is called with each result."""
        for name in self.models:
            result = examine_model_variant(name) if name in model_variants() else examine_models(name)
            self._done[result.name] = result
            report(result)
        self._examine_all([*self.mutants, *self.variants], report)
        self._examine_all(self.cheats, report, uses=1)  # they run in the harness's process and may change it

    def _examine_all(
        self,
        subjects: Sequence[Subject | ToolChainSubject | str],
        report: Callable[[Result], None],
        uses: int | None = None,
    ) -> None:
        """Examine ``subjects``, several at a time; a process examines at most ``uses`` of them."""
        context = multiprocessing.get_context("spawn")
        leave_interrupts = _leave_interrupts_to_the_parent
        with ProcessPoolExecutor(self.jobs, context, leave_interrupts, max_tasks_per_child=uses) as pool:
            owners = {pool.submit(_examine, subject, self.how): subject for subject in subjects}
            due = set(owners)
            try:
                while due:
                    done, due = wait(due, return_when=FIRST_COMPLETED)
                    for future in done:
                        result = _result(future, owners[future])
                        self._done[result.name] = result
                        report(result)
            except BaseException:
                for worker in multiprocessing.active_children():  # what they do takes long, and is not needed any more
                    worker.terminate()
                raise

    @property
    def number(self) -> int:
        """The number of subjects."""
        return len(self.mutants) + len(self.variants) + len(self.models) + len(self.cheats)

    @property
    def matrix(self) -> Matrix:
        """The results so far."""
        results = list(self._done.values())
        return Matrix(
            ucm_cts.__version__,
            self.how.seed,
            round(time.monotonic() - self._began, 1),
            testable_of_toolchains() if self.of_toolchains else testable(),
            tuple(sorted((r for r in results if isinstance(r, MutantResult)), key=_by_name)),
            tuple(sorted((r for r in results if isinstance(r, VariantResult)), key=_by_name)),
            self.how.whole,
            tuple(sorted((r for r in results if isinstance(r, CheatResult)), key=_by_name)),
            self.number - len(results),
            self.is_all,
        )


def _by_name(result: Result) -> str:
    return result.name


def testable() -> tuple[str, ...]:
    """The requirements that a property or a check of models verifies, without permissions: nothing breaks those."""
    checks = PROPERTIES.keys() | CHECKS.keys() | HOST_CHECKS.keys()
    return tuple(r.id for r in load_requirements() if r.level != "may" and any(rule in checks for rule in r.rules))


def _examine(subject: Subject | ToolChainSubject | str, how: Thoroughness) -> Result:
    if isinstance(subject, str):
        return examine_cheat(all_cheats()[subject])
    if isinstance(subject, ToolChainSubject):
        return examine_toolchain(subject)
    return examine_mutant(subject, how) if subject.breaks else examine_variant(subject, how)


def _result(future: Future[Result], subject: Subject | ToolChainSubject | str) -> Result:
    try:
        return future.result()
    except BrokenProcessPool:
        trouble = "the process that examined it, or another one, died"
    except Exception as problem:  # noqa: BLE001 - one subject's trouble is not the others'
        trouble = f"the harness failed: {type(problem).__name__}: {problem}"
    if isinstance(subject, str):
        return CheatResult(subject, "", (), (), False, 0.0, trouble)
    if not subject.breaks:
        return VariantResult(subject.name, (), (), 0, 0.0, trouble)
    return MutantResult(subject.name, subject.lie, "", subject.breaks, subject.also, (), (), 0, 0.0, trouble)


def _leave_interrupts_to_the_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
