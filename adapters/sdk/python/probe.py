"""Probes: component bodies that record each call of the framework and follow their plan."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.data_types import Datum, Interface
from ucm_cts.adapters.contract.scenario import Action, Declaration, Hook
from ucm_cts.adapters.sdk.python.calls import call_port, call_timer, is_timer, schedule
from ucm_cts.adapters.sdk.python.counting import MessageCounts, Occupancy
from ucm_cts.adapters.sdk.python.data import (
    TooMany,
    at_most,
    in_words,
    is_datum,
    named,
    overwrite,
    overwrite_parts,
    read_connections,
    snapshot,
)
from ucm_cts.adapters.sdk.python.gates import Gates
from ucm_cts.adapters.sdk.python.memory import Entry, Memory
from ucm_cts.adapters.sdk.python.probe_parts import ProbeExecution, ProbeHandler, ProbePort
from ucm_cts.adapters.sdk.python.recorder import Recorder
from ucm_cts.adapters.sdk.python.seal import Kept, KeptClass


def is_integer(value: object) -> bool:
    """Can the wire carry it? The monitor checks whether it has 32 bits."""
    return isinstance(value, int) and -(2**63) <= value < 2**63


class PlannedFailure(Exception):
    """What a probe raises when its plan says ``raise``: an exception no interface declares."""


class Stage(Kept):
    """What the ``probes`` of one scenario share. ``patience`` is the longest wait of a probe, in seconds."""

    __slots__ = ("_instances", "_lock", "gates", "messages", "occupancies", "probes", "recorder")

    def __init__(self, recorder: Recorder, patience: float) -> None:
        self.recorder = recorder
        self.probes: list[Probe] = []
        self.gates = Gates(patience)
        self.messages = MessageCounts(patience)
        self.occupancies: dict[int, Occupancy] | None = None
        self._lock = threading.Lock()
        self._instances: dict[str, int] = {}

    def implementation(
        self, name: str, declaration: Declaration, interfaces: Mapping[str, Interface] = {}
    ) -> pm.Implementation:
        """The declaration as a framework sees it: an implementation whose bodies are probes on this stage."""
        kind = _KINDS[declaration.connectable, declaration.fragment]
        return pm.Implementation(
            name,
            declaration.provides,
            declaration.requires,
            tuple({**declaration.attributes, **declaration.defaults}),
            declaration.connectable,
            declaration.fragment,
            lambda: kind(self, name, declaration),
            declaration.policies,
            {port: interfaces[interface] for port, interface in declaration.ports.items()},
            declaration.defaults,
        )

    @contextmanager
    def stressing(self) -> Iterator[dict[int, Occupancy]]:
        """Until the block ends probes record and do nothing, and count overlaps: occupancies by probe."""
        occupancies = self.occupancies = {}
        try:
            yield occupancies
        finally:
            self.occupancies = None

    def number(self, probe: Probe, component: str) -> int:
        """Number the next body made for ``component``, from 1, and record its creation."""
        with self._lock:
            self.probes.append(probe)
            instance = self._instances[component] = self._instances.get(component, 0) + 1
            self.recorder.record(t.Create, component=component, instance=instance)
            return instance

    def recognise(self, reference: Any) -> t.MaybeReference:
        """What the trace calls ``reference``: a probe's own port element is recognised, anything else is opaque."""
        if reference is None:
            return None
        if isinstance(reference, ProbePort) and reference.probe.stage is self:
            return reference.identity
        return "opaque"


