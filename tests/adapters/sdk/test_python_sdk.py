"""The Python SDK does what docs/protocol.md says."""

from __future__ import annotations

import contextlib
import re
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import FrameType
from typing import Any

import pytest
from files import ROOT, guide_files
from performing import SINK, SOURCE, answer, line_of, play, scenario

from ucm_cts.adapters.contract.messages import (
    PROTOCOL,
    Happened,
    Hello,
    Refused,
    Run,
    Traced,
    Welcome,
    encode,
    from_host_decoder,
)
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, PortElementObject
from ucm_cts.adapters.contract.scenario import SELF_EXECUTING, SELF_EXECUTION_API
from ucm_cts.adapters.contract.trace import Enter
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python import workers
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.hosting.hosts import Hosts
from ucm_cts.harness.hosting.locate import locate

GUIDE = ROOT / "docs" / "adapter-python.md"


class Spy(ReferenceAdapter):
    """Records what reaches the adapter."""

    seen: list[Any]

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        type(self).seen = []
        return super().create_runtime(implementations)

    def add_component(self, container: Any, implementation: str, attributes: Mapping[str, str]) -> int:
        self.seen.append(("add", implementation, dict(attributes)))
        return super().add_component(container, implementation, attributes)

    def remove_component(self, container: Any, comp_instance: int) -> None:
        self.seen.append(("remove", comp_instance))
        super().remove_component(container, comp_instance)

    def disconnect(self, container: Any, connection: int) -> None:
        self.seen.append(("disconnect", connection))
        super().disconnect(container, connection)

    def remove_container(self, manager: Any, sub_container: Any) -> None:
        self.seen.append(("remove_container", sub_container))
        super().remove_container(manager, sub_container)

    def connect(self, container: Any, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        self.seen.append(("connect", to_port))
        return super().connect(container, instance, port_name, to_port)

    def destroy(self, manager: Any) -> None:
        self.seen.append(("destroy",))
        super().destroy(manager)

    def close(self) -> None:
        self.seen.append(("close",))


def test_hello_is_answered_with_welcome() -> None:
    reply = from_host_decoder().decode(Engine(ReferenceAdapter).answer(encode(Hello(PROTOCOL))))
    assert reply == Welcome(PROTOCOL, ReferenceAdapter.product, ReferenceAdapter.version)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        (b"", "truncated"),
        (b"nonsense", "malformed"),
        (b'{"type":"run","id":1}', "missing required field `scenario`"),
        (b'{"type":"dance"}', "Invalid value 'dance'"),
        (b'{"type":"hello","protocol":"2"}', "Expected `int`, got `str`"),
        (b'{"type":"run","id":1,"scenario":{"components":{},"steps":[{"op":"start","x":1}]}}', "unknown field `x`"),
    ],
)
def test_breach_of_protocol_is_refused_and_the_engine_goes_on(line: bytes, reason: str) -> None:
    engine = Engine(ReferenceAdapter)
    reply = from_host_decoder().decode(engine.answer(line))
    assert isinstance(reply, Refused)
    assert reason in reply.reason
    assert isinstance(from_host_decoder().decode(engine.answer(encode(Hello(PROTOCOL)))), Welcome)


def test_line_in_another_encoding_is_refused_and_the_engine_goes_on() -> None:
    engine = Engine(ReferenceAdapter)
    reply = from_host_decoder().decode(engine.answer(b'{"type":"\xff"}'))
    assert isinstance(reply, Refused)
    assert "utf-8" in reply.reason.lower()  # msgspec spells it in either way
    assert isinstance(from_host_decoder().decode(engine.answer(encode(Hello(PROTOCOL)))), Welcome)


