"""The vendor's statement: which parts are claimed and which readings taken (ICS), which times and tolerances hold (IXIT).

What the vendor does not state is as in ``default_statement``: all of 10.1 is claimed, nothing of 10.2 to 10.5, and the first value of
every option holds.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import load_capabilities, load_options
from ucm_cts.reference_models.model.ics import TOLERANCES, Ics

HOOKS = ("transport-fault", "connector-fault", "trace-sink", "virtual-time")
"""Options by which a vendor claims what the adapter offers for tests only; without it something stays undecided."""

IMPOSSIBLE = "impossible"
"""The value of such an option by which a vendor declares that the product has nothing to test there."""


@dataclass(frozen=True)
class Quantity:
    """A value of the IXIT: its default, its unit, its meaning, and its greatest and least sensible value."""

    default: float
    unit: str
    text: str
    greatest: float = 3_600_000
    least: float = 0


HOSTS_AT_ONCE = "hosts-at-once"
"""The quantity that says how many hosts a run may have at once."""

IXIT: Mapping[str, Quantity] = {
    HOSTS_AT_ONCE: Quantity(
        1,
        "hosts",
        "so many processes with the product may work at once; scenarios that wait then do so side by side",
        greatest=64,
        least=1,
    ),
    "patience": Quantity(
        2000, "ms", "within this time comes what comes by itself: runs, messages, records, waiting calls", least=1
    ),
    "clock-tolerance": Quantity(
        TOLERANCES["clock-tolerance"], "ms", "by so much a reading of local time may differ from the host's clock"
    ),
    "clock-rate": Quantity(
        TOLERANCES["clock-rate"], "percent", "by so much of the time passed local time may be faster or slower", 100
    ),
    "synchronization-tolerance": Quantity(
        TOLERANCES["synchronization-tolerance"], "ms", "by so much synchronised clocks may differ"
    ),
    "epoch-tolerance": Quantity(
        TOLERANCES["epoch-tolerance"], "ms", "with clock-epoch = unix: local time is so close to the calendar"
    ),
    "error-known-within": Quantity(
        TOLERANCES["error-known-within"], "ms", "with comm-error = eventually: after this time a break is known"
    ),
    "timer-granularity": Quantity(
        TOLERANCES["timer-granularity"],
        "ms",
        "by so much timers (10.3) and executions by offset and period (10.5) may be early",
        1000,
    ),
    "timer-lateness": Quantity(
        TOLERANCES["timer-lateness"],
        "ms",
        "by so much timers (10.3) and executions by offset and period (10.5) may be late",
    ),
}
"""Times and tolerances that a vendor may declare."""


class Statement(Value, frozen=True):
    """The statement (ICS and IXIT) of one product.

    ``product``: its name; empty where the statement names none.
    ``version``: its version.
    ``profiles``: the profiles that it is for.
    ``capabilities``: every capability, claimed or not.
    ``readings``: the reading of every option.
    ``ixit``: every quantity.
    ``models``: the framework's own core models, as written in the statement.
    ``source``: the file; empty without one.
    ``folder``: the folder that ``models`` are relative to.
    """

    product: str
    version: str
    profiles: tuple[str, ...]
    capabilities: dict[str, bool]
    readings: dict[str, str]
    ixit: dict[str, float]
    models: tuple[str, ...] = ()
    source: str = ""
    folder: str = "."

    @property
    def ics(self) -> Ics:
        """The part that properties need."""
        return Ics(self.readings, {name: value for name, value in self.ixit.items() if name in TOLERANCES})

    @property
    def hosts_at_once(self) -> int:
        """How many hosts of the product may work at once."""
        return int(self.ixit[HOSTS_AT_ONCE])

    @property
    def model_paths(self) -> tuple[Path, ...]:
        """Where the framework's own core models are."""
        return tuple(Path(self.folder) / model for model in self.models)

    @property
    def declared(self) -> tuple[str, ...]:
        """Every reading, as ``option=value``."""
        return tuple(f"{option}={value}" for option, value in self.readings.items())

    def value_of(self, name: str) -> str:
        """What is stated of ``name``, a capability or an option."""
        return self.readings[name] if name in self.readings else str(self.capabilities[name]).lower()

    @property
    def extensions(self) -> tuple[str, ...]:
        """The parts of 10.2 to 10.5 that are claimed."""
        return tuple(
            c.id for c in load_capabilities().capabilities if c.profile == "extensions" and self.capabilities[c.id]
        )

    def meets(self, need: str) -> bool:
        """Is ``need`` claimed (a capability) or declared (a reading as ``option=value``, with ``|`` between permitted values)?"""
        option, _, values = need.partition("=")
        return self.readings[option] in values.split("|") if values else self.capabilities[need]


@functools.cache
def default_statement() -> Statement:
    """The statement that holds when the vendor states nothing."""
    return Statement(
        product="",
        version="",
        profiles=tuple(PARTS),
        capabilities={c.id: c.profile == "core" for c in load_capabilities().capabilities},
        readings={option: values[0] for option, values in load_options().items()},
        ixit={name: quantity.default for name, quantity in IXIT.items()},
    )
