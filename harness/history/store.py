"""The file with the history: a DuckDB database with a row for each run and for each verdict of it.

Several commands may append at once: each opens the file for a moment, and the others wait. A file that is no history is
never written to.
"""

from __future__ import annotations

import datetime
import hashlib
import os
import stat
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.json_report import ReportEntry, RequirementEntry
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Overall, Verdict

if TYPE_CHECKING:
    import duckdb

VERSION = 1
"""Of the tables below; a history of another version is refused."""

PATIENCE = 20.0
"""Seconds to wait while others have the file open."""

_COLUMNS = {
    "ucm_cts_history": "version INTEGER",
    "runs": "id VARCHAR PRIMARY KEY, product VARCHAR, version VARCHAR, profile VARCHAR, verdict VARCHAR, suite_version VARCHAR, "
    "seed VARCHAR, started VARCHAR, seconds DOUBLE, scenarios BIGINT, events BIGINT",
    "results": "run VARCHAR, requirement VARCHAR, clause VARCHAR, title VARCHAR, verdict VARCHAR, known BOOLEAN, unstable BOOLEAN, "
    "decides BOOLEAN, exercised BIGINT, seconds DOUBLE",
    "clauses": "run VARCHAR, clause VARCHAR, seconds DOUBLE",
}
"""The columns of each table."""


class Run(Value, frozen=True):
    """One run. ``id`` is the digest of its report, ``started`` a time in UTC, ``seconds`` what it took."""

    id: str
    product: str
    version: str
    profile: str
    verdict: Overall
    suite_version: str
    seed: str
    started: str
    seconds: float
    scenarios: int
    events: int


class Result(Value, frozen=True):
    """One verdict of a run. ``known``: all its failures are known; ``unstable``: it flipped; ``seconds``: what it cost."""

    run: str
    requirement: str
    clause: str
    title: str
    verdict: Verdict
    known: bool
    unstable: bool
    decides: bool
    exercised: int
    seconds: float


class ClauseCost(Value, frozen=True):
    """The seconds that a run spent on a clause."""

    run: str
    clause: str
    seconds: float


class History(Value, frozen=True):
    """All that a file holds; ``runs`` in the order in which they started."""

    runs: tuple[Run, ...]
    results: tuple[Result, ...]
    clauses: tuple[ClauseCost, ...]


def append(path: Path, reports: Sequence[ReportEntry]) -> list[bool]:
    """Keep ``reports`` of whole runs in the history at ``path``, which is made if it is not there; all of them or none.

    Returns of each whether it is new. Raises ``WrongUse``.
    """
    rows = [_rows(report) for report in reports]
    with _opened(path, writes=True) as connection:
        connection.execute("BEGIN")
        known = {id_ for (id_,) in connection.execute("SELECT id FROM runs").fetchall()}
        new = []
        for run, results, clauses in rows:
            new.append(run.id not in known)
            known.add(run.id)
            if new[-1]:
                for table, values in (("runs", [run]), ("results", results), ("clauses", clauses)):
                    _insert(connection, table, values)
        connection.execute("COMMIT")
    return new


def read(path: Path) -> History:
    """The history at ``path``. Raises ``WrongUse``."""
    if not os.path.lexists(path):
        raise WrongUse(f"there is no history '{path}'; name reports to begin one: ucm-cts history reports")
    with _opened(path, writes=False) as connection:
        return History(
            tuple(_read(connection, "runs", Run, "started, id")),
            tuple(_read(connection, "results", Result, "run, requirement")),
            tuple(_read(connection, "clauses", ClauseCost, "run, clause")),
        )


def _rows(report: ReportEntry) -> tuple[Run, list[Result], list[ClauseCost]]:
    content = msgspec.json.encode(report)
    id_ = hashlib.sha256(content).hexdigest()
    run = Run(
        id_,
        report.product,
        report.version,
        report.profile,
        report.verdict,
        report.suite_version,
        str(report.seed),
        _utc(report.started),
        report.seconds,
        report.scenarios,
        report.events,
    )
    costs = [ClauseCost(id_, clause, seconds) for clause, seconds in report.seconds_by_clause.items()]
    return run, [_result(id_, entry) for entry in report.requirements], costs


def _result(run: str, entry: RequirementEntry) -> Result:
    counted = [finding for finding in entry.findings if not finding.unstable]
    return Result(
        run,
        entry.id,
        entry.clause,
        entry.title,
        entry.verdict,
        known=bool(counted) and all(finding.waived for finding in counted),
        unstable=len(counted) < len(entry.findings),
        decides=entry.decides,
        exercised=entry.exercised,
        seconds=entry.seconds,
    )


