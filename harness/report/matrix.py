"""The matrix of what is published: products and versions × profiles. The site and ``results/README.md`` show the same one."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from ucm_cts.harness.catalogue.profiles import PROFILES
from ucm_cts.harness.report.order import SEALS, Shown, count
from ucm_cts.harness.results.tally import Counted
from ucm_cts.harness.results.values import Overall


class Held(Protocol):
    """What a cell is made of: the result of one product in one profile."""

    @property
    def product(self) -> str: ...
    @property
    def version(self) -> str: ...
    @property
    def profile(self) -> str: ...


H = TypeVar("H", bound=Held)


@dataclass(frozen=True)
class Row(Generic[H]):
    """One version of one product: what there is of each profile of the matrix, None where there is nothing."""

    product: str
    version: str
    cells: tuple[H | None, ...]

    @property
    def held(self) -> list[H]:
        """The cells that hold something."""
        return [cell for cell in self.cells if cell is not None]


@dataclass(frozen=True)
class Matrix(Generic[H]):
    """``profiles`` are the columns: those that any result has."""

    profiles: tuple[str, ...]
    rows: tuple[Row[H], ...]


def matrix(held: Iterable[H], row_of: Callable[[H], object] = lambda one: (one.product, one.version)) -> Matrix[H]:
    """The matrix of ``held``, rows in the order of their first results. Of several results in one cell the last one counts.
    Results share a row if ``row_of`` gives the same for them.
    """
    rows: dict[object, dict[str, H]] = {}
    for one in held:
        rows.setdefault(row_of(one), {})[one.profile] = one
    found = {profile for row in rows.values() for profile in row}
    profiles = tuple(profile for profile in PROFILES if profile in found)
    return Matrix(
        profiles,
        tuple(
            Row(last.product, last.version, tuple(row.get(profile) for profile in profiles))
            for row in rows.values()
            for last in [next(reversed(row.values()))]
        ),
    )


def in_words(verdict: Overall, requirements: Sequence[Counted]) -> tuple[str, str]:
    """What a cell says: the verdict with its symbol, and what it is counted from."""
    return f"{SEALS[verdict]} {verdict}", tally(count(requirements))


def tally(counts: dict[Shown, int]) -> str:
    """``3 fail, 85 pass``: what there is of each verdict, the worst first."""
    return ", ".join(f"{number} {verdict}" for verdict, number in counts.items() if number)
