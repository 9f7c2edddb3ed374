"""The GStreamer adapter forwards: what its traces show is GStreamer's doing, and nothing is left over between scenarios."""

from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from real_frameworks import gstreamer_adapter

from ucm_cts.adapters.contract import programming_model as ucm

pytestmark = pytest.mark.native


@pytest.fixture(scope="module")
def module() -> Any:
    return gstreamer_adapter()


class Body(ucm.ComponentObject, ucm.Connectable, ucm.PortElementObject):
    """Notes its callbacks in ``story``; is its own provided port element, which asks whom it is connected to."""

    def __init__(self, name: str, story: list[str]) -> None:
        self.name, self.story = name, story
        self.peers: list[Any] = []

    def note(self, *words: object) -> None:
        self.story.append(" ".join(map(str, (self.name, *words))))

    def on_init(self) -> None:
        self.note("init")

    def on_startup(self, dependencies: Any) -> None:
        self.peers = [reference for dependency in dependencies for reference in dependency.to_port]
        self.note("startup", *(f"{d.from_port}:{len(d.to_port)}" for d in dependencies))

    def on_shutdown(self) -> None:
        self.note("shutdown")

    def on_remove(self) -> None:
        self.note("remove")

    def on_connect(self, port_name: str, required: Any) -> None:
        self.note("connect", port_name)

    def on_disconnect(self, port_name: str) -> None:
        self.note("disconnect", port_name)

    def get_portElement(self, provided: str) -> ucm.PortElementObject:
        return self

    def set_attribute(self, name: str, value: str) -> None:
        self.note(name, value)

    def exchange(self, value: int) -> int:
        return sum(peer.exchange(value) for peer in self.peers) if self.peers else value + 1


class Failing(Body):
    """Fails wherever its name says."""

    def on_init(self) -> None:
        super().on_init()
        assert self.name != "failing in init"

    def on_startup(self, dependencies: Any) -> None:
        super().on_startup(dependencies)
        assert self.name != "failing in startup"

    def on_shutdown(self) -> None:
        super().on_shutdown()
        raise LookupError("on the way down")

    on_remove = exchange = on_shutdown  # type: ignore[assignment]


class Runtime:
    """A runtime with some implementations; ``reported`` gives what has happened since."""

    def __init__(self, adapter: Any) -> None:
        self.story: list[str] = []
        self.adapter = adapter
        self.root = adapter.create_runtime(
            [
                self.implementation("server", Body, provides=["in_api"], attributes=["size"]),
                self.implementation("client", Body, provides=["in_api"], requires=["out_api"], connectable=True),
                *(self.implementation(name, Failing, provides=["in_api"]) for name in _FAILING),
            ]
        )

    def implementation(self, name: str, body: Callable[[str, list[str]], Body], **model: Any) -> ucm.Implementation:
        empty: dict[str, Any] = {"provides": [], "requires": [], "attributes": []}
        model = {**empty, "connectable": False, "fragment": False, **model}
        return ucm.Implementation(name, create=lambda: body(name, self.story), **model)

    def add(self, name: str, container: Any = None, attributes: Mapping[str, str] = {}) -> int:
        number: int = self.adapter.add_component(container or self.root, name, attributes)
        return number

    def entry(self, number: int, container: Any = None) -> ucm.PortElementObject:
        element: ucm.PortElementObject = self.adapter.get_port_element(container or self.root, number, "in_api")
        return element

    def reported(self) -> list[str]:
        reported, self.story[:] = self.story[:], []
        return reported


_FAILING = ("failing in init", "failing in startup", "failing")


@pytest.fixture
def runtime(module: Any) -> Iterator[Runtime]:
    runtime = Runtime(module.GStreamerAdapter())
    yield runtime
    runtime.adapter.destroy(runtime.root)


def test_version_is_asked_of_gstreamer(module: Any) -> None:
    assert f"GStreamer {module.GStreamerAdapter.version}" in module.Gst.version_string()


