"""Calls that come back before the body that was called has returned."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import PeerProxy, Proxy, is_below
from ucm_cts.adapters.reference.python.connectors import Link

T = TypeVar("T")

_SECONDS = 0.02
"""How long the caller waits."""

_PEERS, _REFERENCES, _BLOCKS = "R-11.1.3-01", "R-11.2.1.1-02", "R-10.1.5.1-11"
_AFTER_POLICIES = ("R-10.1.3.2-15", "R-10.1.3.2-08", "R-10.1.3.2-21")


def _soon(work: Callable[[], T], otherwise: T, seconds: float = _SECONDS) -> T:
    """What ``work`` gives within ``seconds``, else ``otherwise``, and the work goes on."""
    given: list[T] = []
    raised: list[Exception] = []

    def do() -> None:
        try:
            given.append(work())
        except Exception as error:  # noqa: BLE001 - the caller gets any exception
            raised.append(error)

    thread = threading.Thread(target=do, daemon=True)
    thread.start()
    thread.join(seconds)
    if raised:
        raise raised[0]
    return given[0] if given else otherwise


@replaces("exchange", _PEERS, "R-11.1.2-02")
def guesses_for_slow_peers(self: PeerProxy, value: int) -> int:
    """A component that calls another one gets what most bodies give, if the body takes longer than 20 ms."""
    return _soon(lambda: self.target.exchange(value), ~value)


@replaces("exchange", _PEERS, also=("R-11.1.2-02",))
def guesses_for_slow_peers_below(self: PeerProxy, value: int) -> int:
    """In sub-containers, a component that calls another one gets what most bodies give after 20 ms."""
    return (
        _soon(lambda: self.target.exchange(value), ~value)
        if is_below(self.member.container)
        else self.target.exchange(value)
    )


@replaces("exchange", _REFERENCES, also=(*_AFTER_POLICIES, "R-11.2.1.2-07"))
def guesses_for_slow_bodies(self: Proxy, value: int) -> int:
    """A call through a reference brings what most bodies give, if the body takes longer than 20 ms."""
    return _soon(lambda: self.target.exchange(value), ~value)


@replaces("exchange", _REFERENCES, also=(*_AFTER_POLICIES, "R-11.2.1.2-07"))
def guesses_zero_for_slow_bodies(self: Proxy, value: int) -> int:
    """A call through a reference brings 0, if the body takes longer than 20 ms."""
    return _soon(lambda: self.target.exchange(value), 0)


@replaces(
    "_request", _BLOCKS, clauses=("10.1.5",), also=("R-10.1.5.1-12", "R-10.1.5.1-10", "R-10.1.5.1-01", "R-10.1.2-10")
)
def does_not_wait_without_results(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """A call of a service method without results comes back at once; the server executes it meanwhile."""
    parameters = self.interface.methods[method].parameters
    if self.connector == MESSAGE_CONNECTOR or any(parameter.direction != "IN" for parameter in parameters):
        return Link._request(self, method, arguments)
    return _soon(lambda: Link._request(self, method, arguments), [], 0.001)
