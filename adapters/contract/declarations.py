"""Declarations: the probe bodies that a framework hosts in a scenario, and their actions in hooks.

``adapters.contract.scenario`` exports all names of this module.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal

from ucm_cts.adapters.contract import platform_interfaces as platform
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.execution_policies import *  # their names are names of this module, too
from ucm_cts.adapters.contract.timers import *
from ucm_cts.adapters.contract.timers import (
    INDEX_TIMERS,
    OBJECT_TIMER_METHODS,
    OBJECT_TIMERS,
    TIMER_METHODS,
    TIMER_SCHEDULER,
    TIMER_SERVICE,
)
from ucm_cts.adapters.contract.traits import Names
from ucm_cts.adapters.contract.value import Int32, Int64, Value

PortElementName = Annotated[str, Names("port element")]
"""How a port element is spelled at the Container API, ``<port>_<element>`` unless the adapter says otherwise."""

MethodName = Annotated[str, Names("method")]
Payload = Annotated[Int32, Names("payload")]


class RaiseError(Value, frozen=True, tag_field="do", tag="raise"):
    """The probe leaves the hook with an exception that no interface declares."""


class ReturnValue(Value, frozen=True, tag_field="do", tag="return"):
    """The probe's ``exchange`` returns a fixed value instead of its own computation.

    ``value``: the value.
    """

    value: Payload


class CallPort(Value, frozen=True, tag_field="do", tag="call"):
    """The probe calls ``exchange`` on every reference that it holds for a required port element.

    ``port``: the required port element.
    ``value``: the argument.
    """

    port: PortElementName
    value: Payload


class HoldAtGate(Value, frozen=True, tag_field="do", tag="hold"):
    """The probe waits inside the hook until the scenario opens a gate.

    ``gate``: name of the gate.
    """

    gate: Annotated[str, Names("gate")]


class QuerySiblings(Value, frozen=True, tag_field="do", tag="siblings"):
    """A fragment calls ``get_components`` of its container interface (11.2.1.4)."""


class Remembered(Value, frozen=True):
    """An argument that a body was given before, in place of one that a plan spells.

    ``argument``: the argument in whose place it stands, from 0.
    ``method``: the method that the body was entered at.
    ``position``: its argument there, from 0.
    ``nth``: the number of that entry among those at ``method``, from 1; 0 is the entry in which the body acts.
    """

    argument: Int32
    method: MethodName
    position: Int32
    nth: Int32 = 0


class FromClock(Value, frozen=True):
    """A time-out of 10.3.2 whose seconds count from what a clock of the body shows. The body reads the clock just before its call,
    and adds the seconds that the clock gave to those of the time-out.

    ``argument``: the time-out among the arguments, from 0.
    ``port``: the port element of the clock.
    ``method``: the method of the clock.
    """

    argument: Int32
    port: PortElementName
    method: MethodName


class TimerFrom(Value, frozen=True):
    """An object timer of 10.3.1 that a body was given before.

    ``method``: a method of the scheduler that returned it to the body, or ``on_trigger``, which handed it over.
    ``nth``: its number among the timers that came so, from 1; 0 is that of the entry in which the body acts.
    """

    method: MethodName
    nth: Int32 = 0


class CallMethod(Value, frozen=True, tag_field="do", tag="call_method"):
    """The probe calls a method on every reference that it holds for a required port element, or on one object timer.

    ``port``: the required port element: one of its own, or the ``element`` of a technical policy.
    ``method``: name of the method.
    ``arguments``: values of the IN and INOUT parameters, in order.
    ``remembered``: what takes the place of some of them. The probe does not call while it has not been given one of these.
    ``given``: it calls only if the body was entered at ``exchange`` with this value.
    ``from_clock``: the argument that is a date. The probe does not call if the clock gives no time.
    ``handler``: which of its handlers the body passes before the arguments, to a scheduler of object timers.
    ``on``: the object timer that is called. The probe does not call while it has not been given it.
    """

    port: PortElementName
    method: MethodName
    arguments: tuple[Datum, ...] = ()
    remembered: tuple[Remembered, ...] = ()
    given: Annotated[Int32 | None, Names("payload")] = None
    from_clock: FromClock | None = None
    handler: Annotated[str | None, Names("port element")] = None
    on: TimerFrom | None = None


class Answer(Value, frozen=True, tag_field="do", tag="answer"):
    """The probe answers a method. Without this action it gives no results.

    ``method``: name of the method.
    ``results``: values of the OUT, INOUT and RETURN parameters, or fields of the exception; by default the arguments.
    ``exception``: name of the declared exception to raise.
    ``overwrite``: afterwards overwrite the arguments, as the owner of an IN parameter may.
    """

    method: MethodName
    results: tuple[Datum, ...] | None = None
    exception: str | None = None
    overwrite: bool = False


class Burst(Value, frozen=True, tag_field="do", tag="burst"):
    """The probe pushes the messages ``first``, ``first + 1``, ... and records one event for all of them.

    ``port``: the required port element.
    ``first``: the first ULONG.
    ``count``: how many messages.
    """

    port: PortElementName
    first: Int64
    count: Int64


class CountMessages(Value, frozen=True, tag_field="do", tag="count"):
    """The probe counts the ULONGs that are pushed to it, answers ``ok`` and records no event of each."""


Action = RaiseError | ReturnValue | CallPort | HoldAtGate | QuerySiblings | CallMethod | Answer | Burst | CountMessages

Hook = Literal[
    "on_init",
    "on_startup",
    "on_shutdown",
    "on_remove",
    "on_connect",
    "on_disconnect",
    "set_container_interface",
    "exchange",
    "run",
    "method",
]
"""Where a probe is entered: the callbacks of clause 11.2.1, ``exchange``, the one business method of port elements without
interface, ``run`` of a self-executing component (10.1.3), and ``method``, any method of a port element with interface.
"""


CLOCK = "clock"
COMPONENT_TRACE = "component_trace"
PORT_TRACE = "port_trace"
"""The policies of the container services (10.1.4)."""

REQUIRED_ELEMENTS = {
    CLOCK: "clock_api",
    COMPONENT_TRACE: "trace_api",
    INDEX_TIMERS: TIMER_SERVICE,
    OBJECT_TIMERS: TIMER_SCHEDULER,
}
"""The port element that a component requires by such a policy."""

SERVICE_CONNECTOR: Final = "simple_service_connector"
MESSAGE_CONNECTOR: Final = "simple_message_connector"
"""The connectors of 10.1.5 and 10.1.6."""

PUSH = "push"
STANDARD_METHODS = frozenset(
    (PUSH, "get_local_time", "get_synchronized_time", "log", *platform.METHODS, *TIMER_METHODS, *OBJECT_TIMER_METHODS)
)
"""The methods of the platform's interfaces: of messages, the clock, the trace, timers and the connectors of 10.4."""

