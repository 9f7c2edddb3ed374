"""Decides what a driver's side hosts run, and how many of them there are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from ucm_cts.adapters.contract.scenario import Scenario, Stress
from ucm_cts.harness.hosting.hosts import Hosts
from ucm_cts.harness.hosting.locate import Endpoint
from ucm_cts.harness.hosting.pace import lasts, waits
from ucm_cts.harness.hosting.side_hosts import SideHosts

MOST_AHEAD = 8
"""How many scenarios each side host is given before answers are awaited."""

MOST_AHEAD_OF_SLOW = 64
"""The same of a slow product: some scenarios take it a hundred times longer than others."""

WAITING_FOR_A_HOST = 3
"""Seconds that scenarios wait at least, together, for which another side host is worth its start."""

MOST_INCIDENTS = 8
"""After more incidents there are no side hosts any more."""

MOST_FAILURES = 3
"""So often side hosts are started anew when something else than the product, a busy machine mostly, kept one from answering."""

FEWEST = 2
"""How many side hosts there are at least if all that is to come is known and more than these are permitted."""


class Aside:
    """The side hosts of a driver: ``number`` at most, which are started when there is work for them.

    They take scenarios that mostly wait, and most of those of a slow product; never those with ``Stress``.
    ``hosts`` are the driver's own, which know the product and its pace.
    """

    def __init__(self, endpoint: Endpoint, hosts: Hosts, number: int) -> None:
        may_be_several = endpoint.kind in ("python", "executable") and not endpoint.in_process
        # in virtual time waits take none, so that further hosts would gain nothing
        self.number = number if may_be_several and not endpoint.virtual_time else 0
        self._left_behind: Counter[str] = Counter()
        self._incidents = self._failures = self._turn = 0
        self._endpoint = endpoint
        self._own = hosts
        self._hosts: SideHosts | None = None

    @property
    def is_there(self) -> bool:
        """Has one been wanted, and have they not been ended?"""
        return self._hosts is not None

    @property
    def most_ahead(self) -> int:
        """How many scenarios they are given before answers are awaited; at least 1."""
        return max(1, (MOST_AHEAD_OF_SLOW if self._own.pace.is_slow else MOST_AHEAD) * self.number)

    def may_take(self, scenario: Scenario) -> bool:
        """Are there to be side hosts, and is ``scenario`` for them?"""
        if not self.number or any(isinstance(one, Stress) for one in scenario.steps):
            return False
        return waits(scenario) > 0 or self._own.pace.is_slow

    def hosts_for(self, scenario: Scenario) -> SideHosts | None:
        """The side hosts, if they are to take ``scenario``."""
        if not self.may_take(scenario):
            return None
        side = self._side()
        if self._own.pace.is_slow:
            side.wanted = self.number
            self._turn = (self._turn + 1) % (self.number + 1)
            if self._turn == 0 and not waits(scenario):
                return None  # the driver's own host takes its share
        return side

    def has_too_many_incidents(self) -> bool:
        """There was another one. With few hosts a product that often crashes or hangs takes less time; but not if it is slow."""
        self._incidents += 1
        return self._incidents > MOST_INCIDENTS and not self._own.pace.is_slow

    def fail(self) -> None:
        """One could not answer, for another reason than the product: end all, and start them anew when there is work again. They
        are not started again and again.
        """
        self._failures += 1
        most = self.number if self._failures <= MOST_FAILURES else 0
        self.end()
        self.number = most

    def expect(self, scenarios: Iterable[Scenario]) -> None:
        """All of these are to come: no more hosts are used than are worth their start."""
        if self.number:
            waiting = sum(map(lasts, scenarios)) / 1000
            before = self._hosts.wanted if self._hosts is not None else 0
            self._side().wanted = max(before, min(self.number, FEWEST + round(waiting / WAITING_FOR_A_HOST)))

    @property
    def left_behind(self) -> Counter[str]:
        """The command lines of processes that hosts left behind, which were ended, and how many of each."""
        return self._left_behind + self._hosts.left_behind if self._hosts is not None else self._left_behind

    def end(self) -> None:
        """End all hosts. There will be none again."""
        if self._hosts is not None:
            self._hosts.close()
            self._left_behind += self._hosts.left_behind
        self._hosts, self.number = None, 0

    def _side(self) -> SideHosts:
        if self._hosts is None:
            own = self._own
            self._hosts = SideHosts(self._endpoint, own.limits, self.number, own.welcome, own.pace)
        return self._hosts
