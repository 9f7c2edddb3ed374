"""The reference framework in Python keeps each requirement of 10.3, 10.4 and 10.5 in the scenarios of its part alone."""

from __future__ import annotations

import pytest

from ucm_cts.harness.catalogue.requirements import load_life_cycle, requirements_of
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.models.core_models import CHECKS
from ucm_cts.harness.purposes.derived.index_timers import index_timer_purposes
from ucm_cts.harness.purposes.derived.object_timers import object_timer_purposes
from ucm_cts.harness.purposes.derived.paced_calls import paced_call_purposes
from ucm_cts.harness.purposes.derived.paced_policies import NAMES, policy_purposes
from ucm_cts.harness.purposes.derived.paced_runs import run_purposes
from ucm_cts.harness.purposes.derived.request_response import request_purposes
from ucm_cts.harness.purposes.derived.shared_data import shared_data_purposes
from ucm_cts.harness.statement.files import stated_by
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.slow

PARTS = {
    ("index-timers",): index_timer_purposes,
    ("object-timers",): object_timer_purposes,
    ("request-response",): request_purposes,
    ("shared-data",): shared_data_purposes,
    ("execution", *NAMES): lambda: [*policy_purposes(), *run_purposes(), *paced_call_purposes()],
}
"""The purposes of each part, or of parts that have some in common."""


@pytest.mark.parametrize("parts", PARTS, ids=lambda parts: parts[0])
def test_each_requirement_arises_and_is_kept(parts: tuple[str, ...]) -> None:
    monitor = Monitor(load_life_cycle(), Ics(stated_by(None, "reference-py").readings))
    # those with "broken when" take long and show nothing more
    cases = [case for purpose in PARTS[parts]() for case in purpose.scenarios if "broken when" not in case[0]]
    kept: set[str] = set()
    with Driver(locate("reference-py", virtual_time=True), 1) as driver:
        for answer in driver.run(cases):
            assert answer.incident is None, answer.name
            verdicts = monitor.judge(answer.disguised, answer.trace)
            assert verdicts.findings == [], answer.name
            kept |= verdicts.exercises.keys()
    due = {r.id for r in requirements_of("extensions") if r.part in parts and r.rules}
    assert {one for one in due if not CHECKS.keys() & {*_rules(one)}} <= kept


def _rules(requirement: str) -> tuple[str, ...]:
    return next(r.rules for r in requirements_of("extensions") if r.id == requirement)
