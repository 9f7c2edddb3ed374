"""Reads a campaign plan: a TOML file with products, profiles, seeds, variants and self-tests (docs/campaigns.md)."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, TypeVar

import msgspec

from ucm_cts.harness.catalogue.documents import DocumentError, convert, read_toml
from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES, TOOLCHAIN_PROFILES
from ucm_cts.harness.hosting.host_watch import Limits
from ucm_cts.harness.purposes.systematic.purposes import MOST_EXTRA

LARGEST = 1 << 20
"""Bytes that a plan may have."""

MOST_SEEDS = 10_000
"""Seeds that one list may have."""

MOST_SECONDS = 86_400.0
"""The longest time that a setting can give."""

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,59}")

Seed = Annotated[int, msgspec.Meta(ge=0, lt=2**32)]
Seeds = Annotated[tuple[Seed, ...], msgspec.Meta(min_length=1, max_length=MOST_SEEDS)]


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True, rename="kebab"):
    """Base of the tables of a plan."""


class Settings(_Table, frozen=True):
    """What runs of a product, or of a variant of it, are like. None: as the product has it, or as usual.

    ``adapter``: as on the command line. ``statement``, ``known_failures``: paths, relative to the plan. ``artifacts``: further files of the
    product. The other fields are options of ``ucm-cts run``.
    """

    adapter: str | None = None
    statement: str | None = None
    known_failures: str | None = None
    artifacts: tuple[str, ...] | None = None
    profiles: tuple[str, ...] | None = None
    seeds: Seeds | None = None
    select: str | None = None
    systematic: Annotated[int, msgspec.Meta(ge=0, le=MOST_EXTRA)] | None = None
    virtual_time: bool | None = None
    sandbox: bool | None = None
    timeout: Annotated[float, msgspec.Meta(ge=0.1, le=MOST_SECONDS)] | None = None
    memory: Annotated[int, msgspec.Meta(ge=16)] | None = None
    incident_time: Annotated[float, msgspec.Meta(ge=0, le=MOST_SECONDS)] | None = None


class SelfTest(_Table, frozen=True):
    """The mutants and variants that are tried.

    ``names``: of bundled mutants and variants; None for all of them.
    ``generated``: how many generated mutants of the Python reference framework, the first ones in an order drawn by chance.
    ``seeds``: each subject is tried with each of them.
    ``quick``, ``whole``, ``real_time``: as the options of ``ucm-cts selftest``.
    """

    names: tuple[str, ...] | None = None
    generated: Annotated[int, msgspec.Meta(ge=0)] = 0
    seeds: Seeds = (1,)
    quick: bool = False
    whole: bool = False
    real_time: bool = False


class _Top(_Table, frozen=True):
    profiles: tuple[str, ...] = ("container",)
    seeds: Seeds = (1,)
    scenarios: Annotated[int, msgspec.Meta(ge=1)] = 200
    products: dict[str, Any] = {}
    self_test: dict[str, Any] | None = None


class _Product(Settings, frozen=True):
    variants: dict[str, Any] = {}


@dataclass(frozen=True)
class PlannedProduct:
    """A product, or a variant of it: its ``name`` (``product`` or ``product/variant``) and its settings, all of them given.

    ``line``: where the plan has it.
    """

    name: str
    line: int | None
    adapter: str
    statement: str
    known_failures: str
    artifacts: tuple[str, ...]
    profiles: tuple[str, ...]
    seeds: tuple[int, ...]
    select: str
    systematic: int
    virtual_time: bool
    sandbox: bool
    timeout: float
    memory: int
    incident_time: float


@dataclass(frozen=True)
class Plan:
    """A plan. ``scenarios``: about so many make one unit. ``line``: where the plan has the self-test."""

    path: Path
    scenarios: int
    products: tuple[PlannedProduct, ...]
    self_test: SelfTest | None
    line: int | None = None


def read_plan(path: Path) -> Plan:
    """The plan in the file at ``path``. Raises ``DocumentError``."""
    return _Reader(path).plan()


T = TypeVar("T", bound=_Table)


class _Reader:
    def __init__(self, path: Path) -> None:
        self.path = path
        self.document, self.lines = read_toml(path, LARGEST)

    def plan(self) -> Plan:
        top = self.table("", self.document, _Top)
        self.check_profiles("profiles", top.profiles)
        products = tuple(
            one for name, table in top.products.items() for one in self.product(f"products.{name}", name, table, top)
        )
        own = top.self_test
        self_test = self.table("self-test", own, SelfTest) if own is not None else None
        if not products and self_test is None:
            raise DocumentError(
                self.path, None, "plans nothing; name a product in a table [products.NAME], or write [self-test]"
            )
        return Plan(self.path, top.scenarios, products, self_test, self.lines.get("self-test"))

    def product(self, place: str, name: str, table: object, top: _Top) -> Iterator[PlannedProduct]:
        self.check_name(place, name)
        given = self.table(place, table, _Product)
        yield self.settled(place, name, top, given)
        for variant, other in given.variants.items():
            below = f"{place}.variants.{variant}"
            self.check_name(below, variant)
            yield self.settled(below, f"{name}/{variant}", top, self.table(below, other, Settings), given)

    def settled(self, place: str, name: str, top: _Top, *most_special_first: Settings) -> PlannedProduct:
        def chosen(field: str, usual: Any) -> Any:
            given = (getattr(settings, field) for settings in most_special_first)
            return next((value for value in given if value is not None), usual)

        line = self.line(place)
        adapter = chosen("adapter", "")
        if not adapter:
            raise DocumentError(
                self.path, line, f"{name} has no adapter; write adapter = \"...\", as for 'ucm-cts run'"
            )
        profiles = chosen("profiles", top.profiles)
        self.check_profiles(f"{place}.profiles", profiles)
        return PlannedProduct(
            name,
            line,
            adapter,
            statement=chosen("statement", ""),
            known_failures=chosen("known_failures", ""),
            artifacts=chosen("artifacts", ()),
            profiles=profiles,
            seeds=chosen("seeds", top.seeds),
            select=chosen("select", ""),
            systematic=chosen("systematic", 0),
            virtual_time=chosen("virtual_time", False),
            sandbox=chosen("sandbox", True),
            timeout=chosen("timeout", Limits.seconds),
            memory=chosen("memory", Limits.memory),
            incident_time=chosen("incident_time", Limits.incident_seconds),
        )

    def table(self, place: str, table: object, kind: type[T]) -> T:
        """``table`` as a ``kind``, with the line of what is wrong in it."""
        prefix = f"{place}." if place else ""
        if not isinstance(table, dict):
            raise DocumentError(
                self.path, self.line(place), f"{place} is a table: write [{place}] on a line of its own"
            )
        known = [field.encode_name for field in msgspec.structs.fields(kind)]
        for key in table:
            if key not in known:
                close = difflib.get_close_matches(key, known, 1)
                hint = f"did you mean '{close[0]}'?" if close else f"there is {', '.join(known)}"
                raise DocumentError(self.path, self.line(prefix + key), f"there is no key '{key[:60]}'; {hint}")
        lines = {f"$.{key}": line for key in table if (line := self.line(prefix + key)) is not None}
        return convert(self.path, table, kind, {"$": self.line(place) or 1} | lines)

    def line(self, place: str) -> int | None:
        """The line of ``place``, or of the table around it."""
        while place:
            if place in self.lines:
                return self.lines[place]
            below = next((line for known, line in self.lines.items() if known.startswith(f"{place}.")), None)
            if below is not None:
                return below
            place = place.rpartition(".")[0]
        return None

    def check_name(self, place: str, name: str) -> None:
        if not _NAME.fullmatch(name) or ".." in name:
            raise DocumentError(
                self.path,
                self.line(place),
                f"'{name[:60]}' is no name for a folder; use letters, digits, '-', '_' and '.'",
            )

    def check_profiles(self, place: str, profiles: Iterable[str]) -> None:
        for profile in profiles:
            if profile in TOOLCHAIN_PROFILES:
                problem = f"profile '{profile}' is of tool chains, and campaigns run frameworks"
            elif profile not in FRAMEWORK_PROFILES:
                problem = f"there is no profile '{profile[:60]}'"
            else:
                continue
            raise DocumentError(self.path, self.line(place), f"{problem}; there is {', '.join(FRAMEWORK_PROFILES)}")