def test_unbound_variables_are_skipped_and_reserved_ones_passed_on() -> None:
    trace = play(
        {"sink": SINK, "source": SOURCE},
        ["remove_component id=sink", "add_component component=source", "connect id=source port=out to=nowhere bind=x",
         "invoke ref=nowhere value=1", "invoke ref=nil value=1", "disconnect connection=x", "start container=nowhere",
         "remove_component id=unknown", "disconnect connection=unknown", "connect id=source port=out to=nil bind=x",
         "remove_container container=nil", "add_component component=stranger"],
        Spy,
    )  # fmt: skip
    skipped = [
        f"skip step={n} variable={v}"
        for n, v in enumerate(["sink", "", "nowhere", "nowhere", "nil", "x", "nowhere"])
        if v
    ]
    assert [line for line in trace if line.startswith("skip")] == skipped
    unknown = 2**31 - 1
    assert Spy.seen == [
        ("add", "source", {}), ("remove", unknown), ("disconnect", unknown), ("connect", None),
        ("remove_container", None), ("add", "stranger", {}), ("destroy",), ("close",),
    ]  # fmt: skip


def test_variables_keep_removed_ids_and_traces_start_anew() -> None:
    steps = ["add_component component=sink", "get_port_element id=sink port=in bind=api", "remove_component id=sink",
             "invoke ref=api value=1", "remove_component id=sink", "destroy"]  # fmt: skip
    engine = Engine(Spy)
    for _ in range(2):
        reply = from_host_decoder().decode(engine.answer(encode(Run(1, scenario({"sink": SINK}, steps)))))
        assert isinstance(reply, Traced)
        assert [event.n for event in reply.events] == list(range(1, len(reply.events) + 1))
        trace = [line_of(event) for event in reply.events]
        assert "return step=3 value=-2" in trace
        assert "raise step=4 error=NOT_FOUND" in trace
        assert Spy.seen.count(("destroy",)) == 1  # not once more after the scenario has done so


