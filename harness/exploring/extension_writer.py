"""Random scenarios of profile extensions; of the connectors of 10.4: who is joined, and what they do one after the other."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Policy, Scenario
from ucm_cts.harness.exploring.paced_writer import paced_scenario
from ucm_cts.harness.exploring.timed_writer import scheduled_scenario, timed_scenario
from ucm_cts.harness.exploring.writer import Choose
from ucm_cts.harness.purposes.derived import request_configuration as rr
from ucm_cts.harness.purposes.derived import shared_data_configuration as sd

WRITTEN_PARTS = ("index-timers", "object-timers", "request-response", "shared-data", *s.EXTENDED)
"""The parts of which it writes scenarios."""

_PAUSE = 20
"""Milliseconds; enough for notifications and responses, as a rule, and nothing depends on it."""

_MOST_WRITES = 40
_OPERATIONS = (
    *["update"] * 8,
    *["write", "publish", "read"] * 4,
    *["freeze", "release"] * 3,
    *["cancel", "pause"] * 2,
    *["at_once", "restart", "half"],
)


def extension_scenario(part: str, choose: Choose) -> Scenario:
    """A new scenario of ``part``; ``choose`` picks one of several things."""
    if part == "index-timers":
        return timed_scenario(choose)
    if part == "object-timers":
        return scheduled_scenario(choose)
    if part in s.EXTENDED:
        return paced_scenario(part, choose)
    return _SharedDataWriter(choose).scenario() if part == "shared-data" else _requests(choose)


class _SharedDataWriter:
    """Writes one scenario. It waits for notifications of readers that were never frozen nor stopped, which must come."""

    def __init__(self, choose: Choose) -> None:
        self.choose = choose
        self.made = sd.Configuration()
        self.connection_of: list[int] = []
        self.readers_of: dict[int, list[int]] = {}
        self.sure: set[int] = set()
        self.has_place = False
        self.writes = 0

    def scenario(self) -> Scenario:
        """A new scenario."""
        self.has_place = self.choose((False, True))
        if self.has_place:
            self.made.container()
        for connection in range(self.choose((1, 1, 1, 2))):
            self._join(connection)
        self.made.start()
        for _ in range(self.choose((6, 10, 16, 24))):
            getattr(self, f"_{self.choose(_OPERATIONS)}")()
        return self.made.end()

    def _join(self, connection: int) -> None:
        self.made.connection(f"line {connection}")
        self.readers_of[connection] = []
        places = (s.MANAGER, sd.ELSEWHERE) if self.has_place else (s.MANAGER,)
        for _ in range(self.choose((1, 1, 2, 3))):
            self.made.writer(self.choose(places), of_writer=self._port_of(self.made.writers))
            self.connection_of.append(connection)
        for number in range(self.choose((1, 2, 3))):
            writer = len(self.connection_of) - 1
            own = writer if number == 0 and self.choose((False, False, True)) else None
            of_reader = self._port_of(self.made.readers) if own is None else None
            policies: tuple[Policy, ...] = self.choose(((), (), (Policy(s.PROTECTED_PASSIVE),)))
            place = self.choose(places)
            reads = self.choose((False, False, True))
            self.made.reader(place, policies, own, of_reader, reads)
            self.readers_of[connection].append(len(self.made.readers) - 1)
            self.sure.add(len(self.made.readers) - 1)

    def _port_of(self, ports: Sequence[sd.Port]) -> int | None:
        """The number of one of ``ports``, whose component gets a further one; mostly None."""
        return self.choose((None, None, None, self.choose(range(len(ports))))) if ports else None

    def _some_writer(self) -> int:
        return int(self.choose(range(len(self.connection_of))))

    def _some_readers(self) -> tuple[int, ...]:
        everybody = tuple(range(len(self.made.readers)))
        return tuple(self.choose(((self.choose(everybody),), everybody)))

    def _update(self) -> None:
        if self.writes < _MOST_WRITES:
            self.writes += 1
            writer = self._some_writer()
            waiting = [r for r in self.readers_of[self.connection_of[writer]] if r in self.sure]
            self.made.update(writer, of=tuple(waiting))
            if self.choose((False, True)):
                self.made.read(*self._some_readers())

    def _write(self) -> None:
        if self.writes < _MOST_WRITES:
            self.writes += 1
            self.made.write(self._some_writer())

    def _publish(self) -> None:
        self._unsettle()
        self.made.publish(self._some_writer())

    def _cancel(self) -> None:
        self.made.cancel(self._some_writer())

    def _read(self) -> None:
        self.made.read(*self._some_readers())

    def _freeze(self) -> None:
        chosen = self._some_readers()
        self.sure -= {*chosen}
        self.made.freeze(*chosen)

    def _release(self) -> None:
        self.made.release(*self._some_readers())

    def _pause(self) -> None:
        self.made.pause(_PAUSE)

    def _at_once(self) -> None:
        """Two writers publish, and a reader reads, on threads of their own."""
        self._unsettle()
        writers = {self._some_writer(), self._some_writer()}
        self.made.apart(*(("publish", writer) for writer in sorted(writers)), ("read", self._some_readers()[0]))

    def _restart(self) -> None:
        self._unsettle()
        self.made.stop().start()

    def _half(self) -> None:
        """One container is stopped, and started again after a publication."""
        if self.has_place and self.writes < _MOST_WRITES:
            self._unsettle()
            self.writes += 1
            place = self.choose((s.MANAGER, sd.ELSEWHERE))
            working = [n for n, writer in enumerate(self.made.writers) if self.made.place_of(writer) != place]
            self.made.stop(place)
            if working:
                self.made.update(self.choose(working), of=())
            self.made.start(place)

    def _unsettle(self) -> None:
        """From now on nobody knows how many notifications there must be."""
        self.sure.clear()


def _requests(choose: Choose) -> Scenario:
    """A server that answers at once, or stores what it is asked and answers in some order; clients of any kind."""
    place = choose((s.MANAGER, rr.ELSEWHERE))
    made = rr.Configuration(place)
    kinds = [choose(rr.KINDS) for _ in range(choose((1, 2, 3)))]
    if choose((False, True)):
        made.server(choose(rr.KINDS))
        for kind in kinds:
            made.clients((kind,), choose((1, 2, 3)), second=choose(("", "", made.link)))
        made.start()
        for _ in range(choose((2, 4, 8))):
            made.ask(choose(range(len(kinds))))
            if choose((False,) * 5 + (True,)):
                made.restart()
        return made.end()
    requests = [choose((1, 2, 3)) if kind == rr.ASYNCHRONOUS else 1 for kind in kinds]
    seconds = [choose(("", "", made.link)) if kind == rr.ASYNCHRONOUS else "" for kind in kinds]
    waiting = [2 * number if second else number for number, second in zip(requests, seconds, strict=True)]
    order = list(range(1, sum(waiting) + 1))
    shuffled = []
    while order:
        shuffled.append(order.pop(order.index(choose(order))))
    made.storing(shuffled, unknown=choose((None, None, 4_000_000_000)))
    for kind, number, second in zip(kinds, requests, seconds, strict=True):
        made.clients((kind,), number, second=second)
    made.start().ask_all(*range(len(kinds))).entered(sum(waiting))
    made.answer(sum(n for kind, n in zip(kinds, waiting, strict=True) if kind == rr.ASYNCHRONOUS))
    return made.join(*range(len(kinds))).end()
