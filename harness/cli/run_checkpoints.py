"""Checkpoints of ``ucm-cts run --repeat``: the report of each run that has ended is kept, so that ``--resume`` can go on."""

from __future__ import annotations

import hashlib

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.results.foreign import clean_report
from ucm_cts.harness.results.values import FrameworkReport

CHECKPOINTS = "runs/run-*.json"
"""The pattern of their files in the folder of ``--out``; they are removed when the series is complete."""


class Checkpoint(Value, frozen=True):
    """One run that has ended. ``measured`` is the digest of what all runs of its series have in common."""

    measured: str
    report: FrameworkReport


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
        try:
            content = msgspec.json.encode(Checkpoint(self._measured, report))
        except UnicodeEncodeError:  # a framework's text with lone surrogates
            content = msgspec.json.encode(Checkpoint(self._measured, clean_report(report)))
        try:
            self._folder.save({_name(number): content}, (CHECKPOINTS,) if number == 1 else ())
        except (OSError, WrongUse) as problem:
            console.say(f"run {number} cannot be kept for --resume: {getattr(problem, 'strerror', None) or problem}")

    def read(self, seed: int | None) -> list[FrameworkReport]:
        """The runs of an interrupted series, from the first one on. Raises ``WrongUse`` if there are none, or if they are
        not what would be measured now; ``seed`` is that of the first run, None for any.
        """
        files = self._folder.read(CHECKPOINTS)
        reports: list[FrameworkReport] = []
        place = f"'{self._folder.path}'"
        while (content := files.get(_name(len(reports) + 1))) is not None:
            try:
                checkpoint = msgspec.json.decode(content, type=Checkpoint)
            except (msgspec.DecodeError, RecursionError):
                raise WrongUse(f"{place} holds runs of another version of ucm-cts; leave out --resume") from None
            if checkpoint.measured != self._measured:
                raise WrongUse(
                    f"the runs in {place} were of another suite, adapter, statement, selection or limits; "
                    "give the same options, or leave out --resume"
                )
            reports.append(checkpoint.report)
        if not reports:
            raise WrongUse(f"{place} holds no interrupted series of runs; leave out --resume")
        if seed is not None and reports[0].seed != seed:
            raise WrongUse(f"the runs in {place} began with seed {reports[0].seed}; leave out --seed, or --resume")
        return reports


def _name(number: int) -> str:
    return CHECKPOINTS.replace("*", str(number))
