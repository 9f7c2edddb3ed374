"""Engine: answers wire messages by running scenarios against an adapter, as docs/protocol.md says."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import msgspec

from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.adapter import Adapter, NotOffered
from ucm_cts.adapters.contract.programming_model import BadParameter, NotFound, UcmError
from ucm_cts.adapters.contract.scenario import Scenario, Step
from ucm_cts.adapters.sdk.python.counting import Occupancy, Storm, switching_often
from ucm_cts.adapters.sdk.python.data import TooMany, at_most, in_words, shown
from ucm_cts.adapters.sdk.python.probe import Stage, is_integer
from ucm_cts.adapters.sdk.python.recorder import Recorder
from ucm_cts.adapters.sdk.python.seal import KeptClass, Seal
from ucm_cts.adapters.sdk.python.variables import Unbound, Variables
from ucm_cts.adapters.sdk.python.workers import Workers

_LONGEST_DETAIL = 200
_LONGEST_PATIENCE = 24 * 60 * 60 * 1000

_DECLARED: Mapping[type[Exception], t.ErrorName] = {
    NotFound: "NOT_FOUND",
    BadParameter: "BAD_PARAMETER",
    UcmError: "UCM_ERROR",
}


Emit = Callable[[bytes], object]


class ContractBroken(Exception):
    """The adapter returned something that is not of the type its contract declares."""


class Engine:
    """Serves one adapter class: one message in, one answer out, in order."""

    def __init__(self, adapter_class: type[Adapter]) -> None:
        self.adapter_class = adapter_class

    def answer(self, line: bytes, emit: Emit | None = None) -> bytes:
        """The answer to one line of the wire protocol, without newline. Never raises because of the line's content.

        ``emit`` receives the lines that come before the answer of a streamed run, each with its newline.
        """
        try:
            message = m.to_host_decoder().decode(line)
        except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
            return m.encode(m.refusal(line, f"not a message of protocol {m.PROTOCOL}: {error}"))
        if isinstance(message, m.Hello) and message.protocol != m.PROTOCOL:
            spoken = f"the harness speaks protocol {message.protocol}, this host speaks {m.PROTOCOL}"
            return m.encode(m.Refused(spoken))
        if isinstance(message, m.Hello):
            cls = self.adapter_class
            return m.encode(m.Welcome(m.PROTOCOL, cls.product, cls.version, cls.port_element_name))
        try:
            return m.encode(self._perform(message, emit))
        except Exception as error:  # noqa: BLE001 - a framework may raise anything
            return m.encode(m.Refused(_describe(error), message.id))

    def _perform(self, message: m.Run, emit: Emit | None) -> m.Traced:
        def sink(event: t.Event) -> None:
            assert emit
            emit(m.encode(m.Happened(message.id, event)) + b"\n")

        adapter = self.adapter_class()
        performance: Performance | None = None
        try:
            performance = Performance(adapter, message.scenario, Recorder(sink if message.stream and emit else None))
            return m.Traced(message.id, *performance.run())
        finally:
            if performance is None or not performance.stuck:
                adapter.close()


class Performance(metaclass=KeptClass):
    """One run of one scenario against one adapter. Making it creates the runtime."""

    def __init__(self, adapter: Adapter, scenario: Scenario, recorder: Recorder) -> None:
        patience = min(max(scenario.patience, 0), _LONGEST_PATIENCE) / 1000
        self.stuck: tuple[str, ...] = ()
        self._adapter = adapter
        self._patience = patience
        self._scenario = scenario
        self._recorder = recorder
        self._stage = Stage(recorder, patience)
        self._workers = Workers(patience)
        implementations = [
            self._stage.implementation(name, declaration, scenario.interfaces)
            for name, declaration in scenario.components.items()
        ]
        self._manager = adapter.create_runtime(implementations)
        self._variables = Variables(self._manager)
        self._destroyed = False

    def run(self) -> tuple[tuple[t.Event, ...], tuple[str, ...]]:
        """Take all steps; returns the events and the names of the threads that never came back.

        Raises ``ContractBroken`` if the adapter made it impossible to say what happened.
        """
        for number, step in enumerate(self._scenario.steps):
            if step.thread is None:
                self._take(number, step)
            else:
                self._workers.queue(step.thread, partial(self._take, number, step))
        self._stage.gates.open_all()
        self.stuck = self._workers.finish()
        events = self._recorder.stop()
        stage = self._stage
        parts = (part for probe in stage.probes for part in probe.parts())
        replaced = SEAL.broken(
            self, stage, self._recorder, self._workers, self._variables, stage.gates, stage.messages, *parts
        )
        if replaced or stage.recorder is not self._recorder:
            raise ContractBroken(f"the adapter replaces a part of the SDK: {replaced or 'the recorder'}")
        if not self.stuck and not self._destroyed:  # what a stuck thread holds could block destroy for ever
            with contextlib.suppress(Exception, SystemExit):
                self._adapter.destroy(self._manager)
        if self._recorder.complaint:
            raise ContractBroken(self._recorder.complaint)
        return events, self.stuck

    def _take(self, number: int, step: Step) -> None:
        record = self._recorder.record
        if isinstance(step, s.OpenGate):
            gate = step.gate
            self._stage.gates.open(gate, lambda: record(t.Opened, gate=gate))
        elif isinstance(step, s.ReachGate):
            if not self._stage.gates.reach(step.gate, step.more, step.total):
                record(t.Timeout, step=number)
        elif isinstance(step, s.Join):
            if not self._workers.join(step.worker):
                record(t.Timeout, step=number)
        elif isinstance(step, s.Settle):
            record(t.Settled, worker=step.worker, where=self._workers.settle(step.worker, self._stage.gates.is_held))
        elif isinstance(step, s.Pause):
            time.sleep(max(step.milliseconds, 0) / 1000)
            record(t.Paused, step=number, calendar=time.time_ns())
        elif isinstance(step, s.AwaitMessages):
            counted = self._stage.messages.wait(step.component, step.instance, step.count)
            record(t.Counted, step=number, component=step.component, instance=step.instance, **counted)
        elif isinstance(step, s.Stress):
            self._stress(number, step)
        else:
            self._call(number, step)

    def _stress(self, number: int, step: s.Stress) -> None:
        try:
            references = [self._variables.reference(ref) for ref in step.refs]
        except Unbound as missing:
            self._recorder.record(t.Skip, step=number, variable=missing.variable)
            return
        free = Occupancy()
        visits = [partial(reference.exchange, 1) for reference in references if reference is not None]
        with switching_often():
            with self._stage.stressing() as occupancies:
                through = self._storm(Storm(visits, step.milliseconds), "stress")
            control = self._storm(Storm([free.visit for _ in visits], step.milliseconds), "control")
        self._recorder.record(
            t.Stressed,
            step=number,
            calls=through.calls,
            overlaps=sum(occupancy.overlaps for occupancy in occupancies.values()),
            control_calls=control.calls,
            control_overlaps=free.overlaps,
            failed=through.failed,
        )

    def _storm(self, storm: Storm, name: str) -> Storm:
        workers = [f"{name} {index}" for index in range(len(storm.tasks()))]
        for worker, task in zip(workers, storm.tasks(), strict=True):
            self._workers.queue(worker, task)
        for worker in workers:
            self._workers.join(worker)
        return storm

    def _call(self, number: int, step: Step) -> None:
        record = self._recorder.record
        try:
            operate = _OPERATIONS[type(step)](self, step)
        except Unbound as missing:
            record(t.Skip, step=number, variable=missing.variable)
            return
        record(t.Call, step=number)
        try:
            value = operate()
        except NotOffered:
            record(t.Skip, step=number, variable=s.operation(step))
        except ContractBroken as error:
            self._recorder.complain(f"{s.operation(step)} {error}")
            record(t.Return, step=number)
        except (Exception, SystemExit) as error:  # noqa: BLE001 - a framework may raise anything
            declared = next((name for kind, name in _DECLARED.items() if isinstance(error, kind)), None)
            detail = _text(error) if declared else _describe(error)
            record(t.Raise, step=number, error=declared or "UNDECLARED", detail=detail)
        else:
            if step.returns == "records":
                record(t.Return, step=number, records=value)
            elif isinstance(step, s.Invoke):
                given: dict[str, Any] = {"value": int(value)} if is_integer(value) else {"wrong": in_words(value)}
                record(t.Return, step=number, **given)
            else:
                record(t.Return, step=number, value=value if step.returns else None)

    # Each method looks up what its step needs, raises Unbound, and returns the call that is then made and recorded.

    def _add_component(self, step: s.AddComponent) -> Callable[[], Any]:
        container = self._variables.container(step.container)
        declaration = self._scenario.components.get(step.component)
        attributes = dict(declaration.attributes) if declaration else {}

        def operate() -> int:
            given = _integer(self._adapter.add_component(container, step.component, attributes))
            self._variables.bind_id(step.bind or step.component, given)
            return given

        return operate

    def _remove_component(self, step: s.RemoveComponent) -> Callable[[], Any]:
        container, member = self._variables.container(step.container), self._variables.id(step.id)
        return partial(self._adapter.remove_component, container, member)

    def _get_port_element(self, step: s.GetPortElement) -> Callable[[], Any]:
        container, member = self._variables.container(step.container), self._variables.id(step.id)

        def operate() -> Any:
            reference = self._adapter.get_port_element(container, member, step.port)
            self._variables.bind_reference(step.bind, reference)
            return self._stage.recognise(reference)

        return operate

    def _connect(self, step: s.Connect) -> Callable[[], Any]:
        container, member = self._variables.container(step.container), self._variables.id(step.id)
        reference = self._variables.reference(step.to)

        def operate() -> int:
            given = _integer(self._adapter.connect(container, member, step.port, reference))
            self._variables.bind_id(step.bind, given)
            return given

        return operate

    def _disconnect(self, step: s.Disconnect) -> Callable[[], Any]:
        container, connection = self._variables.container(step.container), self._variables.id(step.connection)
        return partial(self._adapter.disconnect, container, connection)

    def _start(self, step: s.Start) -> Callable[[], Any]:
        container = self._variables.container(step.container)
        return partial(self._adapter.start, container)

    def _stop(self, step: s.Stop) -> Callable[[], Any]:
        container = self._variables.container(step.container)
        return partial(self._adapter.stop, container)

    def _get_components(self, step: s.GetComponents) -> Callable[[], Any]:
        container = self._variables.container(step.container)

        def operate() -> tuple[int, ...]:
            members = self._adapter.get_components(container)
            try:
                ids = tuple(map(_integer, at_most(members)))
            except TypeError:
                raise ContractBroken(f"returned {shown(members)}; it returns a sequence of integers") from None
            except TooMany as many:
                raise ContractBroken(f"returned {many} ids, which no scenario can have led to") from None
            self._variables.saw(ids)
            return ids

        return operate

    def _create_container(self, step: s.CreateContainer) -> Callable[[], Any]:
        def operate() -> None:
            self._variables.bind_container(step.bind, self._adapter.create_container(self._manager))

        return operate

    def _remove_container(self, step: s.RemoveContainer) -> Callable[[], Any]:
        container = self._variables.container(step.container)
        return partial(self._adapter.remove_container, self._manager, container)

    def _destroy(self, step: s.Destroy) -> Callable[[], Any]:
        def operate() -> None:
            self._adapter.destroy(self._manager)
            self._destroyed = True

        return operate

    def _invoke(self, step: s.Invoke) -> Callable[[], Any]:
        reference = self._variables.reference(step.ref)
        if reference is None:  # nothing can be called through a null reference
            raise Unbound(step.ref)
        return partial(reference.exchange, step.value)

    # Those that an adapter need not offer.

    def _link(self, step: s.Link) -> Callable[[], Any]:
        interface = self._scenario.interfaces[step.interface]

        def operate() -> None:
            self._variables.bind_link(step.bind, self._adapter.link(self._manager, step.connector, interface))

        return operate

    def _attach(self, step: s.Attach) -> Callable[[], Any]:
        link, container = self._variables.link(step.link), self._variables.container(step.container)
        member = self._variables.id(step.id)
        return partial(self._adapter.attach, link, step.role, container, member, step.port)

    def _detach(self, step: s.Detach) -> Callable[[], Any]:
        link, container = self._variables.link(step.link), self._variables.container(step.container)
        member = self._variables.id(step.id)
        return partial(self._adapter.detach, link, container, member, step.port)

    def _break(self, step: s.Break) -> Callable[[], Any]:
        return partial(self._adapter.break_link, self._variables.link(step.link), step.where)

    def _mend(self, step: s.Mend) -> Callable[[], Any]:
        return partial(self._adapter.mend_link, self._variables.link(step.link))

    def _read_log(self, step: s.ReadLog) -> Callable[[], Any]:
        def operate() -> tuple[t.LogRecord, ...]:
            until = time.monotonic() + self._patience
            while True:
                records = tuple(_records(self._adapter.read_log(self._manager)))
                if len(records) >= step.records or time.monotonic() >= until:
                    return records
                time.sleep(_BETWEEN_READINGS)

        return operate

    def _advance(self, step: s.Advance) -> Callable[[], Any]:
        return partial(self._adapter.advance, self._manager, step.milliseconds)


_OPERATIONS: dict[type[Any], Callable[[Performance, Any], Callable[[], Any]]] = {
    s.AddComponent: Performance._add_component,
    s.RemoveComponent: Performance._remove_component,
    s.GetPortElement: Performance._get_port_element,
    s.Connect: Performance._connect,
    s.Disconnect: Performance._disconnect,
    s.Start: Performance._start,
    s.Stop: Performance._stop,
    s.GetComponents: Performance._get_components,
    s.CreateContainer: Performance._create_container,
    s.RemoveContainer: Performance._remove_container,
    s.Destroy: Performance._destroy,
    s.Invoke: Performance._invoke,
    s.Link: Performance._link,
    s.Attach: Performance._attach,
    s.Detach: Performance._detach,
    s.Break: Performance._break,
    s.Mend: Performance._mend,
    s.ReadLog: Performance._read_log,
    s.Advance: Performance._advance,
}


_BETWEEN_READINGS = 0.001
"""Seconds. No event announces a record."""


def _records(given: Any) -> list[t.LogRecord]:
    try:
        records = [(severity, message) for severity, message in at_most(given)]
    except TooMany as many:
        raise ContractBroken(f"returned {many} records, which no scenario can have led to") from None
    except (TypeError, ValueError):
        raise ContractBroken(f"returned {shown(given)}; it returns pairs of severity and text") from None
    if not all(isinstance(text, str) for record in records for text in record):
        raise ContractBroken(f"returned {shown(records)}; it returns pairs of severity and text")
    return [t.LogRecord(severity, message) for severity, message in records]


def _integer(value: Any) -> int:
    if not is_integer(value):
        raise ContractBroken(f"returned {shown(value)}; it returns an integer")
    return int(value)


def _describe(error: BaseException) -> str:
    text = _text(error)
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def _text(error: BaseException) -> str:
    try:
        text = str(error)
    except Exception:  # noqa: BLE001 - the exception is the framework's
        return ""
    return text[:_LONGEST_DETAIL].encode("utf-8", "replace").decode()


_PARTS = ("counting", "data", "engine", "gates", "probe", "recorder", "seal", "variables", "workers")


def sealed() -> Seal:
    """The SDK as it is now."""
    return Seal(sys.modules[f"{__package__}.{part}"] for part in _PARTS)


SEAL = sealed()
"""The parts of the SDK that an adapter might change to falsify a trace; made before any adapter is loaded."""
