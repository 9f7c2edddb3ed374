"""Stand-ins for scenarios in which no body executes and nothing interacts: they record nothing, which makes judging cheaper."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.reference_models.model.executions import BusinessCall, Execution, Executions
from ucm_cts.reference_models.model.interactions import Interactions
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.method_calls import Delivery
from ucm_cts.reference_models.model.runtime import Container

_NOTHING = Execution(t.Enter(0, 0, 0, "", 0, "exchange"), None)


class NoExecutions(Executions):
    """The executions of a scenario without policies: nothing is recorded and no call waits."""

    def begin(self, enter: t.Enter, call: BusinessCall | None) -> Execution:
        """Nothing is recorded."""
        return _NOTHING

    def made(self, call: BusinessCall) -> None:
        """Nothing is recorded."""

    def start_up(self, event: t.Enter | t.Exit) -> None:
        """Nothing is recorded."""

    def answered(self, call: BusinessCall) -> Execution | None:
        """Nothing is recorded."""
        return None

    def claimed(self, call: BusinessCall, other: BusinessCall, enter: t.Enter) -> None:
        """Nothing is recorded."""

    def innermost(self, thread: int) -> Execution | None:
        """Nothing is recorded."""
        return None

    def end(self, exit_: t.Exit) -> Execution | None:
        """Nothing is recorded."""
        return None

    def hold(self, event: t.Held) -> None:
        """Nothing is recorded."""

    def open(self, event: t.Opened) -> None:
        """Nothing is recorded."""

    def settle(self, event: t.Settled) -> None:
        """Nothing is recorded."""


class NoInteractions(Interactions):
    """The interactions of a scenario without interfaces and policies: nothing is recorded."""

    def improper(self, container: Container | None = None) -> list[LinkState]:
        """There are no links."""
        return []

    def operate(self, step: s.Step, begin: t.Call) -> None:
        """Nothing is recorded."""

    def operated(self, end: t.Return | t.Raise) -> None:
        """Nothing is recorded."""

    def request(self, event: t.Request, business: BusinessCall) -> None:
        """Nothing is recorded."""

    def enter(self, event: t.Enter) -> Delivery | None:
        """Nothing is recorded."""
        return None

    def exit(self, event: t.Exit) -> None:
        """Nothing is recorded."""

    def push(self, event: t.Pushed) -> None:
        """Nothing is recorded."""

    def wait(self, event: t.Timeout) -> None:
        """Nothing is recorded."""

    def hold(self, event: t.Held) -> None:
        """Nothing is recorded."""

    def open(self, event: t.Opened) -> None:
        """Nothing is recorded."""

    def settle(self, event: t.Settled) -> None:
        """Nothing is recorded."""

    def pause(self, event: t.Paused) -> None:
        """Nothing is recorded."""
