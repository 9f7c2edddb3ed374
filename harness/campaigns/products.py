"""From what a plan names to what runs on a machine: endpoints, statements and test purposes, with the digests that make sure of them.

The command and every worker call the same functions, so that a worker notices when its files are others.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path

import msgspec

from ucm_cts.adapters.mutants.cpp import COMMAND
from ucm_cts.harness.campaigns.units import GeneratedTrial, PlannedRun, Trial
from ucm_cts.harness.certificates.subjects import subjects_of
from ucm_cts.harness.certificates.suite_build import bundled_digest, suite_digest
from ucm_cts.harness.execution.driver import Limits
from ucm_cts.harness.hosting.compiled_parts import HOW_TO_COMPILE
from ucm_cts.harness.hosting.locate import Endpoint, WrongUse, file_named, locate
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import select
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import stated_by


def endpoint_of(run: PlannedRun, hidden: Sequence[str] = ()) -> Endpoint:
    """Where the adapter of ``run`` is; hosts do not see what is ``hidden``. Raises ``WrongUse``."""
    return locate(run.adapter, sandbox=run.sandbox, hidden=hidden, virtual_time=run.virtual_time)


def statement_at(path: str, adapter: str, sandbox: bool) -> Statement:
    """The statement at ``path`` or, if that is empty, the one that goes with ``adapter``. Raises ``DocumentError`` and ``WrongUse``."""
    return stated_by(Path(path) if path else None, adapter, sandbox)


def limits_of(run: PlannedRun) -> Limits:
    """What hosts of ``run`` may use."""
    return Limits(run.timeout, run.memory, incident_seconds=run.incident_time)


def purposes_of(run: PlannedRun, statement: Statement) -> tuple[TestPurpose, ...]:
    """The test purposes of ``run``, whose ``statement`` is given, in their order; none if it selects none."""
    offered = purposes_for(statement, run.profile, run.systematic)
    return select(offered, run.select) if run.select else offered


def product_digest(endpoint: Endpoint, artifacts: tuple[str, ...]) -> str:
    """The digest of the adapter's file, of the packages that it imports, and of ``artifacts``. Raises ``WrongUse``.

    Of a product on another machine only ``artifacts`` are known, so that there must be some.
    """
    adapter_file = file_named(endpoint)
    if not adapter_file and not artifacts:
        raise WrongUse(
            f"'{endpoint.text}' has no file here whose digest could tell it from another product; name its files: artifacts = [...]"
        )
    subjects = subjects_of(adapter_file, map(Path, artifacts), ())
    return _digest([(subject.name, subject.sha256) for subject in subjects])


def statement_digest(statement: Statement) -> str:
    """The digest of the content of ``statement`` and of the models that it names."""
    models = [
        (file.name, hashlib.sha256(file.read_bytes()).hexdigest())
        for place in statement.model_paths
        for file in (sorted(place.rglob("*.xml")) if place.is_dir() else [place])
        if file.is_file()
    ]
    return _digest((msgspec.structs.replace(statement, folder=""), models))


def check_same(run: PlannedRun, endpoint: Endpoint, statement: Statement) -> None:
    """Raise ``WrongUse`` unless suite, product and statement are here what they were where the plan was read."""
    check_suite(run.suite, suite_digest())
    for what, said, found in (
        (f"the product '{run.adapter}'", run.product, product_digest(endpoint, run.artifacts)),
        ("its statement", run.stated, statement_digest(statement)),
    ):
        if said != found:
            raise WrongUse(f"{what} differs on this worker from where the plan was read; install the same files there")


def executable_digest() -> str:
    """The digest of the compiled mutants. Raises ``WrongUse`` if they are not here."""
    try:
        return hashlib.sha256(COMMAND.read_bytes()).hexdigest()
    except OSError:
        raise WrongUse(
            f"'{COMMAND.name}' is a compiled part of ucm-cts, and this installation has none: {HOW_TO_COMPILE}"
        ) from None


def check_trial(trial: Trial | GeneratedTrial) -> None:
    """Raise ``WrongUse`` unless suite and subjects are here what they were where the plan was read."""
    check_suite(trial.suite, bundled_digest())
    if isinstance(trial, Trial) and trial.executable and trial.executable != executable_digest():
        raise WrongUse(
            "the compiled mutants differ on this worker from those where the plan was read; install the same ones"
        )


def check_suite(said: str, found: str) -> None:
    """Raise ``WrongUse`` if the suite here has another digest."""
    if said != found:
        raise WrongUse("this worker has another build of ucm-cts than the one that read the plan; install the same one")


def _digest(value: object) -> str:
    return hashlib.sha256(msgspec.json.encode(value, order="deterministic")).hexdigest()
