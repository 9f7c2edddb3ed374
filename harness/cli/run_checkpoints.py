"""Keeps the report of each run that has ended, and what the present one has measured so far, so that ``--resume`` can go on."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.execution.campaign_state import CampaignState
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.results.foreign import clean_report
from ucm_cts.harness.results.values import FrameworkReport

_RUNS, _PART = "runs/run-*.json", "runs/part.json"

CHECKPOINTS = (_RUNS, _PART)
"""Patterns of their files in the folder of ``--out``; they are removed when all runs are complete."""


class Checkpoint(Value, frozen=True):
    """One run that has ended, or (``state``) one that has not. ``measured`` is the digest of what all runs of its series have in common."""

    measured: str
    report: FrameworkReport | None = None
    state: CampaignState | None = None


class Checkpoints:
    """The checkpoints in one folder, of runs with the same suite, adapter, statement and options."""

    def __init__(self, folder: OutFolder, measured: tuple[object, ...]) -> None:
        """``measured`` is all that the runs of one series have in common."""
        self._folder = folder
        self._measured = hashlib.sha256(msgspec.json.encode(measured)).hexdigest()

    def keep(self, number: int, report: FrameworkReport, console: Output) -> None:
        """Keep the ``number``-th run (from 1). If that fails, say so; the run goes on.

        The first one replaces those of an earlier series.
        """
        instead_of = CHECKPOINTS if number == 1 else (_PART,)
        try:
            content = msgspec.json.encode(Checkpoint(self._measured, report))
        except UnicodeEncodeError:  # a framework's text with lone surrogates
            content = msgspec.json.encode(Checkpoint(self._measured, clean_report(report)))
        self._save({_name(number): content}, instead_of, console)

    def keep_part(self, number: int, state: CampaignState, console: Output) -> None:
        """Keep what the ``number``-th run (from 1) has measured so far."""
        try:
            content = msgspec.json.encode(Checkpoint(self._measured, state=state))
        except UnicodeEncodeError:
            cleaned = msgspec.structs.replace(state, report=clean_report(state.report))
            content = msgspec.json.encode(Checkpoint(self._measured, state=cleaned))
        self._save({_PART: content}, (_RUNS,) if number == 1 else (), console)

    def _save(self, files: dict[str, bytes], instead_of: Sequence[str], console: Output) -> None:
        try:
            self._folder.save(files, instead_of)
        except (OSError, WrongUse) as problem:
            console.say(f"nothing can be kept for --resume: {getattr(problem, 'strerror', None) or problem}")

    def read(self, seed: int | None) -> tuple[list[FrameworkReport], CampaignState | None]:
        """The runs of an interrupted series, from the first one on, and the state of the one that had not ended, if it is
        known. Raises ``WrongUse`` if there is nothing, or if it is not what would be measured now; ``seed`` is that of
        the first run, None for any.
        """
        files = {**self._folder.read(_RUNS), **self._folder.read(_PART)}
        reports: list[FrameworkReport] = []
        place = f"'{self._folder.path}'"
        while (content := files.get(_name(len(reports) + 1))) is not None:
            report = self._checkpoint(content).report
            if report is None:
                break
            reports.append(report)
        state = self._checkpoint(files[_PART]).state if _PART in files else None
        if not reports and state is None:
            raise WrongUse(f"{place} holds no interrupted run; leave out --resume")
        first = reports[0].seed if reports else state.report.seed if state is not None else 0
        if seed is not None and first != seed:
            raise WrongUse(f"the runs in {place} began with seed {first}; leave out --seed, or --resume")
        is_next = state is not None and state.report.seed == first + len(reports)
        return reports, state if is_next else None

    def _checkpoint(self, content: bytes) -> Checkpoint:
        place = f"'{self._folder.path}'"
        try:
            checkpoint = msgspec.json.decode(content, type=Checkpoint)
        except (msgspec.DecodeError, RecursionError):
            raise WrongUse(f"{place} holds runs of another version of ucm-cts; leave out --resume") from None
        if checkpoint.measured != self._measured:
            raise WrongUse(
                f"the runs in {place} were of another suite, adapter, statement, selection or limits; "
                "give the same options, or leave out --resume"
            )
        return checkpoint


def _name(number: int) -> str:
    return _RUNS.replace("*", str(number))
