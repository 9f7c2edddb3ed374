"""Statements as files: the TOML that ``ucm-cts ics`` writes, a vendor edits and ``--ics`` takes (docs/statement.md)."""

from __future__ import annotations

import difflib
import math
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any, NoReturn, Protocol

from ucm_cts.harness.catalogue.documents import DocumentError, read_toml
from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import load_capabilities, load_options
from ucm_cts.harness.hosting.locate import WrongUse, published_statement
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.statement import IXIT, Statement, default_statement

LARGEST = 256 * 1024
"""Bytes a statement may have."""


def stated_by(path: Path | None, adapter: str, sandbox: bool = True) -> Statement:
    """The statement in the file at ``path``, else the one published with ``adapter``, else the default.

    Raises ``DocumentError``.
    """
    path = path or published_statement(adapter, sandbox)
    return read_statement(path) if path is not None else default_statement()


class Identity(Protocol):
    """The identity of a product: an adapter's welcome, or the description of a tool chain."""

    @property
    def product(self) -> str: ...

    @property
    def version(self) -> str: ...


def check_subject(statement: Statement, identity: Identity, profile: str) -> None:
    """Check that ``statement`` is about the product ``identity`` and about ``profile``. Raises ``WrongUse`` if not."""
    for what, stated, actual in (
        ("product", statement.product, identity.product),
        ("version", statement.version, identity.version),
    ):
        if stated and one_line(stated) != one_line(actual):
            raise WrongUse(
                f"{_place(statement, what)} is about {what} '{one_line(stated, 80)}', and the product under test says it is "
                f"'{one_line(actual, 80)}'; correct the statement, or leave its {what} out"
            )
    if profile not in statement.profiles:
        claimed = ", ".join(statement.profiles) or "none"
        raise WrongUse(
            f"{_place(statement, 'profiles')} does not claim profile '{profile}'; it claims {claimed}; run one of these with "
            f"--profile, or add '{profile}' to profiles"
        )

    if profile == "extensions" and not statement.extensions:
        parts = [c.id for c in load_capabilities().capabilities if c.profile == "extensions"]
        raise WrongUse(
            f"{statement.source or 'the default statement'} claims no part of profile extensions; claim one in a statement, under "
            f"[capabilities], as '{parts[0]} = true' (there is {', '.join(parts)}): 'ucm-cts ics' asks the adapter for them"
        )


def _place(statement: Statement, key: str) -> str:
    """File and line of ``key``."""
    path = Path(statement.folder) / statement.source
    try:
        line = read_toml(path, LARGEST)[1].get(key)
    except DocumentError:
        line = None  # a statement that was made otherwise, or is gone
    return f"{statement.source}:{line}" if line else statement.source


def read_statement(path: Path) -> Statement:
    """The statement in the file at ``path``. Raises ``DocumentError`` if the file is wrong."""
    return _Reader(path).statement()


class _Reader:
    """Reads one file; an error names the line and the permitted values."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.document, self.lines = read_toml(path, LARGEST)
        self.default = default_statement()

    def statement(self) -> Statement:
        top = ("product", "version", "profiles", "capabilities", "readings", "ixit", "models")
        for key in self.document:
            self.known(key, key, top, "table or key")
        readings = dict(self.readings())
        models = tuple(self.models())
        if models and readings.get("core-models") == "built-in":
            self.wrong(
                "models.core", "core-models = built-in says that there are none; declare shipped, or leave them out"
            )
        return Statement(
            product=self.text("product"),
            version=self.text("version"),
            profiles=tuple(self.profiles()),
            capabilities=self.default.capabilities | dict(self.capabilities()),
            readings=self.default.readings | readings,
            ixit=self.default.ixit | dict(self.quantities()),
            models=models,
            source=self.path.name,
            folder=str(self.path.parent),
        )

    def text(self, key: str) -> str:
        given = self.document.get(key, "")
        if not isinstance(given, str):
            self.wrong(key, f"{key} is a text, in quotes")
        return given

    def profiles(self) -> Iterator[str]:
        for profile in self.strings(self.document.get("profiles", list(self.default.profiles)), "profiles"):
            self.known(profile, "profiles", PARTS, "profile")
            yield profile

    def capabilities(self) -> Iterator[tuple[str, bool]]:
        for name, claimed in self.table("capabilities").items():
            place = f"capabilities.{name}"
            self.known(name, place, self.default.capabilities, "capability")
            if not isinstance(claimed, bool):
                self.wrong(place, f"{name} is claimed or not: write true or false")
            yield name, claimed

    def readings(self) -> Iterator[tuple[str, str]]:
        options = load_options()
        for option, value in self.table("readings").items():
            place = f"readings.{option}"
            self.known(option, place, options, "option")
            if not isinstance(value, str) or value not in options[option]:
                given = f"'{_short(value)}'" if isinstance(value, str) else "no text in quotes"
                self.wrong(place, f"{option} is {given}; it can be {_list(options[option])}")
            yield option, value

    def quantities(self) -> Iterator[tuple[str, float]]:
        for name, value in self.table("ixit").items():
            place = f"ixit.{name}"
            self.known(name, place, IXIT, "quantity")
            quantity = IXIT[name]
            number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
            if not number or not quantity.least <= value <= quantity.greatest:
                self.wrong(
                    place, f"{name} is a number of {quantity.unit} from {quantity.least:g} to {quantity.greatest:g}"
                )
            yield name, float(value)

    def models(self) -> Iterator[str]:
        table = self.table("models")
        for key in table:
            self.known(key, f"models.{key}", ("core",), "key")
        yield from self.strings(table.get("core", []), "models.core")

    def table(self, name: str) -> dict[str, Any]:
        given = self.document.get(name, {})
        if not isinstance(given, dict):
            self.wrong(name, f"{name} is a table: write [{name}] on a line of its own, and what belongs to it below")
        return given

    def strings(self, given: object, place: str) -> list[str]:
        if not isinstance(given, list) or not all(isinstance(item, str) and "\0" not in item for item in given):
            self.wrong(place, f"{place.rpartition('.')[2]} is a list of texts in quotes, in brackets")
        return given

    def known(self, name: str, place: str, there: Collection[str], what: str) -> None:
        if name not in there:
            close = difflib.get_close_matches(name[:100], there, 1)
            hint = f"did you mean '{close[0]}'?" if close else f"there is {_list(there)}"
            self.wrong(place, f"there is no {what} '{_short(name)}'; {hint}")

    def wrong(self, place: str, problem: str) -> NoReturn:
        line = self.lines.get(place) or self.lines.get(place.partition(".")[0])
        raise DocumentError(self.path, line, problem)


def _list(names: Collection[str]) -> str:
    return ", ".join(list(names)[:12]) + (", ..." if len(names) > 12 else "")


def _short(text: object) -> str:
    return one_line(str(text), 60)