def test_pads_serve_while_they_play(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    client, server = runtime.add("client"), runtime.add("server", attributes={"size": "7"})
    assert runtime.reported() == ["client init", "server size 7", "server init"]
    adapter.connect(root, client, "out_api", runtime.entry(server))
    assert runtime.reported() == ["client connect out_api"]
    with pytest.raises(RuntimeError, match="flushing"):
        runtime.entry(client).exchange(1)
    adapter.start(root)
    assert runtime.reported() == ["server startup", "client startup out_api:1"]
    assert runtime.entry(client).exchange(-(2**31)) == -(2**31) + 1
    adapter.stop(root)
    assert runtime.reported() == ["server shutdown", "client shutdown"]
    with pytest.raises(RuntimeError, match="flushing"):
        runtime.entry(server).exchange(1)


def test_each_connection_has_pads_of_its_own(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    client, one, two = runtime.add("client"), runtime.add("server"), runtime.add("server")
    links = [adapter.connect(root, client, "out_api", runtime.entry(number)) for number in (one, two)]
    adapter.start(root)
    assert "client startup out_api:2" in runtime.reported()
    assert runtime.entry(client).exchange(1) == 4
    adapter.disconnect(root, links[0])
    adapter.stop(root)
    adapter.start(root)
    assert {"client disconnect out_api", "client startup out_api:1"} <= set(runtime.reported())
    for link in (links[0], links[1] + 1):
        with pytest.raises(ucm.NotFound):
            adapter.disconnect(root, link)


def test_calls_of_several_threads_get_their_own_answers(runtime: Runtime) -> None:
    server = runtime.add("server")
    runtime.adapter.start(runtime.root)
    entry, wrong = runtime.entry(server), []

    def call(first: int) -> None:
        wrong.extend(value for value in range(first, first + 100) if entry.exchange(value) != value + 1)

    threads = [threading.Thread(target=call, args=(1000 * number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


def test_a_provider_that_goes_takes_its_links_along(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    client, server = runtime.add("client"), runtime.add("server")
    entry = runtime.entry(server)
    link = adapter.connect(root, client, "out_api", entry)
    adapter.start(root)
    runtime.reported()
    adapter.remove_component(root, server)
    assert runtime.reported() == ["server shutdown", "client disconnect out_api", "server remove"]
    with pytest.raises(RuntimeError, match="not-linked"):
        entry.exchange(1)
    with pytest.raises(ucm.BadParameter):
        adapter.connect(root, client, "out_api", entry)
    for unknown in (lambda: adapter.disconnect(root, link), lambda: adapter.remove_component(root, server)):
        with pytest.raises(ucm.NotFound):
            unknown()
    assert adapter.get_components(root) == [client]


def test_containers_are_bins(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    box = adapter.create_container(root)
    client, server = runtime.add("client"), runtime.add("server", box)
    assert (adapter.get_components(root), adapter.get_components(box)) == ([client], [server])
    with pytest.raises(ucm.NotFound):
        adapter.remove_component(root, server)
    link = adapter.connect(root, client, "out_api", runtime.entry(server, box))
    adapter.start(box)
    runtime.reported()
    adapter.start(root)
    assert runtime.reported() == ["client startup out_api:1"]
    assert runtime.entry(client).exchange(1) == 2
    adapter.remove_component(box, server)
    assert runtime.reported() == [
        "server shutdown",
        "server remove",
    ]  # what is linked to the client is the bin's ghost pad
    adapter.disconnect(root, link)
    assert runtime.reported() == ["client disconnect out_api"]
    runtime.add("server", box)
    adapter.remove_container(root, box)
    assert runtime.reported() == ["server init", "server remove"]
    for unknown in (box, None):
        with pytest.raises(ucm.NotFound):
            adapter.remove_container(root, unknown)


def test_failure_on_the_way_up_is_refused(runtime: Runtime) -> None:
    adapter, root = runtime.adapter, runtime.root
    for name in ("failing in init", "nobody"):
        with pytest.raises(ucm.UcmError):
            runtime.add(name)
    assert runtime.reported() == ["failing in init init"]
    failing = runtime.add("failing in startup")
    with pytest.raises(ucm.UcmError):
        adapter.start(root)
    adapter.remove_component(root, failing)
    with pytest.raises(ucm.BadParameter):
        adapter.connect(root, runtime.add("client"), "out_api", None)
    for port in ("in_api", "none"):
        with pytest.raises(ucm.NotFound):
            adapter.connect(root, runtime.add("client"), port, runtime.entry(runtime.add("server")))


def test_failed_component_can_be_removed(runtime: Runtime) -> None:
    failing = runtime.add("failing")
    runtime.adapter.start(runtime.root)
    with pytest.raises(RuntimeError, match="error"):
        runtime.entry(failing).exchange(1)
    runtime.adapter.remove_component(runtime.root, failing)
    assert runtime.adapter.get_components(runtime.root) == []


def test_nothing_is_left_over(module: Any) -> None:
    gone: list[str] = []
    for _ in range(3):
        runtime = Runtime(module.GStreamerAdapter())
        box = runtime.adapter.create_container(runtime.root)
        client, server = runtime.add("client"), runtime.add("server", box)
        runtime.adapter.connect(runtime.root, client, "out_api", runtime.entry(server, box))
        runtime.reported()
        for bin_ in (runtime.root, box):
            for element in bin_.children:
                element.weak_ref(lambda: gone.append("element"))
        del element, bin_
        runtime.adapter.destroy(runtime.root)
        assert sorted(runtime.reported()) == ["client disconnect out_api", "client remove", "server remove"]
        del runtime, box
    assert gone.count("element") == 9


def test_one_line_names_the_missing_package(tmp_path: Path) -> None:
    """In an interpreter that sees no packages of the system, at a place where there are none."""
    (tmp_path / "gi.py").write_text("raise ImportError('no such thing')")
    done = subprocess.run(
        [sys.executable, "-m", "ucm_cts.adapters.sdk.python.host", "ucm_cts.adapters.integrations.gstreamer.adapter:GStreamerAdapter"],
        env={"PYTHONPATH": f"{tmp_path}:{':'.join(sys.path)}"}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "apt-get install python3-gi gir1.2-gstreamer-1.0" in done.stderr
    assert done.stderr.count("\n") == 1


def test_adapter_stays_thin(module: Any) -> None:
    assert len(Path(module.__file__).read_text().splitlines()) <= 300
