"""Engine: answers wire messages by running scenarios against an adapter, as docs/protocol.md says."""

from __future__ import annotations

import contextlib
import itertools
import sys
import threading
from collections.abc import Callable, Mapping
from functools import partial
from time import sleep, time_ns  # an adapter may change what the module has, not these
from typing import Any

import msgspec

from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.adapter import Adapter, NotOffered
from ucm_cts.adapters.contract.programming_model import BadParameter, NotFound, UcmError
from ucm_cts.adapters.contract.scenario import Scenario, Step
from ucm_cts.adapters.sdk.python.counting import Occupancy, Storm, switching_often
from ucm_cts.adapters.sdk.python.data import in_words
from ucm_cts.adapters.sdk.python.operations import ContractBroken, Operations
from ucm_cts.adapters.sdk.python.probe import Stage, is_integer
from ucm_cts.adapters.sdk.python.recorder import Recorder
from ucm_cts.adapters.sdk.python.seal import KeptClass, Seal, replaces
from ucm_cts.adapters.sdk.python.variables import Unbound
from ucm_cts.adapters.sdk.python.workers import Workers

_LONGEST_DETAIL = 200
_LONGEST_PATIENCE = 24 * 60 * 60 * 1000

_DECLARED: Mapping[type[Exception], t.ErrorName] = {
    NotFound: "NOT_FOUND",
    BadParameter: "BAD_PARAMETER",
    UcmError: "UCM_ERROR",
}


Emit = Callable[[bytes], object]


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
        self._scenario = scenario
        self._recorder = recorder
        self._stage = Stage(recorder, patience)
        self._workers = Workers(patience)
        implementations = [
            self._stage.implementation(name, declaration, scenario.interfaces)
            for name, declaration in scenario.components.items()
        ]
        self._manager = adapter.create_runtime(implementations)
        self._operations = Operations(adapter, self._manager, scenario, self._stage, patience)
        self._turn = threading.Lock()

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
        replaced = (next(_TURNS) and CONTRACT.broken()) or SEAL.broken(
            self, stage, self._recorder, self._workers, *self._operations.parts(), stage.gates, stage.messages, *parts
        )
        if replaced or stage.recorder is not self._recorder:
            raise ContractBroken(replaces(replaced or "the recorder"))
        # what a stuck thread holds could block destroy for ever
        if not self.stuck and not self._operations.has_destroyed:
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
            sleep(max(step.milliseconds, 0) / 1000)
            record(t.Paused, step=number, calendar=time_ns())
        elif isinstance(step, s.AwaitMessages):
            counted = self._stage.messages.wait(step.component, step.instance, step.count)
            record(t.Counted, step=number, component=step.component, instance=step.instance, **counted)
        elif isinstance(step, s.Stress):
            self._stress(number, step)
        else:
            self._call(number, step)

    def _stress(self, number: int, step: s.Stress) -> None:
        try:
            references = [self._operations.reference(ref) for ref in step.refs]
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
        # in one turn, so that the trace has a variable bound before it has it used
        with self._turn:
            try:
                operate = self._operations.call_of(step)
            except Unbound as missing:
                record(t.Skip, step=number, variable=missing.variable)
                return
            record(t.Call, step=number)
        try:
            result = operate()
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
            recorded = self._recorded(step, result)
            with self._turn:
                self._operations.bind(step, result)
                record(t.Return, step=number, **recorded)

    def _recorded(self, step: Step, result: Any) -> dict[str, Any]:
        """The fields of the event that say what the call of ``step`` returned."""
        if step.returns == "records":
            return {"records": result}
        if isinstance(step, s.Invoke):
            return {"value": int(result)} if is_integer(result) else {"wrong": in_words(result)}
        if isinstance(step, s.GetPortElement):
            return {"value": self._stage.recognise(result)}
        return {"value": result if step.returns else None}


def _describe(error: BaseException) -> str:
    text = _text(error)
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def _text(error: BaseException) -> str:
    try:
        text = str(error)
    except Exception:  # noqa: BLE001 - the exception is the framework's
        return ""
    return text[:_LONGEST_DETAIL].encode("utf-8", "replace").decode()


_PARTS = (
    "calls",
    "counting",
    "data",
    "engine",
    "gates",
    "memory",
    "operations",
    "probe",
    "probe_parts",
    "reach",
    "recorder",
    "seal",
    "variables",
    "workers",
)
_CONTRACT = ("adapter", "container_calls", "data_types", "messages", "programming_model", "scenario", "trace", "value")

_TURNS = itertools.cycle((True, *[False] * 7))
"""In which scenarios the contract is looked at, too: it has many classes, and nothing in it records."""

CONTRACT = Seal()
SEAL = Seal()
"""What an adapter might change to falsify a trace, as it is before any adapter is loaded: the contract and the parts of the SDK."""
CONTRACT.remember(sys.modules[f"ucm_cts.adapters.contract.{part}"] for part in _CONTRACT)
SEAL.remember((sys.modules[f"{__package__}.{part}"] for part in _PARTS), keeps=True)
