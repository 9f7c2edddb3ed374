"""Conformant frameworks that once failed in a scenario with connectors, or of 10.2 to 10.5, fail there no more."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import pytest

from ucm_cts.adapters.contract.data_types import AnyType
from ucm_cts.adapters.contract.platform_interfaces import named_interfaces
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.mutants.python.subjects import (
    CONTAINER,
    CORE,
    PACED,
    POLICIES,
    REQUESTS,
    SHARED,
    TIMED,
    TRIGGERED,
    variants_of,
)
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.statement.files import stated_by
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

ONCE_FAILED = msgspec.yaml.decode((Path(__file__).parent / "once_failed.yaml").read_bytes())
FIELDS = ("interfaces", "components", "steps")
VARIANTS = variants_of((*CONTAINER, *CORE, *POLICIES, *TIMED, *TRIGGERED, *REQUESTS, *SHARED, *PACED))


@pytest.mark.parametrize("case", ONCE_FAILED, ids=lambda case: case["name"])
def test_conformant_framework_fails_no_more(case: dict[str, Any]) -> None:
    scenario = msgspec.convert({field: case[field] for field in FIELDS if field in case}, Scenario)
    types = msgspec.convert(case.get("bound", {}), dict[str, dict[str, AnyType]])
    for name, bound in types.items():
        interfaces = {**scenario.interfaces, **named_interfaces(name, bound)}
        scenario = msgspec.structs.replace(scenario, interfaces=interfaces, types={**scenario.types, name: bound})
    name = case["subject"]
    readings = {
        **stated_by(None, "reference-py").readings,
        **(VARIANTS[name].readings if name in VARIANTS else {}),
        **case.get("declared", {}),
    }
    subject = f"ucm_cts.adapters.mutants.python:{name}" if name in VARIANTS else name
    with Driver(locate(subject, virtual_time=True), 1) as driver:
        (answer,) = driver.run([(case["name"], scenario)])
    assert answer.incident is None
    assert Monitor(load_life_cycle(), Ics(readings)).judge(answer.disguised, answer.trace).findings == []