class Probe(pm.ComponentObject, metaclass=KeptClass):
    """The ``instance``-th body made for ``component``. Silent, and without a plan, once the recording has stopped."""

    def __init__(self, stage: Stage, component: str, declaration: Declaration) -> None:
        self.stage = stage
        self.component = component
        self.instance = stage.number(self, component)
        self._plan = declaration.plan
        self._ports = {port: ProbePort(self, port) for port in declaration.provides}
        executes_itself = any(s.is_self_executing(policy.definition) for policy in declaration.policies)
        self._execution = ProbeExecution(self) if executes_itself else None
        has_timers = any(policy.definition == s.INDEX_TIMERS for policy in declaration.policies)
        self._timer_callback = ProbePort(self, s.TIMER_CALLBACK) if has_timers else None
        self._handlers = {name: ProbeHandler(self, name) for name in declaration.handlers}
        self._attributes: dict[str, str] = {}
        self._references: dict[str, list[pm.PortElementObject]] = {}
        self._given = Memory(declaration.plan)
        self._container: pm.ContainerInterface | None = None

    def parts(self) -> tuple[object, ...]:
        """All that frameworks are given of it."""
        elements = filter(None, [self._execution, self._timer_callback])
        return (self, *self._ports.values(), *self._handlers.values(), *elements)

    def set_attribute(self, name: str, value: str) -> None:
        if isinstance(name, str):
            self._attributes[name] = value if isinstance(value, str) else in_words(value)

    def on_init(self) -> None:
        self._visit("on_init", attributes=dict(self._attributes))

    def on_startup(self, dependencies: Sequence[pm.PortConnection]) -> None:
        given, wrong = read_connections(dependencies)
        self._references = {}
        for port, references in given:
            self._references.setdefault(port, []).extend(r for r in references if r is not None)
        recognise = self.stage.recognise
        self._visit(
            "on_startup",
            dependencies=tuple(t.Dependency(port, tuple(map(recognise, references))) for port, references in given),
            wrong=wrong,
        )

    def on_shutdown(self) -> None:
        try:
            self._visit("on_shutdown")
        finally:
            self._references = {}

    def on_remove(self) -> None:
        try:
            self._visit("on_remove")
        finally:
            self._container = None

    def get_portElement(self, provided: str) -> pm.PortElementObject | None:
        return self._ports.get(provided) if isinstance(provided, str) else None

    def get_policy_element(self, policy: str, element: str) -> pm.ComponentExecution | None:
        asked = isinstance(policy, str) and s.is_self_executing(policy) and element == s.SELF_EXECUTION_API
        return self._execution if asked else None

    def get_policy_port(self, policy: str, element: str) -> pm.PortElementObject | None:
        return self._timer_callback if (policy, element) == (s.INDEX_TIMERS, s.TIMER_CALLBACK) else None

    def run(self) -> None:
        """What the container of a self-executing probe calls."""
        if not self._is_stressed():
            self._visit("run")

    def _is_stressed(self) -> bool:
        """Under stress: count overlaps; True if the probe has nothing else to do."""
        occupancies = self.stage.occupancies
        if occupancies is None:
            return False
        occupancies.setdefault(id(self), Occupancy()).visit()
        return True

    def exchange(self, port: str, value: int) -> int:
        """The business method of provided port element ``port``."""
        if self._is_stressed():
            return ~value
        given: dict[str, Any] = {"value": int(value)} if is_integer(value) else {"wrong": in_words(value)}
        result = self._visit("exchange", result=~value if is_integer(value) else -1, port=port, **given)
        assert result is not None
        return result

    def call(self, port: str, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        """Any method of provided port element ``port``, which has an interface."""
        plan = self._plan.get("method", ())
        if not self.stage.recorder.recording:
            return []
        wrong = ""
        if not (isinstance(arguments, list | tuple) and is_datum(arguments)):
            wrong, arguments = in_words(arguments), []
        counts = any(isinstance(action, s.CountMessages) for action in plan)
        if counts and not wrong and not (arguments and is_integer(arguments[0])):
            wrong = in_words(arguments)
        if counts and not wrong:
            self.stage.messages.add(self.component, self.instance, int(arguments[0]))  # type: ignore[arg-type]
            return ["ok"]
        given = snapshot(arguments)
        entry = self._enter(port, method, given, wrong)
        answer = self._follow(method, entry)
        results = snapshot(given if answer.results is None else answer.results)
        self._record(t.Exit, hook="method", results=snapshot(results), exception=answer.exception)
        if answer.overwrite and isinstance(arguments, list):
            overwrite(arguments)
        if answer.exception is not None:
            raise pm.DeclaredException(answer.exception, results)
        return list(results)

    def on_trigger(self, handler: str, timer: Any, delta_time: Any, round_: Any) -> None:
        """The method of its ``handler``, which gives no results."""
        if not self.stage.recorder.recording:
            return
        arguments = [delta_time, round_]
        if not is_timer(timer):
            wrong = f"{in_words(timer)} as the timer"
        else:
            wrong = "" if is_datum(arguments) else in_words(arguments)
        given = snapshot(arguments) if not wrong else ()
        entry = self._enter(handler, s.ON_TRIGGER, given, wrong, None if wrong else timer)
        self._follow(s.ON_TRIGGER, entry)
        self._record(t.Exit, hook="method", results=())

    def _enter(self, port: str, method: str, given: tuple[Datum, ...], wrong: str, timer: Any = None) -> Entry:
        """Record an entry at a method, with the object timer that came with it."""

        def record(entry: Entry) -> None:
            self._record(
                t.Enter,
                hook="method",
                port=port,
                method=method,
                arguments=given,
                wrong=wrong,
                timer=entry.timer,
            )

        return self._given.entry(method, given, record, timer)

    def _follow(self, method: str, entry: Entry) -> s.Answer:
        """Carry out the plan for an entry at ``method``; returns what it answers."""
        answer = s.Answer(method, ())
        for action in self._plan.get("method", ()):
            if isinstance(action, s.RaiseError):
                self._record(t.Exit, hook="method", raised=True)
                raise PlannedFailure(f"{self.component} fails in {method}, as planned")
            if not isinstance(action, s.Answer):
                self._act(action, entry)
            elif action.method == method:
                answer = action
        return answer

    def _visit(self, hook: Hook, result: int | None = None, **arguments: Any) -> int | None:
        """Record ``enter``, carry out the plan, record ``exit``; returns the hook's result."""
        if not self.stage.recorder.recording:
            return result
        self._record(t.Enter, hook=hook, **arguments)
        entry = Entry(value=arguments.get("value"))
        for action in self._plan.get(hook, ()):
            if isinstance(action, s.RaiseError):
                self._record(t.Exit, hook=hook, raised=True)
                raise PlannedFailure(f"{self.component} fails in {hook}, as planned")
            if isinstance(action, s.ReturnValue):
                if hook == "exchange":
                    result = action.value
            else:
                self._act(action, entry)
        self._record(t.Exit, hook=hook, value=result)
        return result

    def _act(self, action: Action, entry: Entry) -> None:
        """Carry out ``action`` of the plan for ``entry``."""
        if isinstance(action, s.CallPort):
            for reference in tuple(self._references.get(action.port, ())):
                self._call(action.port, reference, action.value)
        elif isinstance(action, s.CallMethod):
            self._act_on(action, entry)
        elif isinstance(action, s.Burst):
            for reference in tuple(self._references.get(action.port, ())):
                self._push(action, reference)
        elif isinstance(action, s.HoldAtGate):
            gate = action.gate
            self.stage.gates.hold(gate, lambda: self._record(t.Held, gate=gate))
        elif isinstance(action, s.QuerySiblings):
            self._query_siblings()

    def _act_on(self, action: s.CallMethod, entry: Entry) -> None:
        """Make the calls of ``action``, if what they need is there."""
        arguments = self._given.arguments(action, entry)
        if arguments is not None and action.from_clock is not None:
            arguments = self._dated(action.from_clock, arguments)
        if arguments is None:
            return
        if action.on is not None:
            found = self._given.timer(action.on, entry)
            if found is not None:
                number, timer = found
                self._call_method(action, call_timer(timer, action.method), arguments, number)
            return
        for reference in tuple(self._references.get(action.port, ())):
            if action.handler is not None:
                call = schedule(reference, action.method, self._handlers.get(action.handler))
            else:
                call = call_port(reference, action.method)
            self._call_method(action, call, arguments)

    def _dated(self, of: s.FromClock, arguments: tuple[Datum, ...]) -> tuple[Datum, ...] | None:
        """``arguments`` with a date; None if the body holds no clock, or it gives no time."""
        clocks = self._references.get(of.port, ())
        reading = s.CallMethod(of.port, of.method)
        time = self._call_method(reading, call_port(clocks[0], of.method), ()) if clocks else ()
        return s.date_from(arguments, of.argument, time)

    def _call(self, port: str, reference: pm.PortElementObject, value: int) -> None:
        self._record(t.Request, port=port, value=value)
        try:
            result = reference.exchange(value)
        except Exception:  # noqa: BLE001 - the callee may raise anything
            self._record(t.Reply, port=port, raised=True)
            return
        given: dict[str, Any] = {"value": int(result)} if is_integer(result) else {"wrong": in_words(result)}
        self._record(t.Reply, port=port, **given)

    def _call_method(
        self,
        action: s.CallMethod,
        call: Callable[[list[Datum]], Any],
        given: tuple[Datum, ...],
        timer: int | None = None,
    ) -> Sequence[Datum]:
        """Returns the results as recorded, nothing if it raised. ``timer`` is the number of the object timer that is called."""
        arguments = list(snapshot(given))
        answer: Sequence[Datum] = ()
        self._record(
            t.Request,
            port=action.port,
            method=action.method,
            arguments=given,
            handler=action.handler,
            timer=timer,
        )
        try:
            results = call(arguments)
        except pm.DeclaredException as error:
            answer = self._reply(action, error.fields, error.name)
        except Exception:  # noqa: BLE001 - the callee may raise anything
            self._record(t.Reply, port=action.port, raised=True)
        else:
            answer = self._reply(action, results)
        overwrite(arguments)  # they are the caller's own
        return answer

    def _reply(self, action: s.CallMethod, results: Any, exception: str | None = None) -> Sequence[Datum]:
        wrong = ""
        if action.handler is not None and exception is None:
            self._reply_with_timer(action, results)
            return ()
        if not (isinstance(results, list | tuple) and is_datum(results)):
            wrong, results = in_words(results), ()
        elif not isinstance(exception, str | None):
            wrong, exception = f"an exception called {in_words(exception)}", None
        given = snapshot(results)
        self._record(t.Reply, port=action.port, results=given, exception=exception, wrong=wrong)
        overwrite_parts(results)  # they are the caller's own
        return () if exception is not None else given

    def _reply_with_timer(self, action: s.CallMethod, results: Sequence[Any]) -> None:
        """A scheduler has returned: a timer, nothing, or anything else."""

        def record(number: int | None = None, wrong: str = "") -> None:
            self._record(t.Reply, port=action.port, results=(), wrong=wrong, timer=number)

        if not results:
            record()
        elif is_timer(results[0]):
            self._given.take_timer(action.method, results[0], record)
        else:
            record(wrong=f"{in_words(results[0])} as the timer")

    def _push(self, action: s.Burst, reference: pm.PortElementObject) -> None:
        answers: dict[str, int] = {}
        for value in range(action.first, action.first + action.count):
            try:
                results = reference.call(s.PUSH, [value])
                code = str(results[0]) if results else ""
            except Exception:  # noqa: BLE001 - the callee may raise anything
                code = "raised"
            answers[code] = answers.get(code, 0) + 1
        self._record(t.Pushed, port=action.port, first=action.first, count=action.count, answers=answers)

    def _query_siblings(self) -> None:
        try:
            if self._container is None:
                raise LookupError("no container interface was given")
            members = self._container.get_components()
        except Exception:  # noqa: BLE001 - the framework may raise anything
            self._record(t.Siblings, raised=True)
            return
        try:
            ids: tuple[Any, ...] = at_most(members)
        except TooMany as many:
            self._record(t.Siblings, wrong=f"{many} ids")
            return
        except Exception:  # noqa: BLE001 - the object is the framework's
            ids = (None,)
        given: dict[str, Any] = (
            {"ids": tuple(map(int, ids))} if all(map(is_integer, ids)) else {"wrong": in_words(members)}
        )
        self._record(t.Siblings, **given)

    def _record(self, kind: Any, **fields: Any) -> None:
        self.stage.recorder.record(kind, component=self.component, instance=self.instance, **fields)


class ConnectableProbe(Probe, pm.Connectable):
    """A probe that is informed of each connection."""

    def on_connect(self, port_name: str, required: pm.PortElementObject | None) -> None:
        self._visit("on_connect", reference=self.stage.recognise(required), **named(port_name))

    def on_disconnect(self, port_name: str) -> None:
        self._visit("on_disconnect", **named(port_name))


class FragmentProbe(Probe, pm.FragmentObject):
    """A probe that is a fragment."""

    def set_container_interface(self, container: pm.ContainerInterface) -> None:
        self._container = container
        self._visit("set_container_interface")


class ConnectableFragmentProbe(ConnectableProbe, FragmentProbe):
    """A fragment that is informed of each connection."""


_KINDS: dict[tuple[bool, bool], type[Probe]] = {
    (False, False): Probe,
    (True, False): ConnectableProbe,
    (False, True): FragmentProbe,
    (True, True): ConnectableFragmentProbe,
}
