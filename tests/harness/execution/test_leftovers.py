"""What destroyed runtimes leave in the process of their host is counted, and a pool is no leak."""

from __future__ import annotations

import msgspec
import pytest

from ucm_cts.adapters.contract.scenario import Stop
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.execution.leftovers import FREED, NotCounted, examine
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


def test_a_host_that_shares_the_harness_process_is_not_counted() -> None:
    with Driver(locate("reference-py", True), 1) as driver, pytest.raises(NotCounted):
        examine(driver, "destroy", SCENARIO, 0.3)


@pytest.mark.usefixtures("here")
def test_a_framework_that_does_not_come_back_is_not_excused() -> None:
    with Driver(locate("hostile.failing:HangsInStop"), 1, Limits(seconds=1)) as driver:
        hangs = msgspec.structs.replace(SCENARIO, steps=(*SCENARIO.steps[:-1], Stop(), SCENARIO.steps[-1]))
        assert examine(driver, "destroy", hangs, 0.3) is None
