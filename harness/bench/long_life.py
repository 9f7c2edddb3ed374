"""One scenario with a life of any length.

Two components are connected, started, called, stopped and disconnected, again and again. The events are those of the Python reference framework, repeated for each round.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Call, Event, Return, Trace
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Performance
from ucm_cts.adapters.sdk.python.recorder import Recorder

_SERVER, _CLIENT = "server", "client"
_PROVIDED, _REQUIRED = "in_api", "out_api"

_BEGINNING: tuple[s.Step, ...] = (
    s.AddComponent(_SERVER),
    s.AddComponent(_CLIENT),
    s.GetPortElement(_SERVER, _PROVIDED, "api"),
    s.GetPortElement(_CLIENT, _PROVIDED, "entry"),
    s.Connect(_CLIENT, _REQUIRED, "api", "link"),
)


class LongLife:
    """A scenario of ``rounds`` rounds with ``calls`` calls each, which the client passes on to the server."""

    def __init__(self, rounds: int, calls: int) -> None:
        self._round: tuple[s.Step, ...] = (
            s.Start(),
            *(s.Invoke("entry", 1),) * calls,
            s.Stop(),
            s.Disconnect("link"),
            s.Connect(_CLIENT, _REQUIRED, "api", "link"),
        )
        self._rounds = rounds
        self._first = self._perform()
        self._begin = self._where(len(_BEGINNING) + len(self._round))
        self._size = len(self._first) - self._begin

    def scenario(self, rounds: int | None = None) -> s.Scenario:
        """The steps; a step of a round is one value, shared by all rounds."""
        plan: dict[s.Hook, tuple[s.Action, ...]] = {"exchange": (s.CallPort(_REQUIRED, 2),)}
        components = {
            _SERVER: s.Declaration(provides=(_PROVIDED,)),
            _CLIENT: s.Declaration(provides=(_PROVIDED,), requires=(_REQUIRED,), connectable=True, plan=plan),
        }
        return s.Scenario(components, _BEGINNING + self._round * (rounds or self._rounds))

    def __len__(self) -> int:
        """How many events there are."""
        return self._begin + self._size * (self._rounds - 1)

    def events(self) -> Iterator[Event]:
        """The trace, event by event."""
        yield from self._first[: self._begin]
        again = self._first[self._begin :]
        duration = again[-1].t - again[0].t + 1000
        for number in range(self._rounds - 1):
            n, t, steps = number * self._size, number * duration, number * len(self._round)
            for event in again:
                if isinstance(event, Call | Return):
                    yield msgspec.structs.replace(event, n=event.n + n, t=event.t + t, step=event.step + steps)
                else:
                    yield msgspec.structs.replace(event, n=event.n + n, t=event.t + t)

    def _perform(self) -> Trace:
        """Two rounds, as they happen."""
        trace, stuck = Performance(ReferenceAdapter(), self.scenario(2), Recorder()).run()
        assert not stuck
        return trace

    def _where(self, step: int) -> int:
        return next(i for i, event in enumerate(self._first) if isinstance(event, Call) and event.step == step)
