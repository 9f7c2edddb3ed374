"""The vendor's statement, as far as properties need it: readings of unclear places, times and tolerances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

TOLERANCES: Mapping[str, float] = {
    "clock-tolerance": 20.0,
    "clock-rate": 1.0,
    "synchronization-tolerance": 20.0,
    "epoch-tolerance": 1000.0,
    "error-known-within": 500.0,
    "timer-granularity": 1.0,
    "timer-lateness": 100.0,
}
"""IXIT values that hold unless others are declared: milliseconds, ``clock-rate`` in percent."""

OBSERVED = "observed"
"""The value of an option that permits all readings."""


@dataclass(frozen=True)
class Ics:
    """``readings`` are the values declared of options of the interpretations, ``tolerances`` those of the IXIT.

    An option that is not declared has its first value, which the harness fills in.
    """

    readings: Mapping[str, str] = field(default_factory=dict)
    tolerances: Mapping[str, float] = field(default_factory=dict)

    def reading(self, option: str) -> str:
        """The value that holds of ``option``; ``observed`` if nothing is known of it."""
        return self.readings.get(option, OBSERVED)

    def permits(self, option: str, value: str) -> bool:
        """May the framework take reading ``value`` of ``option``, as far as its vendor has bound it?"""
        return self.reading(option) in (value, OBSERVED)

    def tolerance(self, name: str) -> float:
        """A declared time in milliseconds, or percentage. Raises ``KeyError`` for an unknown name."""
        return self.tolerances.get(name, TOLERANCES[name])
