"""Conclusions of properties: values that the monitor adds to the verdicts, and applies to the model."""

from __future__ import annotations

from collections.abc import Generator, Iterable
from typing import NamedTuple

from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.expected_callbacks import Fit
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import Member

Kept = str
"""The requirement of this id was kept, and its condition had really arisen."""


class Taken(NamedTuple):
    """The framework took reading ``value`` of ``option``."""

    option: str
    value: str


class Measured(NamedTuple):
    """An amount worth adding up over a run: how much effort was behind the verdicts."""

    what: str
    amount: int = 1


class Broken(NamedTuple):
    """An instance went a way that ``row`` of the life-cycle table forbids. Of permitted ways the ``Fit`` is the conclusion."""

    row: Row


class Suspended(NamedTuple):
    """The state of ``member`` is not known from now on, so properties are silent about it."""

    member: Member


Conclusion = Finding | Kept | Taken | Measured | Fit | Broken | Suspended
Conclusions = Iterable[Conclusion]
Concluded = Conclusion | Conclusions
"""What a property returns: one conclusion, or any number of them."""


def takes(runtime: ObservedRuntime, option: str, value: str) -> Generator[Taken, None, bool]:
    """Conclude that the framework took a reading; returns False if its vendor declared another one."""
    yield Taken(option, value)
    return runtime.ics.permits(option, value)