class Waits(ReferenceAdapter):
    """start sleeps until stop, stop is slow, create_container spins, destroy polls; all for patience at most."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        self.stopped = threading.Event()
        return super().create_runtime(implementations)

    def start(self, container: Any) -> None:
        self.stopped.wait()

    def stop(self, container: Any) -> None:
        self.stopped.set()

    def create_container(self, manager: Any) -> Any:
        end = time.monotonic() + 0.3
        while time.monotonic() < end:
            pass

    def remove_container(self, manager: Any, sub_container: Any) -> None:
        end = time.monotonic() + 0.3
        while time.monotonic() < end:
            time.sleep(0.0002)


BLOCKS = ["start thread=w", "settle worker=w", "stop", "join worker=w"]


@pytest.mark.parametrize(
    ("steps", "where"),
    [
        (BLOCKS, "blocked"),
        (["settle worker=nobody"], "done"),
        (["get_components thread=w", "settle worker=w"], "done"),
        (["create_container bind=box thread=w", "settle worker=w", "join worker=w"], "running"),
        (["create_container bind=box thread=w", "create_container bind=tub thread=v", "settle worker=w",
          "join worker=w", "join worker=v"], "running"),
        (["remove_container container=nil thread=w", "settle worker=w", "join worker=w"], "running"),
    ],
)  # fmt: skip
def test_settle_records_the_state_of_a_worker(steps: list[str], where: str) -> None:
    trace = play({}, steps, Waits, patience=100)
    assert [line.rpartition("=")[2] for line in trace if line.startswith("settled")] == [where]


def test_worker_counts_as_running_if_the_operating_system_does_not_report_its_state(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(workers, "_sleeps", lambda thread: None)
    awake = threading.Event()
    threads = workers.Workers(patience=0.05)
    threads.queue("w", awake.wait)  # type: ignore[arg-type]
    assert threads.settle("w", lambda thread: False) == "running"
    awake.set()


def test_probes_that_execute_themselves_can_be_run() -> None:
    given: list[Any] = []

    class Runs(ReferenceAdapter):
        def start(self, container: Any) -> None:
            for member in container.members.values():
                get = member.body.get_policy_element
                given.extend([get(SELF_EXECUTING, SELF_EXECUTION_API), get(SELF_EXECUTING, "x"), get("x", "x")])
                if given[0]:
                    given[0].run()

    plan = {"run": [{"do": "call", "port": "out", "value": 3}, {"do": "raise"}]}
    steps = ["add_component component=s", "start"]
    trace = play({"s": {"policies": [{"definition": SELF_EXECUTING}], "plan": plan}}, steps, Runs)
    assert trace[-3:] == ["enter s#1 hook=run", "exit s#1 hook=run raised=True", "raise step=1 error=UNDECLARED"]
    assert given[1:] == [None, None]
    given.clear()
    assert play({"s": {}}, steps, Runs)[-1] == "return step=1"
    assert given == [None] * 3


def test_threads_that_never_come_back_are_stuck() -> None:
    class Hangs(Spy):
        def start(self, container: Any) -> None:
            threading.Event().wait()

    trace = play({}, ["start thread=w", "get_components thread=v", "join worker=w"], Hangs, patience=30)
    assert trace[-2:] == ["timeout step=2", "stuck w"]
    assert Hangs.seen == []  # neither destroyed nor closed under the feet of a stuck thread


def test_a_variable_is_bound_in_the_trace_before_it_is_used() -> None:
    """Although a worker that nobody waits for any longer is slow to record what it has bound."""
    used = threading.Event()

    def wait_in_binding(frame: FrameType, event: str, _: object) -> None:
        if event == "return" and frame.f_code.co_name == "bind_reference":
            used.wait(0.2)

    class IsSlowToBind(ReferenceAdapter):
        def get_port_element(self, container: Any, comp_instance: int, port_name: str) -> PortElementObject | None:
            sys.setprofile(wait_in_binding)
            return super().get_port_element(container, comp_instance, port_name)

        def connect(self, *given: Any) -> int:
            used.set()
            return super().connect(*given)

    steps = ["add_component component=sink", "add_component component=source",
             "get_port_element id=sink port=in bind=p thread=w", "settle worker=w", "join worker=w",
             "connect id=source port=out to=p bind=c"]  # fmt: skip
    trace = play({"sink": SINK, "source": SOURCE}, steps, IsSlowToBind, patience=20)
    assert trace[-1] in ("return step=5 value=3", "skip step=5 variable=p")


def test_probes_are_silent_after_the_scenario() -> None:
    kept: list[PortElementObject] = []

    class Keeps(ReferenceAdapter):
        def get_port_element(self, container: Any, comp_instance: int, port_name: str) -> PortElementObject | None:
            kept.append(super().get_port_element(container, comp_instance, port_name))  # type: ignore[arg-type]
            return kept[0]

    steps = ["add_component component=s", "get_port_element id=s port=in bind=api"]
    bad = SINK | {"plan": {"exchange": [{"do": "raise"}], "on_remove": [{"do": "hold", "gate": "g"}]}}
    play({"s": bad}, steps, Keeps)
    assert kept[0].exchange(1) == -2
    assert play({"s": SINK}, steps, Keeps)[-1] == "return step=1 value=opaque"  # another scenario's probe


def test_framework_made_references_are_opaque() -> None:
    class Proxy(PortElementObject):
        def __init__(self, real: PortElementObject) -> None:
            self.real = real

        def exchange(self, value: int) -> int:
            return self.real.exchange(value)

    class Proxies(ReferenceAdapter):
        def get_port_element(self, container: Any, comp_instance: int, port_name: str) -> PortElementObject | None:
            real = super().get_port_element(container, comp_instance, port_name)
            return Proxy(real) if real else None

    trace = play(
        {"s": SINK},
        ["add_component component=s", "get_port_element id=s port=in bind=api", "invoke ref=api value=0"],
        Proxies,
    )
    assert "return step=1 value=opaque" in trace
    assert trace[-1] == "return step=2 value=-1"


@pytest.mark.parametrize(
    ("operation", "value", "reason"),
    [
        ("add_component", None, "add_component returned None; it returns an integer"),
        ("get_components", 5, "get_components returned 5; it returns a sequence of integers"),
        ("get_components", ["a"], "get_components returned 'a'; it returns an integer"),
        ("add_component", 2**70, "it returns an integer"),
    ],
)
def test_adapter_that_breaks_the_contract_is_refused(operation: str, value: object, reason: str) -> None:
    broken = type("Broken", (ReferenceAdapter,), {operation: lambda *arguments: value})
    reply = answer(scenario({"s": SINK}, ["add_component component=s", "get_components"]), broken)
    assert isinstance(reply, Refused)
    assert reply.id == 7
    assert reason in reply.reason


def test_malformed_dependencies_are_recorded() -> None:
    for given in (None, [("out", ())], [PortConnection(5, ())]):  # type: ignore[arg-type]

        class Careless(ReferenceAdapter):
            given_to_bodies: Any = given

            def start(self, container: Any) -> None:
                for member in container.members.values():
                    member.body.on_startup(self.given_to_bodies)

        asked = scenario({"s": SINK}, ["add_component component=s", "start"])
        reply = answer(asked, Careless)
        assert isinstance(reply, Traced)
        assert contradiction(asked, reply.events) is None
        (started,) = [e for e in reply.events if isinstance(e, Enter) and e.hook == "on_startup"]
        assert started.wrong
        assert started.dependencies == ()


def test_results_of_a_wrong_type_are_the_frameworks() -> None:
    class Vague(PortElementObject):
        def exchange(self, value: int) -> Any:
            return None

    class Careless(ReferenceAdapter):
        def get_port_element(self, container: Any, comp_instance: int, port_name: str) -> PortElementObject | None:
            return Vague()

    steps = ["add_component component=s", "get_port_element id=s port=in bind=api", "invoke ref=api value=0"]
    assert play({"s": SINK}, steps, Careless)[-1] == "return step=2 wrong=nothing"


def test_streamed_events_come_before_the_answer() -> None:
    lines: list[bytes] = []
    asked = Run(3, scenario({"s": SINK}, ["add_component component=s", "start"]), stream=True)
    reply = from_host_decoder().decode(Engine(ReferenceAdapter).answer(encode(asked), lines.append))
    assert isinstance(reply, Traced)
    assert all(line.endswith(b"\n") for line in lines)
    assert [from_host_decoder().decode(line) for line in lines] == [Happened(3, event) for event in reply.events]


def test_the_guide_for_adapter_authors_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, text in guide_files(GUIDE).items():
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    asked = scenario(
        {"server": SINK | {"attributes": {"a": "1"}}, "client": SOURCE, "fragment": {"fragment": True}},
        ["add_component component=server", "add_component component=client", "add_component component=fragment",
         "get_port_element id=server port=in bind=api", "connect id=client port=out to=api bind=link",
         "connect id=client port=none to=api bind=x", "start", "invoke ref=api value=1", "stop",
         "disconnect connection=link", "remove_component id=client", "remove_component id=client",
         "create_container bind=box", "get_components", "destroy"],
    )  # fmt: skip
    with Hosts(locate("my_adapter:BeansAdapter")) as hosts:
        assert hosts.welcome.product == "Beans"
        (reply,) = hosts.run([Run(1, asked)])
    assert isinstance(reply.reply, Traced)
    ends = [line for line in map(line_of, reply.reply.events) if re.match(r"return|raise", line)]
    assert [line for line in ends if line.startswith("raise")] == [
        "raise step=5 error=NOT_FOUND",
        "raise step=11 error=NOT_FOUND",
    ]
    assert len(ends) == len(asked.steps)
    assert "return step=7 value=-2" in ends


def test_frameworks_may_mark_bodies_and_not_change_them() -> None:
    class Marks(ReferenceAdapter):
        mark = "framework_number"

        def start(self, container: Any) -> None:
            for member in container.members.values():
                for number in range(2):
                    setattr(member.body, self.mark, number)

    class Shadows(Marks):
        mark = "on_shutdown"

    class Meddles(ReferenceAdapter):
        def start(self, container: Any) -> None:
            for member in container.members.values():
                with contextlib.suppress(TypeError):
                    member.body.stage.recorder.recording = True

    steps = ["add_component component=s", "start"]
    connectable = {"s": SINK | {"connectable": True}}
    assert play(connectable, steps, Marks)[-1] == "return step=1"
    for adapter, what in (Shadows, "ConnectableProbe.on_shutdown"), (Meddles, "Recorder.recording"):
        refused = answer(scenario(connectable, steps), adapter)
        assert isinstance(refused, Refused), refused
        assert refused.reason.endswith(what)
    assert play(connectable, steps, Marks)[-1] == "return step=1"  # what one adapter does is unknown to the next
