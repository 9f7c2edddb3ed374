"""Operations: the steps in which the framework takes part, each as a call of the adapter."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import monotonic, sleep  # an adapter may change what the module has, not these
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.scenario import Scenario, Step
from ucm_cts.adapters.sdk.python.data import TooMany, at_most, shown
from ucm_cts.adapters.sdk.python.probe import Stage, is_integer
from ucm_cts.adapters.sdk.python.seal import KeptClass
from ucm_cts.adapters.sdk.python.variables import Unbound, Variables

_BETWEEN_READINGS = 0.001
"""Seconds. No event announces a record."""


class ContractBroken(Exception):
    """The adapter returned something that is not of the type its contract declares."""


class Operations(metaclass=KeptClass):
    """The calls of one scenario.

    ``has_destroyed``: the runtime was destroyed.
    """

    def __init__(self, adapter: Adapter, manager: Any, scenario: Scenario, stage: Stage, patience: float) -> None:
        """``manager`` is what the adapter uses for the runtime; ``patience`` is in seconds."""
        self._adapter = adapter
        self._manager = manager
        self._scenario = scenario
        self._stage = stage
        self._patience = patience
        self._variables = Variables(manager)
        self.has_destroyed = False

    def call_of(self, step: Step) -> Callable[[], Any]:
        """The call that ``step`` makes. Raises ``Unbound`` if a variable that it needs has no value."""
        return _CALLS[type(step)](self, step)

    def bind(self, step: Step, result: Any) -> None:
        """Bind what the call of ``step`` returned to the variable of the step, if it has one."""
        match step:
            case s.AddComponent():
                self._variables.bind_id(step.bind or step.component, result)
            case s.Connect():
                self._variables.bind_id(step.bind, result)
            case s.GetPortElement():
                self._variables.bind_reference(step.bind, result)
            case s.CreateContainer():
                self._variables.bind_container(step.bind, result)
            case s.Link():
                self._variables.bind_link(step.bind, result)
            case s.GetComponents():
                self._variables.saw(result)

    def parts(self) -> tuple[object, ...]:
        """The objects of the SDK that an adapter must not change: this one, and those that it is made of."""
        return self, self._variables

    def reference(self, variable: str) -> Any:
        """The reference that ``variable`` holds, None if it is null. Raises ``Unbound``."""
        return self._variables.reference(variable)

    def _add_component(self, step: s.AddComponent) -> Callable[[], Any]:
        container = self._variables.container(step.container)
        declaration = self._scenario.components.get(step.component)
        attributes = dict(step.attributes)
        for name, value in declaration.attributes.items() if declaration else ():
            attributes.setdefault(name, value)

        return lambda: _integer(self._adapter.add_component(container, step.component, attributes))

    def _remove_component(self, step: s.RemoveComponent) -> Callable[[], Any]:
        container, member = self._variables.container(step.container), self._variables.id(step.id)
        return partial(self._adapter.remove_component, container, member)

    def _get_port_element(self, step: s.GetPortElement) -> Callable[[], Any]:
        container, member = self._variables.container(step.container), self._variables.id(step.id)
        return partial(self._adapter.get_port_element, container, member, step.port)

    def _connect(self, step: s.Connect) -> Callable[[], Any]:
        container, member = self._variables.container(step.container), self._variables.id(step.id)
        reference = self._variables.reference(step.to)
        return lambda: _integer(self._adapter.connect(container, member, step.port, reference))

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
            return ids

        return operate

    def _create_container(self, step: s.CreateContainer) -> Callable[[], Any]:
        return partial(self._adapter.create_container, self._manager)

    def _remove_container(self, step: s.RemoveContainer) -> Callable[[], Any]:
        container = self._variables.container(step.container)
        return partial(self._adapter.remove_container, self._manager, container)

    def _destroy(self, step: s.Destroy) -> Callable[[], Any]:
        def operate() -> None:
            self._adapter.destroy(self._manager)
            self.has_destroyed = True

        return operate

    def _invoke(self, step: s.Invoke) -> Callable[[], Any]:
        reference = self._variables.reference(step.ref)
        if reference is None:  # nothing can be called through a null reference
            raise Unbound(step.ref)
        return partial(reference.exchange, step.value)

    # Those that an adapter need not offer.

    def _link(self, step: s.Link) -> Callable[[], Any]:
        types = self._scenario.types.get(step.interface)
        if types is not None:
            return partial(self._adapter.link_with_types, self._manager, step.connector, types)
        return partial(self._adapter.link, self._manager, step.connector, self._scenario.interfaces[step.interface])

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
            until = monotonic() + self._patience
            while True:
                records = tuple(_records(self._adapter.read_log(self._manager)))
                if len(records) >= step.records or monotonic() >= until:
                    return records
                sleep(_BETWEEN_READINGS)

        return operate

    def _advance(self, step: s.Advance) -> Callable[[], Any]:
        return partial(self._adapter.advance, self._manager, step.milliseconds)


_CALLS: dict[type[Any], Callable[[Operations, Any], Callable[[], Any]]] = {
    s.AddComponent: Operations._add_component,
    s.RemoveComponent: Operations._remove_component,
    s.GetPortElement: Operations._get_port_element,
    s.Connect: Operations._connect,
    s.Disconnect: Operations._disconnect,
    s.Start: Operations._start,
    s.Stop: Operations._stop,
    s.GetComponents: Operations._get_components,
    s.CreateContainer: Operations._create_container,
    s.RemoveContainer: Operations._remove_container,
    s.Destroy: Operations._destroy,
    s.Invoke: Operations._invoke,
    s.Link: Operations._link,
    s.Attach: Operations._attach,
    s.Detach: Operations._detach,
    s.Break: Operations._break,
    s.Mend: Operations._mend,
    s.ReadLog: Operations._read_log,
    s.Advance: Operations._advance,
}


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
