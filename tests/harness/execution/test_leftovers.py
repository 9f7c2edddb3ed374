"""What destroyed runtimes leave in the process of their host is counted, and a pool is no leak."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import cast

import msgspec
import pytest

from ucm_cts.adapters.contract.scenario import Scenario, Stop
from ucm_cts.harness.execution.driver import Answer, Driver, Limits
from ucm_cts.harness.execution.leftovers import FREED, NotCounted, examine
from ucm_cts.harness.hosting.host_watch import Usage
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import load_scripts, to_scenario

SCENARIO = next(to_scenario(script) for script in load_scripts() if script.scenario == "destroy-frees")
MUTANTS = "ucm_cts.adapters.mutants.python"


@pytest.mark.parametrize(
    ("adapter", "cause"),
    [
        ("reference-py", None),
        (f"{MUTANTS}:keeps_a_pool_of_threads", None),
        (f"{MUTANTS}:leaves_its_watchdog", "threads"),
        (f"{MUTANTS}:leaves_a_file_for_each_container", "files"),
    ],
)
def test_what_is_left_behind_is_counted(adapter: str, cause: str | None) -> None:
    with Driver(locate(adapter), 1) as driver:
        examined = examine(driver, "destroy", SCENARIO, 0.3)
    assert examined is not None
    answer, finding = examined
    assert (finding and (finding.requirement, finding.cause)) == (cause and (FREED, cause))
    assert finding is None or set(finding.events) <= {event.n for event in answer.trace}


class _StillEnding:
    """A driver whose host holds one thread more after the warm-up than it keeps, and keeps one of each runtime."""

    def __init__(self) -> None:
        self.runtimes = 0

    def many_times(self, name: str, scenario: Scenario) -> Generator[tuple[Answer, Usage | None], None, None]:
        while True:
            self.runtimes += 1
            yield Answer(name, scenario, scenario, ()), Usage(1 + self.runtimes + (self.runtimes == 2), 3)

    def usages(self, _seconds: float) -> Iterator[Usage]:
        yield Usage(1 + self.runtimes, 3)


def test_a_thread_that_still_ends_after_the_warm_up_hides_no_leak() -> None:
    examined = examine(cast(Driver, _StillEnding()), "destroy", SCENARIO, 0.0)
    assert examined is not None
    assert examined[1] is not None


def test_a_host_that_shares_the_harness_process_is_not_counted() -> None:
    with Driver(locate("reference-py", True), 1) as driver, pytest.raises(NotCounted):
        examine(driver, "destroy", SCENARIO, 0.3)


@pytest.mark.usefixtures("here")
def test_a_framework_that_does_not_come_back_is_not_excused() -> None:
    with Driver(locate("hostile.failing:HangsInStop"), 1, Limits(seconds=1)) as driver:
        hangs = msgspec.structs.replace(SCENARIO, steps=(*SCENARIO.steps[:-1], Stop(), SCENARIO.steps[-1]))
        assert examine(driver, "destroy", hangs, 0.3) is None
