"""Other ways to test a framework: hypothesis' state machine, and a parametrised pytest test.

Both call the C++ reference framework directly.
"""

from __future__ import annotations

import importlib
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, Phase, settings
from hypothesis.stateful import RuleBasedStateMachine, precondition, rule, run_state_machine_as_test

OPERATIONS = 10
"""So many operations make a scenario, as in the one that the endpoints carry out."""

_EXAMPLES = 50
_FEW, _MANY = 20, 420

_TESTS = """
import pytest
from ucm_cts.adapters import _reference_cpp as module

@pytest.mark.parametrize("case", range({cases}))
def test_whole_life(case):
    runtime = module.Runtime([("server", ["in_api"], []), ("client", [], ["out_api"])])
    server, client = runtime.add_component("server"), runtime.add_component("client")
    api = runtime.get_port_element(server, "in_api")
    link = runtime.connect(client, "out_api", api)
    runtime.start()
    assert runtime.exchange(api, 1) == ~1
    runtime.stop()
    runtime.disconnect(link)
    runtime.remove_component(client)
    runtime.remove_component(server)
"""


class Life(RuleBasedStateMachine):
    """The life cycle as a hypothesis state machine: permitted operations only, with a model of two components."""

    operations = 0

    def __init__(self) -> None:
        super().__init__()
        module: Any = importlib.import_module("ucm_cts.adapters._reference_cpp")
        self.runtime = module.Runtime([("server", ["in_api"], []), ("client", [], ["out_api"])])
        self.server = self.runtime.add_component("server")
        self.client = self.runtime.add_component("client")
        self.api: Any = None
        self.link: int | None = None
        self.started = False
        Life.operations += 2

    @rule()
    def find(self) -> None:
        """get_port_element"""
        Life.operations += 1
        self.api = self.runtime.get_port_element(self.server, "in_api")

    @precondition(lambda self: self.api is not None and self.link is None)
    @rule()
    def connect(self) -> None:
        """connect"""
        Life.operations += 1
        self.link = self.runtime.connect(self.client, "out_api", self.api)

    @precondition(lambda self: self.link is not None and not self.started)
    @rule()
    def start(self) -> None:
        """start"""
        Life.operations += 1
        self.runtime.start()
        self.started = True

    @precondition(lambda self: self.started)
    @rule()
    def call(self) -> None:
        """A business call"""
        Life.operations += 1
        assert self.runtime.exchange(self.api, 1) == ~1

    @precondition(lambda self: self.started)
    @rule()
    def stop(self) -> None:
        """stop"""
        Life.operations += 1
        self.runtime.stop()
        self.started = False

    @precondition(lambda self: self.link is not None and not self.started)
    @rule()
    def disconnect(self) -> None:
        """disconnect"""
        Life.operations += 1
        self.runtime.disconnect(self.link)
        self.link = None


def state_machine() -> float:
    """Microseconds that ``OPERATIONS`` cost which hypothesis chooses and carries out."""
    quick = settings(
        max_examples=_EXAMPLES,
        stateful_step_count=OPERATIONS,
        phases=(Phase.generate,),
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )
    before, began = Life.operations, time.perf_counter()
    run_state_machine_as_test(Life, settings=quick)
    return (time.perf_counter() - began) / (Life.operations - before) * OPERATIONS * 1e6


def parametrised_test() -> float:
    """Microseconds that one case of a parametrised pytest test costs, without pytest's start."""
    return (_run(_MANY) - _run(_FEW)) / (_MANY - _FEW) * 1e6


def _run(cases: int) -> float:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "test_life.py"
        path.write_text(_TESTS.format(cases=cases))
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:ucm_cts", str(path)]
        before = _spent_by_children()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, cwd=folder)
        return _spent_by_children() - before


def _spent_by_children() -> float:
    """Seconds of processor time; the difference of two runs is small, and other processes would distort wall-clock time."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
