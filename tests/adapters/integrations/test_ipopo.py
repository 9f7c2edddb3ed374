"""The iPOPO adapter forwards: what its traces show is iPOPO's doing, and nothing is left over between scenarios."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest

from ucm_cts.adapters.contract import programming_model as ucm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.trace import Raise
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.adapters.sdk.python.probe import PlannedFailure
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.purposes.scripts import load_scripts, to_scenario

pytest.importorskip("pelix")

from pelix.framework import FrameworkFactory

from ucm_cts.adapters.integrations.ipopo.adapter import IpopoAdapter

pytestmark = pytest.mark.slow


class Body(ucm.ComponentObject, ucm.Connectable, ucm.PortElementObject):
    """Notes its callbacks in ``story``; is its own provided port element."""

    def __init__(self, name: str, story: list[str]) -> None:
        self.name = name
        self.story = story

    def note(self, *words: object) -> None:
        self.story.append(" ".join(map(str, (self.name, *words))))

    def on_init(self) -> None:
        self.note("init")

    def on_startup(self, dependencies: Any) -> None:
        self.note("startup", *(f"{d.from_port}={reference.name}" for d in dependencies for reference in d.to_port))

    def on_shutdown(self) -> None:
        self.note("shutdown")

    def on_remove(self) -> None:
        self.note("remove")

    def on_connect(self, port_name: str, required: Any) -> None:
        self.note("connect", port_name, required.name)

    def on_disconnect(self, port_name: str) -> None:
        self.note("disconnect", port_name)

    def get_portElement(self, provided: str) -> ucm.PortElementObject:
        return self

    def set_attribute(self, name: str, value: str) -> None:
        self.note(name, value)

    def exchange(self, value: int) -> int:
        return value + 1


class Failing(Body):
    def on_init(self) -> None:
        raise LookupError("init")


class Runtime:
    """A runtime with the implementations server, client and failing; ``reported`` gives what has happened since."""

    def __init__(self) -> None:
        self.story: list[str] = []
        self.adapter = IpopoAdapter()
        self.root = self.adapter.create_runtime(
            [
                self.implementation("server", Body, provides=["in_api"], attributes=["size"]),
                self.implementation("client", Body, provides=["in_api"], requires=["out_api"], connectable=True),
                self.implementation("failing", Failing),
            ]
        )

    def implementation(self, name: str, body: Callable[[str, list[str]], Body], **model: Any) -> ucm.Implementation:
        empty: dict[str, Any] = {"provides": [], "requires": [], "attributes": []}
        model = {**empty, "connectable": False, "fragment": False, **model}
        return ucm.Implementation(name, create=lambda: body(name, self.story), **model)

    def reported(self) -> list[str]:
        reported, self.story[:] = self.story[:], []
        return reported


@pytest.fixture
def runtime() -> Iterator[Runtime]:
    runtime = Runtime()
    yield runtime
    runtime.adapter.close()


def test_connecting_makes_valid_and_removing_the_provider_invalid(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    server = adapter.add_component(root, "server", {"size": "7"})
    client = adapter.add_component(root, "client", {})
    assert runtime.reported() == ["server size 7", "server init", "server startup", "client init"]
    element = adapter.get_port_element(root, server, "in_api")
    assert element.exchange(1) == 2
    link = adapter.connect(root, client, "out_api", element)
    assert runtime.reported() == ["client connect out_api server", "client startup out_api=server"]
    adapter.remove_component(root, server)
    assert runtime.reported() == ["client shutdown", "client disconnect out_api", "server shutdown", "server remove"]
    assert adapter.get_components(root) == [client]
    adapter.disconnect(root, link)
    with pytest.raises(ucm.NotFound):
        adapter.disconnect(root, link)
    assert runtime.reported() == []


def test_start_and_stop_are_the_nearest_things_ipopo_has(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    server, client = adapter.add_component(root, "server", {}), adapter.add_component(root, "client", {})
    adapter.connect(root, client, "out_api", adapter.get_port_element(root, server, "in_api"))
    runtime.reported()
    adapter.start(root)
    assert runtime.reported() == []
    adapter.stop(root)
    assert runtime.reported() == ["client shutdown", "client disconnect out_api", "server shutdown"]
    with pytest.raises(ucm.NotFound):
        adapter.get_port_element(root, server, "in_api")
    adapter.start(root)
    assert runtime.reported() == ["server startup", "client connect out_api server", "client startup out_api=server"]


def test_containers_are_bundles(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    box = adapter.create_container(root)
    outside, inside = adapter.add_component(root, "server", {}), adapter.add_component(box, "server", {})
    assert (adapter.get_components(root), adapter.get_components(box)) == ([outside], [inside])
    with pytest.raises(ucm.NotFound):
        adapter.remove_component(root, inside)
    runtime.reported()
    adapter.remove_container(root, box)
    assert runtime.reported() == ["server shutdown", "server remove"]
    with pytest.raises(ucm.NotFound):
        adapter.remove_container(root, box)
    with pytest.raises(ucm.UcmError):
        adapter.add_component(box, "server", {})


def test_refusals_of_ipopo_are_passed_on(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    for unknown in ("failing", "nobody"):
        with pytest.raises(ucm.UcmError):
            adapter.add_component(root, unknown, {})
    client = adapter.add_component(root, "client", {})
    with pytest.raises(ucm.NotFound):  # its service is not there before its requirement is
        adapter.get_port_element(root, client, "in_api")
    with pytest.raises(ucm.BadParameter):
        adapter.connect(root, client, "out_api", None)
    with pytest.raises(ucm.NotFound):
        adapter.connect(root, client + 1, "out_api", None)


def test_nothing_is_left_over() -> None:
    for _ in range(3):
        runtime = Runtime()
        box = runtime.adapter.create_container(runtime.root)
        runtime.adapter.add_component(box, "server", {})
        runtime.adapter.add_component(runtime.root, "server", {})
        runtime.reported()
        runtime.adapter.destroy(runtime.root)
        assert runtime.reported() == ["server shutdown", "server remove"] * 2
        assert not FrameworkFactory.is_framework_running()
        assert not [name for name in sys.modules if name.startswith("container-")]
        runtime.adapter.close()


def test_no_script_makes_the_adapter_stumble(caplog: pytest.LogCaptureFixture) -> None:
    """iPOPO swallows what is raised inside its callbacks; nothing but what probes raise as planned may be among it."""
    caplog.set_level(logging.WARNING)
    engine = Engine(IpopoAdapter)
    for script in load_scripts():
        scenario = Disguise(1, IpopoAdapter.port_element_name).scenario(to_scenario(script))
        if any(isinstance(step, s.ReachGate) for step in scenario.steps) and _needs_more_than_ipopo_has(scenario):
            scenario = msgspec.structs.replace(scenario, patience=scenario.patience // 10)  # nobody will come
        answer = from_host_decoder().decode(engine.answer(encode(Run(1, scenario))))
        assert isinstance(answer, Traced), answer
        assert not answer.stuck
        undeclared = [event for event in answer.events if isinstance(event, Raise) and event.error == "UNDECLARED"]
        assert [event for event in undeclared if not event.detail.startswith("PlannedFailure")] == []
    swallowed = [record.exc_info[0] for record in caplog.records if record.exc_info]
    assert set(swallowed) == {PlannedFailure}


def _needs_more_than_ipopo_has(scenario: s.Scenario) -> bool:
    """Does it need connectors or execution policies? Bodies then wait at gates for messages and executions that do not come."""
    policies = any(declaration.policies for declaration in scenario.components.values())
    return policies or any(isinstance(step, s.Link) for step in scenario.steps)


def test_adapter_stays_thin() -> None:
    assert len(Path(sys.modules[IpopoAdapter.__module__].__file__ or "").read_text().splitlines()) <= 200
