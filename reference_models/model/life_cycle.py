"""The life-cycle table as types: state × operation × condition → permitted outcomes and callbacks (11.2.3, 12.10).

The table itself is data, ``suite/life_cycle.yaml``; the harness loads it and hands it to the model, the properties, the
scenario generator, the documentation and the report.
"""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract.scenario import Hook
from ucm_cts.adapters.contract.value import Value

State = Literal["absent", "initialized", "configured", "ready"]
"""A component instance's state in the words of 11.2.3; ``absent`` before ``add_component`` and after removal."""

Answer = Literal["return", "NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR"]


class Outcome(Value, frozen=True):
    """One permitted way for an operation to go, seen from one component instance.

    ``callbacks`` is the sequence of callbacks the instance receives before the operation ends; ``on_disconnect*`` stands for
    one a live connection, a trailing ``?`` for at most one. Connectable callbacks count only for bodies that are Connectable.
    ``reading`` names the interpretation and the reading under which this outcome is permitted; empty if under all.
    """

    answer: tuple[Answer, ...]
    next: State
    callbacks: tuple[str, ...] = ()
    reading: str = ""


class Row(Value, frozen=True):
    """What may happen to an instance in ``state`` when ``operation`` meets ``condition``.

    ``requirement`` is the one that a forbidden answer violates. ``missing``, if given, is the one that a missing
    callback violates in this very row; otherwise the callback's duty says so.
    """

    operation: str
    state: State
    condition: str
    requirement: str
    outcomes: tuple[Outcome, ...]
    missing: str = ""

    @property
    def id(self) -> str:
        """The row's name, for instance ``ready/stop/started``."""
        return f"{self.state}/{self.operation}/{self.condition}"


class CallbackDuty(Value, frozen=True):
    """Which requirement a missing or an unexpected ``callback`` violates, for ``operations`` or, if empty, for all others."""

    callback: Hook
    missing: str
    unexpected: str
    operations: tuple[str, ...] = ()


class LifeCycleTable(Value, frozen=True):
    """The whole table.

    ``order`` is the requirement that callbacks in a wrong order violate, ``fragments`` the one that a fragment without
    on_init or on_startup violates.
    """

    rows: tuple[Row, ...]
    duties: tuple[CallbackDuty, ...]
    order: str
    fragments: str
