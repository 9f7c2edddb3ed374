"""What destroyed runtimes leave in the process of their host is counted, and a pool is no leak."""

from __future__ import annotations

import pytest

from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.execution.leftovers import FREED, examine
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
    with Driver(locate("reference-py", True), 1) as driver:
        assert examine(driver, "destroy", SCENARIO, 0.3) is None