STANDARD_ELEMENTS = platform.ELEMENTS
"""Port elements whose names are those of the text."""

METHODS_TO_TRACE, LOG_SEVERITY = "methods_to_trace", "log_severity"
"""The parameters of port_trace."""


class Policy(Value, frozen=True):
    """A technical policy of a component implementation (9.5.4.3).

    ``definition``: name of the policy definition.
    ``port``: the port element that it applies to; none if it applies to the component.
    ``parameters``: values by parameter name.
    ``element``: name of the port element that the component requires by the policy (``REQUIRED_ELEMENTS``): ``policy.element``.
    ``settings``: the parameters of a policy of 10.5 (``PERIOD``, ``OFFSET``, ``PRIORITY``), times in microseconds.
    """

    definition: str
    port: PortElementName | None = None
    parameters: dict[str, str] = {}
    element: PortElementName | None = None
    settings: dict[str, Int64] = {}


class Declaration(Value, frozen=True):
    """A component implementation that the framework must be able to instantiate: a probe body and its plan.

    ``provides``: provided port elements.
    ``requires``: required port elements; none may be provided too.
    ``attributes``: configured values by attribute name.
    ``connectable``: the body implements Connectable (11.2.1.3).
    ``fragment``: the body implements FragmentObject (11.2.1.4).
    ``plan``: the actions of the probe in each hook, each time it is entered there.
    ``policies``: technical policies.
    ``ports``: the interface of each port element that has one, by name.
    ``defaults``: default values (9.2.7.4) by attribute name; they hold for attributes that are not configured.
    ``handlers``: the body's own handlers of object timers (10.3.1). Each is entered at ``method``, with its name as the port element.
    """

    provides: tuple[PortElementName, ...] = ()
    requires: tuple[PortElementName, ...] = ()
    attributes: dict[str, str] = {}
    connectable: bool = False
    fragment: bool = False
    plan: dict[Hook, tuple[Action, ...]] = {}
    policies: tuple[Policy, ...] = ()
    ports: dict[PortElementName, str] = {}
    defaults: dict[str, str] = {}
    handlers: tuple[PortElementName, ...] = ()

    def __post_init__(self) -> None:
        if len({*self.provides, *self.requires}) < len(self.provides) + len(self.requires):
            raise ValueError("a port element is declared twice")
