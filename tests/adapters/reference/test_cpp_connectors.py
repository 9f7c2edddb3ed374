"""Options of the C++ reference framework: every choice conforms and behaves as documented."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping

import msgspec
import pytest
from cpp_builds import Builds

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

pytestmark = [pytest.mark.native, pytest.mark.usefixtures("here")]

SHORT_PATIENCE = 500
"""Milliseconds. Scenarios that wait for what must not come take no longer."""

DEFAULT = {
    "message-order": "fifo",
    "message-overflow": "block",
    "receiver-code": "dropped",
    "receiver-not-ready": "hold",
    "pending-at-stop": "keep",
    "comm-error": "at-once",
    "exception-transport": "full",
    "second-server": "at-connect",
    "service-failure": "raise",
    "call-in-flight": "finishes",
    "push-without-receiver": "ok",
    "port-trace-records": "call",
    "protected-recursion": "enter",
    "run-trigger": "repeated",
    "nan": "exact",
}
"""What the framework does without any option. Each reading that is declared binds."""

OPTIONS: dict[str, Mapping[str, str]] = {
    "": {"slow-receiver": "independent", "clock-epoch": "unix"},
    "delivery=synchronous": {
        "message-delivery": "synchronous",
        "receiver-not-ready": "drop",
        "pending-at-stop": "drop",
    },
    "executor=component": {},
    "executor=shared": {},
    "ids=random,removal=cascade": {"remove-while-ready": "cascade", "remove-provider-in-use": "cascade"},
    "ids=reused,repetition=refuse,order=reversed": {"double-start": "error", "stop-when-stopped": "error"},
    "service-failure=wait,unconnected=tolerate": {"service-failure": "wait", "start-unconfigured": "tolerate"},
    "not-ready=drop,pending=drop": {"receiver-not-ready": "drop", "pending-at-stop": "drop"},
    "not-ready=error,pending=deliver": {"receiver-not-ready": "error", "pending-at-stop": "deliver"},
    "delivery=synchronous,not-ready=error,executor=component": {
        "receiver-not-ready": "error",
        "pending-at-stop": "drop",
    },
    "inbox=4,clock=uptime,port-trace=call-and-return": {"port-trace-records": "call-and-return"},
}
"""Options, and the readings in which they differ from ``DEFAULT``, or which it leaves open."""


def scenarios(share: int, of: int) -> list[tuple[str, Scenario]]:
    """All scenarios that a person wrote, and each ``of``-th of the others, beginning with the ``share``-th."""
    every = {name: case for purpose in load_purposes("core") for name, case in purpose.scenarios}
    combined = [name for name in every if "/" in name]
    chosen = {*(name for name in every if "/" not in name), *combined[share % of :: of]}
    return [(name, msgspec.structs.replace(every[name], patience=SHORT_PATIENCE)) for name in every if name in chosen]


@pytest.mark.parametrize("options", OPTIONS)
def test_every_option_conforms(options: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("UCM_CTS_LWUCM_OPTIONS", options)
    readings = {**DEFAULT, **OPTIONS[options]}
    monitor = Monitor(load_life_cycle(), Ics(readings))
    observed: dict[str, set[str]] = {}
    share = list(OPTIONS).index(options)
    with Driver(locate("reference-cpp"), seed=share) as driver:
        for answer in driver.run(scenarios(share, 8)):
            assert answer.incident is None, (answer.name, answer.incident)
            verdicts = monitor.judge(answer.disguised, answer.trace)
            assert verdicts.findings == [], answer.name
            for option, seen in verdicts.readings.items():
                observed.setdefault(option, set()).update(seen)
    for option in OPTIONS[options].keys() & observed.keys():
        assert observed[option] == {readings[option]}


def test_links_refuse_wait_and_end_as_documented(builds: Builds) -> None:
    done = subprocess.run([builds.program("links")], capture_output=True, text=True, check=False, timeout=60)
    assert (done.stdout, done.stderr, done.returncode) == ("", "", 0)