def _utc(started: str) -> str:
    """``started`` in UTC, so that texts sort as times do. Raises ``WrongUse``."""
    try:
        moment = datetime.datetime.fromisoformat(started)
        return moment.astimezone(datetime.UTC).isoformat(timespec="milliseconds")
    except (ValueError, OverflowError):
        raise WrongUse(f"the report says that its run started '{one_line(started, 60)}', which is no time") from None


@contextmanager
def _opened(path: Path, writes: bool) -> Iterator[duckdb.DuckDBPyConnection]:
    """The database at ``path``, with the tables of a history. Every error of DuckDB is one line."""
    need("history", "a history")
    import duckdb

    try:
        connection = _connected(path, writes)
        try:
            _check(connection, path, writes)
            yield connection
        finally:
            connection.close()
    except duckdb.Error as error:
        what = one_line(str(error), 200)
        raise WrongUse(
            f"the history '{path}' cannot be {'written' if writes else 'read'}: {what}; move it away, or name another --database"
        ) from None
    except (msgspec.ValidationError, UnicodeDecodeError) as error:
        raise WrongUse(f"the history '{path}' is damaged: {error}; move it away, or name another --database") from None


def _connected(path: Path, writes: bool) -> duckdb.DuckDBPyConnection:
    import duckdb

    try:
        is_file = stat.S_ISREG(os.stat(path).st_mode)
    except FileNotFoundError:
        is_file = not os.path.islink(path)
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise WrongUse(f"the history '{path}' cannot be opened: {why}; name another --database") from None
    if not is_file:
        raise WrongUse(f"the history '{path}' is no file; name another --database")
    if not path.absolute().parent.is_dir():
        raise WrongUse(f"there is no folder '{path.parent}' for the history; make it, or name another --database")
    # a foreign file must not make this read or load anything else, and the path is absolute because some names are addresses
    config: dict[str, Any] = {"enable_external_access": "false", "autoinstall_known_extensions": "false"}
    began = time.monotonic()
    while True:
        try:
            return duckdb.connect(os.path.abspath(path), read_only=not writes, config=config)
        except duckdb.IOException as error:
            if "lock" not in str(error) or time.monotonic() - began > PATIENCE:
                raise
        time.sleep(0.05)


def _check(connection: duckdb.DuckDBPyConnection, path: Path, writes: bool) -> None:
    """Make the tables in a new file. Raises ``WrongUse`` for a database that is no history, or one of another version."""
    found = connection.execute("SELECT table_name FROM information_schema.tables").fetchall()
    tables = {name for (name,) in found}
    if not tables and writes:
        connection.execute("BEGIN")
        for table, columns in _COLUMNS.items():
            connection.execute(f"CREATE TABLE {table} ({columns})")
        connection.execute("INSERT INTO ucm_cts_history VALUES (?)", [VERSION])
        connection.execute("COMMIT")
        return
    base = {name for (name,) in connection.execute("SELECT table_name FROM duckdb_tables()").fetchall()}
    if tables != base or tables != _COLUMNS.keys():
        raise WrongUse(f"'{path}' is a database of something else; name another --database")
    versions = connection.execute("SELECT version FROM ucm_cts_history LIMIT 2").fetchall()
    if versions != [(VERSION,)]:
        which = one_line(str(versions[0][0] if versions else None), 20)
        raise WrongUse(
            f"'{path}' is a history of version {which}, and this ucm-cts has {VERSION}; name another --database"
        )


def _insert(connection: duckdb.DuckDBPyConnection, table: str, values: Sequence[Value]) -> None:
    """One statement for all rows; DuckDB takes columns as lists."""
    if not values:
        return
    names = values[0].__struct_fields__
    columns = [[getattr(value, name) for value in values] for name in names]
    unnested = ", ".join("unnest(?)" for _ in names)
    connection.execute(f"INSERT INTO {table} ({', '.join(names)}) SELECT {unnested}", columns)


def _read(connection: duckdb.DuckDBPyConnection, table: str, kind: type[Any], order: str) -> Iterator[Any]:
    names = kind.__struct_fields__
    for row in connection.execute(f"SELECT {', '.join(names)} FROM {table} ORDER BY {order}").fetchall():
        yield msgspec.convert(dict(zip(names, row, strict=True)), kind)
