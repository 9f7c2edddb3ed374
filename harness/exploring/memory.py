"""Remembered failures: one scenario for each cause, in the user's and shared databases of hypothesis.

The scenario itself is kept, not its draws, so that later versions of hypothesis and of the writer can read it.
"""

from __future__ import annotations

import importlib
import os
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, cast

import msgspec

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.incident_causes import IncidentCause, cause_of_incident
from ucm_cts.harness.results.incidents import finding_of_incident, is_waiting
from ucm_cts.harness.results.tally import cause_of
from ucm_cts.harness.results.values import Execution, FrameworkReport, IncidentKind, IncidentReport
from ucm_cts.reference_models.findings import Finding

if TYPE_CHECKING:
    from hypothesis.database import ExampleDatabase

READ_ONLY = "readonly:"
FORMS = f"a folder, {READ_ONLY}folder, or package.module:NAME of a hypothesis ExampleDatabase"

_OBJECT = re.compile(r"[A-Za-z_][\w.]*:[A-Za-z_]\w*")


Identity = tuple[str, str, str, str]
"""The key by which two remembered failures are the same."""


class Remembered(Value, frozen=True):
    """A failure, or an incident that breaks no requirement.

    ``requirement``: its id; empty for an incident.
    ``rule``: the property; for an incident its kind.
    ``cause``: the cause; for an incident its detail.
    ``observed``: what was observed.
    ``scenario``: the shortest one that showed it.
    ``operation``: the operation in progress, for an incident.
    """

    requirement: str
    rule: str
    cause: str
    observed: str
    scenario: Scenario
    operation: str = ""

    @classmethod
    def of_finding(cls, finding: Finding, scenario: Scenario) -> Remembered:
        """A requirement that was broken."""
        return cls(*cause_of(finding), finding.observed, scenario)

    @classmethod
    def of_incident(cls, execution: Execution) -> Remembered:
        """An incident that breaks no requirement."""
        assert execution.incident is not None
        kind, detail, operation, _ = cause_of_incident(execution)
        return cls("", kind, detail, one_line(execution.incident.detail), execution.scenario, operation)

    @property
    def identity(self) -> Identity:
        """The key by which two failures are the same."""
        return self.requirement, self.rule, self.cause, self.operation

    @property
    def incident(self) -> IncidentCause | None:
        """The cause, if it is an incident."""
        kind = cast(IncidentKind, self.rule)
        return IncidentCause(kind, self.cause, self.operation) if not self.requirement else None


class Memory:
    """The failures of one ``product`` under one ``profile``, in ``database``."""

    def __init__(self, database: ExampleDatabase, product: str, profile: str) -> None:
        self._database = database
        self._key = f"ucm-cts explore 1: {profile}, {product}".encode()
        self.unreadable = 0

    def recall(self) -> list[Remembered]:
        """The remembered failures, the shortest scenario of each cause: incidents, then requirements in their order.

        An entry that cannot be read, perhaps of another version, stays and counts as ``unreadable``.
        """
        entries = self._entries()
        self.unreadable = sum(entry is None for _, entry in entries)
        shortest: dict[Identity, Remembered] = {}
        for _, entry in sorted(entries, key=lambda item: (len(item[0]), item[0])):
            if entry is not None:
                shortest.setdefault(entry.identity, entry)
        return [shortest[cause] for cause in sorted(shortest)]

    def remember(self, failure: Remembered) -> None:
        """Keep ``failure`` instead of longer ones of the same cause."""
        value = msgspec.json.encode(failure)
        self._database.save(self._key, value)
        for known, entry in self._entries():
            if entry is not None and entry.identity == failure.identity and known != value:
                self._database.delete(self._key, known)

    def remember_first(self, failure: Remembered) -> None:
        """Keep ``failure`` unless one of the same cause is kept."""
        if all(entry is None or entry.identity != failure.identity for _, entry in self._entries()):
            self._database.save(self._key, msgspec.json.encode(failure))

    def remember_all(self, report: FrameworkReport, named: tuple[str, ...] = ("",)) -> None:
        """Keep the failures of ``report`` whose scenarios have names that begin with one of ``named``."""
        for result in report.requirements:
            for failed in result.findings:
                shown_by = failed.execution
                if shown_by is not None and not failed.unstable and shown_by.name.startswith(named):
                    self.remember(Remembered.of_finding(failed.finding, shown_by.scenario))
        for _, item in mishaps(report):
            if item.incident.kind == "unreachable" or not item.execution.name.startswith(named):
                continue
            if finding_of_incident(item.execution) is None:
                self.remember(Remembered.of_incident(item.execution))

    def forget(self, cause: Identity) -> None:
        """Forget ``cause``. Entries of read-only databases stay."""
        for known, entry in self._entries():
            if entry is not None and entry.identity == cause:
                self._database.delete(self._key, known)

    def _entries(self) -> list[tuple[bytes, Remembered | None]]:
        return [(value, _read(value)) for value in set(self._database.fetch(self._key))]


