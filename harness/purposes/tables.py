"""Tables of rows: test purposes (``suite/purposes``), and other lists of YAML files.

An item of a list with the key ``rows`` stands for as many items as there are rows, in each of which ``$name`` is replaced by
the value of ``name`` in the row, or in the row of an item around it. A text that is nothing but ``$name`` becomes that value,
whatever its type; a key with the value null is left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from string import Template
from typing import Any, TypeVar

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import convert, read_lines
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.purposes.scripts import TestPurpose

T = TypeVar("T")


class _NamedScenario(Scenario, frozen=True, kw_only=True):
    name: str


class _Purpose(Value, frozen=True):
    """A ``TestPurpose`` as it is written, with the names of its scenarios beside their parts."""

    id: str
    clause: str
    text: str
    requirements: tuple[str, ...]
    scenarios: tuple[_NamedScenario, ...]
    under: tuple[str, ...] = ()


def purposes_of(table: str, directory: Path = SUITE / "purposes") -> list[TestPurpose]:
    """The test purposes of ``<table>.yaml``. Raises ``DocumentError``, and ``KeyError`` for a name that no row has."""
    return [
        TestPurpose(p.id, p.clause, p.text, p.requirements, tuple(map(_scenario, p.scenarios)), under=p.under)
        for p in read_table(directory / f"{table}.yaml", _Purpose)
    ]


def read_table(path: Path, type_: type[T]) -> list[T]:
    """The list in the file at ``path``, its rows written out. Raises as ``purposes_of`` does."""
    written, _ = read_lines(path)
    return convert(path, _filled(written, {}), list[type_], lines={})  # type: ignore[valid-type] # places have no line then


def _scenario(named: _NamedScenario) -> tuple[str, Scenario]:
    return named.name, Scenario(named.components, named.steps, named.patience, named.interfaces, named.may_stay)


def _filled(value: Any, row: Mapping[str, Any]) -> Any:
    """``value`` with the values of ``row`` in it, its own rows written out."""
    if isinstance(value, dict):
        filled = {_filled(key, row): _filled(inner, row) for key, inner in value.items()}
        return {key: inner for key, inner in filled.items() if inner is not None}
    if isinstance(value, list):
        return [one for item in value for one in _items(item, row)]
    if isinstance(value, str) and value.startswith("$") and value[1:] in row:
        return row[value[1:]]
    return Template(value).substitute(row) if isinstance(value, str) else value


def _items(item: Any, row: Mapping[str, Any]) -> Iterator[Any]:
    if not isinstance(item, dict) or "rows" not in item:
        yield _filled(item, row)
        return
    pattern = {key: value for key, value in item.items() if key != "rows"}
    rows = item["rows"]
    for own in _filled(rows, row) if isinstance(rows, str) else rows:
        yield _filled(pattern, {**row, **own})
