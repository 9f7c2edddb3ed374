"""Defines what a campaign needs of a driver: one that has hosts, or one that answers from the record of an earlier run."""

from __future__ import annotations

import time
from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Protocol, TypeVar

import msgspec

from ucm_cts.adapters.contract.messages import Welcome
from ucm_cts.adapters.contract.scenario import Scenario, Stress
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.hosting.host_watch import Usage
from ucm_cts.harness.results.tally import Cause
from ucm_cts.harness.results.values import Execution, Incident, Isolation

T = TypeVar("T")

_EMPTY = Scenario({}, ())

WARM_UP = 8
"""A host that runs a scenario again has run so many others before, as the first one had."""

LONGEST_HISTORY = 200
"""So many are known."""


@dataclass(frozen=True)
class Answer:
    """One scenario and its result.

    ``name``: the name of the scenario.
    ``scenario``: as it is written.
    ``disguised``: as the framework got it, with random names.
    ``trace``: in the names of ``disguised``; after an incident the known part.
    ``incident``: what went wrong with the host, if anything.
    ``is_whole``: the trace is complete, although threads never came back.
    ``printed``: what the host printed meanwhile.
    ``stuck``: the workers that never came back.
    """

    name: str
    scenario: Scenario
    disguised: Scenario
    trace: Trace
    incident: Incident | None = None
    is_whole: bool = False
    printed: str = ""
    stuck: tuple[str, ...] = ()


@dataclass(frozen=True)
class Circumstances:
    """How a scenario is run again.

    ``patience``: the factor by which its patience is multiplied.
    ``one_core``: all threads of the host run on one core.
    ``after``: how many other scenarios the host runs before, if there have been so many.
    """

    patience: float = 1
    one_core: bool = False
    after: int = WARM_UP


class Gaps(Protocol):
    """Knows when the machine stood still, and how long threads waited for a processor."""

    def longest(self, trace: Trace) -> int:
        """Milliseconds of the longest gap while ``trace`` came about; 0 if there was none."""

    def contended(self, trace: Trace) -> int:
        """Milliseconds for which threads of this machine waited for a processor while ``trace`` came about; 0 if not known."""


class Allowance(Protocol):
    """Time that something may take."""

    def is_used_up(self) -> bool:
        """Whether it has taken longer."""


class Seconds:
    """So many seconds from now."""

    def __init__(self, seconds: float) -> None:
        self._until = time.monotonic() + seconds

    def is_used_up(self) -> bool:
        return time.monotonic() > self._until


class Disguising:
    """Has a disguise, and takes it off."""

    def __init__(self, seed: int) -> None:
        self.seed = seed
        self._disguise: Disguise | None = None

    @property
    def identity(self) -> Welcome:
        """The implementation under test."""
        raise NotImplementedError

    @property
    def disguise(self) -> Disguise:
        """The disguise of this run."""
        if self._disguise is None:
            self._disguise = Disguise(self.seed, self.identity.port_element_name)
        return self._disguise

    @property
    def has_side_hosts(self) -> bool:
        """Are there further hosts, or may there be some?"""
        return False

    def may_begin(self, scenario: Scenario) -> bool:
        """Would a further host run ``scenario`` before it is due?"""
        return False

    def begin(self, cases: Sequence[tuple[str, Scenario]]) -> None:
        """These ``cases`` (name, scenario) will be run: further hosts begin with them."""

    def look_ahead(self, cases: Iterable[tuple[str, Scenario]], circumstances: Circumstances) -> None:
        """These ``cases`` (name, scenario) will be run ``again`` in these ``circumstances``: what can be begun may begin."""

    def reveal(self, value: T) -> T:
        """``value`` in the script's own names."""
        return self.disguise.reveal(value)

    def revealed(self, answer: Answer) -> Execution:
        """The answer as an execution that people can read."""
        revealed = self.reveal(Execution("", _EMPTY, answer.trace, answer.incident))
        return msgspec.structs.replace(revealed, name=answer.name, scenario=answer.scenario)


def lasting(scenario: Scenario, times: float) -> Scenario:
    """``scenario`` with its patience, and the duration of its ``Stress`` steps, multiplied by ``times``."""
    steps = tuple(
        msgspec.structs.replace(step, milliseconds=round(step.milliseconds * times))
        if isinstance(step, Stress)
        else step
        for step in scenario.steps
    )
    return msgspec.structs.replace(scenario, steps=steps, patience=round(scenario.patience * times))


class Driving(Protocol):
    """Runs scenarios on one implementation under test; ``Driver`` says more."""

    seed: int
    adapter: str

    @property
    def gaps(self) -> Gaps:
        """When the machine stood still."""

    @property
    def identity(self) -> Welcome:
        """The implementation under test."""

    @property
    def adapter_file(self) -> str:
        """The file that the adapter was loaded from."""

    @property
    def isolation(self) -> Isolation:
        """Where the code behind the endpoint runs."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the vendor should know of the adapter, a sentence each."""

    @property
    def disguise(self) -> Disguise:
        """The disguise of the run."""

    def run(self, cases: Iterable[tuple[str, Scenario]], insist: bool = False) -> Iterator[Answer]:
        """The answers to ``cases`` (name, scenario), in order."""

    @property
    def has_side_hosts(self) -> bool:
        """Are there further hosts, or may there be some?"""

    def may_begin(self, scenario: Scenario) -> bool:
        """May ``begin`` be called with ``scenario``?"""

    def begin(self, cases: Sequence[tuple[str, Scenario]]) -> None:
        """These ``cases`` will be run."""

    def again(self, name: str, scenario: Scenario, circumstances: Circumstances) -> Answer:
        """The same scenario run once more, in other ``circumstances``."""

    def look_ahead(self, cases: Iterable[tuple[str, Scenario]], circumstances: Circumstances) -> None:
        """These ``cases`` will be run ``again`` in these ``circumstances``."""

    def many_times(self, name: str, scenario: Scenario) -> Generator[tuple[Answer, Usage | None], None, None]:
        """``scenario`` again and again on one host, each time with what the host's process holds afterwards."""

    def usages(self, seconds: float) -> Iterator[Usage]:
        """What the process of the current host holds, again and again within so many ``seconds``."""

    def allow(self, seconds: float) -> Allowance:
        """So many ``seconds`` from now."""

    def tries(self) -> AbstractContextManager[None]:
        """Within it, scenarios are tried whose answers decide nothing."""

    def keep(self, cause: Cause, answer: Answer) -> None:
        """The ``answer`` of a try with which the report shows the failure ``cause``."""

    def reveal(self, value: T) -> T:
        """``value`` in the script's own names."""

    def revealed(self, answer: Answer) -> Execution:
        """The answer as an execution that people can read."""