def mishaps(report: FrameworkReport) -> list[tuple[int, IncidentReport]]:
    """The numbered incidents, without scenarios left out and without calls that may wait for a start that never comes.

    Once such calls have been seen waiting, a hang of which nothing more is known is taken for another one.
    """
    waiting = [is_waiting(item.execution) for item in report.incidents]
    return [
        (number, item)
        for number, item in enumerate(report.incidents)
        if item.incident.kind != "untried"
        and not waiting[number]
        and not (any(waiting) and item.incident.kind == "hang" and not item.execution.trace)
    ]


def _read(value: bytes) -> Remembered | None:
    try:
        return msgspec.json.decode(value, type=Remembered)
    except (msgspec.DecodeError, ValueError):
        return None


def open_databases(texts: Sequence[str]) -> ExampleDatabase:
    """The databases that ``texts`` name, as one: failures are written to all writable ones.

    Raises ``WrongUse`` if one of them is none, or cannot be used.
    """
    from hypothesis.database import MultiplexedDatabase

    databases = [_open(text) for text in texts]
    return databases[0] if len(databases) == 1 else MultiplexedDatabase(*databases)


def _open(text: str) -> ExampleDatabase:
    from hypothesis.database import DirectoryBasedExampleDatabase, ReadOnlyDatabase

    if not text.removeprefix(READ_ONLY).strip():
        raise WrongUse(f"'{text}' names no database; a database is {FORMS}")
    if text.startswith(READ_ONLY):
        folder = Path(text.removeprefix(READ_ONLY))
        if not folder.is_dir():
            raise WrongUse(f"there is no folder '{folder}' to read failures from; a database is {FORMS}")
        return ReadOnlyDatabase(DirectoryBasedExampleDatabase(folder))
    if _OBJECT.fullmatch(text):
        return _load(text)
    folder = Path(text)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise WrongUse(f"failures cannot be kept in '{text}': {error.strerror}; a database is {FORMS}") from None
    if not os.access(folder, os.R_OK | os.W_OK | os.X_OK):
        raise WrongUse(
            f"failures cannot be kept in '{text}': Permission denied; write {READ_ONLY}{text} to only read it"
        )
    return DirectoryBasedExampleDatabase(folder)


def _load(text: str) -> ExampleDatabase:
    from hypothesis.database import ExampleDatabase

    module, _, name = text.partition(":")
    if os.getcwd() not in sys.path:
        sys.path.insert(0, os.getcwd())
    try:
        found = getattr(importlib.import_module(module), name)
    except Exception as error:  # noqa: BLE001 - a user's module may raise anything
        raise WrongUse(f"the database '{text}' cannot be loaded: {type(error).__name__}: {error}") from None
    if not isinstance(found, ExampleDatabase):
        raise WrongUse(f"'{text}' is a {type(found).__name__} and no hypothesis ExampleDatabase; a database is {FORMS}")
    return found
