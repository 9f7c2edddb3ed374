"""Scenario: a plain list of steps with symbolic variables, as it travels to a host.

A scenario never says what to expect. Its component declarations describe the probe bodies the framework shall host;
its steps are Container API calls (clause 12.10), stimuli through provided port elements, and gates.

Variables are names bound by a step (``bind``) and used by later ones. Two are always there: ``UNKNOWN`` designates an
identifier the framework never gave out, ``NIL`` a null reference. ``MANAGER`` is the runtime's root container.
"""

from __future__ import annotations

from typing import Literal, get_args

from ucm_cts.adapters.contract.data_types import Datum, Interface
from ucm_cts.adapters.contract.value import Int32, Int64, Value

MANAGER = "manager"
UNKNOWN = "unknown"
NIL = "nil"

PortElementName = str
"""How a port element is spelled at the Container API, ``<port>_<element>`` unless the adapter says otherwise."""


class RaiseError(Value, frozen=True, tag_field="do", tag="raise"):
    """The probe leaves the hook with an exception that no interface declares."""


class ReturnValue(Value, frozen=True, tag_field="do", tag="return"):
    """The probe's ``exchange`` returns ``value`` instead of its own computation."""

    value: Int32


class CallPort(Value, frozen=True, tag_field="do", tag="call"):
    """The probe calls ``exchange(value)`` on every reference it holds for its required port element ``port``."""

    port: PortElementName
    value: Int32


class HoldAtGate(Value, frozen=True, tag_field="do", tag="hold"):
    """The probe waits inside the hook until the scenario opens ``gate``."""

    gate: str


class QuerySiblings(Value, frozen=True, tag_field="do", tag="siblings"):
    """A fragment asks the container interface it was given for ``get_components`` (11.2.1.4)."""


class CallMethod(Value, frozen=True, tag_field="do", tag="call_method"):
    """The probe calls ``method`` with ``arguments`` (IN and INOUT) on every reference it holds for required port element
    ``port``: one of its own, or of a technical policy (its ``element``).
    """

    port: PortElementName
    method: str
    arguments: tuple[Datum, ...] = ()


class Answer(Value, frozen=True, tag_field="do", tag="answer"):
    """How the probe answers ``method``: with ``results`` (OUT, INOUT and RETURN), with its own arguments if there are
    none given, or with the declared ``exception`` whose fields are ``results``. Without an answer it gives no results.

    With ``overwrite`` it then overwrites what it was given, as the owner of an IN parameter may.
    """

    method: str
    results: tuple[Datum, ...] | None = None
    exception: str | None = None
    overwrite: bool = False


class Burst(Value, frozen=True, tag_field="do", tag="burst"):
    """The probe pushes ``count`` messages through ``port``: the ULONGs ``first``, ``first + 1``, ... One event tells of all."""

    port: PortElementName
    first: Int64
    count: Int64


class CountMessages(Value, frozen=True, tag_field="do", tag="count"):
    """The probe counts the ULONGs that are pushed to it and records nothing of each; answers ``ok``."""


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


SELF_EXECUTING = "protected_self-executing_component"
ACTIVE = "protected_active_component"
PROTECTED_PASSIVE = "protected_passive_component"
UNPROTECTED_PASSIVE = "unprotected_passive_component"
"""The four execution policies of 10.1.3."""

SELF_EXECUTION_API = "self-execution_api"
"""The port element that a self-executing component provides to its container."""


CLOCK = "clock"
COMPONENT_TRACE = "component_trace"
PORT_TRACE = "port_trace"
"""The policies of the container services (10.1.4)."""

REQUIRED_ELEMENTS = {CLOCK: "clock_api", COMPONENT_TRACE: "trace_api"}
"""The port element that a component requires by such a policy."""

SERVICE_CONNECTOR = "simple_service_connector"
MESSAGE_CONNECTOR = "simple_message_connector"
"""The connectors of 10.1.5 and 10.1.6."""

PUSH = "push"
STANDARD_METHODS = frozenset((PUSH, "get_local_time", "get_synchronized_time", "log"))
"""The methods of 10.1's interfaces: of messages, the clock and the trace."""

METHODS_TO_TRACE, LOG_SEVERITY = "methods_to_trace", "log_severity"
"""The parameters of port_trace."""


class Policy(Value, frozen=True):
    """A technical policy of a component implementation (9.5.4.3): its ``definition`` and, of some, the ``port`` element.

    ``element`` is the name under which the component gets the port element that it requires by the policy
    (``REQUIRED_ELEMENTS``): the policy instance and the element.
    """

    definition: str
    port: PortElementName | None = None
    parameters: dict[str, str] = {}
    element: PortElementName | None = None


class Declaration(Value, frozen=True):
    """One component implementation the framework shall be able to instantiate: a probe body and its plan.

    ``provides`` and ``requires`` list port element names; ``attributes`` maps attribute names to configured values;
    ``connectable`` bodies implement Connectable (11.2.1.3), ``fragment`` bodies FragmentObject (11.2.1.4).
    ``policies`` are its technical policies. ``plan`` lists, per hook, the actions the probe performs each time it is
    entered there. ``ports`` names the interface of each port element that has one. No port element twice.
    """

    provides: tuple[PortElementName, ...] = ()
    requires: tuple[PortElementName, ...] = ()
    attributes: dict[str, str] = {}
    connectable: bool = False
    fragment: bool = False
    plan: dict[Hook, tuple[Action, ...]] = {}
    policies: tuple[Policy, ...] = ()
    ports: dict[PortElementName, str] = {}

    def __post_init__(self) -> None:
        if len({*self.provides, *self.requires}) < len(self.provides) + len(self.requires):
            raise ValueError("a port element is declared twice")


class StepBase(Value, frozen=True, kw_only=True):
    """Common to all steps. With ``thread`` the step runs on that worker thread and the scenario goes on at once."""

    thread: str | None = None


class AddComponent(StepBase, frozen=True, tag_field="op", tag="add_component"):
    """``add_component`` for an instance of declaration ``component``; the id is bound to ``bind`` or ``component``.

    A ``component`` that the scenario does not declare asks for an implementation nobody registered.
    """

    component: str
    container: str = MANAGER
    bind: str = ""


class RemoveComponent(StepBase, frozen=True, tag_field="op", tag="remove_component"):
    """``remove_component`` of the component bound to ``id``."""

    id: str
    container: str = MANAGER


class GetPortElement(StepBase, frozen=True, tag_field="op", tag="get_port_element"):
    """``get_port_element``; the reference is bound to ``bind``."""

    id: str
    port: PortElementName
    bind: str
    container: str = MANAGER


class Connect(StepBase, frozen=True, tag_field="op", tag="connect"):
    """``connect`` required port element ``port`` of ``id`` to the reference bound to ``to``; binds the connection id."""

    id: str
    port: PortElementName
    to: str
    bind: str
    container: str = MANAGER


class Disconnect(StepBase, frozen=True, tag_field="op", tag="disconnect"):
    """``disconnect`` the connection bound to ``connection``."""

    connection: str
    container: str = MANAGER


class Start(StepBase, frozen=True, tag_field="op", tag="start"):
    """``start`` the container."""

    container: str = MANAGER


class Stop(StepBase, frozen=True, tag_field="op", tag="stop"):
    """``stop`` the container."""

    container: str = MANAGER


class GetComponents(StepBase, frozen=True, tag_field="op", tag="get_components"):
    """``get_components`` of the container."""

    container: str = MANAGER


class CreateContainer(StepBase, frozen=True, tag_field="op", tag="create_container"):
    """``create_container`` on the manager; the new container is bound to ``bind``."""

    bind: str


class RemoveContainer(StepBase, frozen=True, tag_field="op", tag="remove_container"):
    """``remove_container`` of the container bound to ``container``."""

    container: str


class Destroy(StepBase, frozen=True, tag_field="op", tag="destroy"):
    """``destroy`` the runtime."""


class Invoke(StepBase, frozen=True, tag_field="op", tag="invoke"):
    """Stimulus: call ``exchange(value)`` on the provided port element reference bound to ``ref``."""

    ref: str
    value: Int32


class OpenGate(StepBase, frozen=True, tag_field="op", tag="open"):
    """Let every probe held at ``gate`` go on, now and later."""

    gate: str


class ReachGate(StepBase, frozen=True, tag_field="op", tag="reach"):
    """Wait until some probe has arrived at ``gate``, open or not, for at most the scenario's patience.

    With ``more`` so many must arrive after the step has begun, with ``total`` since the scenario has begun.
    """

    gate: str
    more: Int32 = 0
    total: Int32 = 0


class Settle(StepBase, frozen=True, tag_field="op", tag="settle"):
    """Wait until worker ``worker`` is done, held at a gate or seen to be blocked, at most the scenario's patience."""

    worker: str


class Join(StepBase, frozen=True, tag_field="op", tag="join"):
    """Wait until worker ``worker`` has done all its steps, for at most the scenario's patience."""

    worker: str


class Link(StepBase, frozen=True, tag_field="op", tag="link"):
    """Make a connection (9.5.5.4) with a core ``connector``, bound to ``interface``; it has no ends yet.

    Of the message connector ``interface`` is message_intf bound to a type: ``push`` alone.
    """

    connector: Literal["simple_service_connector", "simple_message_connector"]
    interface: str
    bind: str


class Attach(StepBase, frozen=True, tag_field="op", tag="attach"):
    """Make ``port`` of ``id`` an end of the connection bound to ``link``; clients and emitters have it as required port
    element, servers and receivers as provided one.
    """

    link: str
    role: Literal["client", "server", "emitter", "receiver"]
    id: str
    port: PortElementName
    container: str = MANAGER


class Detach(StepBase, frozen=True, tag_field="op", tag="detach"):
    """``port`` of ``id`` is no longer an end of ``link``."""

    link: str
    id: str
    port: PortElementName
    container: str = MANAGER


class Break(StepBase, frozen=True, tag_field="op", tag="break"):
    """Break ``link``: its ``transport``, so that nothing can be transmitted, or the connector ``inside``."""

    link: str
    where: Literal["transport", "inside"] = "transport"


class Mend(StepBase, frozen=True, tag_field="op", tag="mend"):
    """Mend what was broken in ``link``."""

    link: str


class ReadLog(StepBase, frozen=True, tag_field="op", tag="read_log"):
    """Read the trace (10.1.4.2) back, again and again until it has ``records`` records or patience runs out."""

    records: Int32 = 0


class Pause(StepBase, frozen=True, tag_field="op", tag="pause"):
    """Let time pass: clocks are to be compared."""

    milliseconds: Int32


class AwaitMessages(StepBase, frozen=True, tag_field="op", tag="await_messages"):
    """Wait until ``instance`` of ``component`` has counted ``count`` messages, at most patience; tells what it counted."""

    component: str
    count: Int64
    instance: Int64 = 1


class Stress(StepBase, frozen=True, tag_field="op", tag="stress"):
    """For ``milliseconds`` call ``exchange`` through each of ``refs`` on a thread of its own, as fast as it can, and do the
    same beside it to a body that nobody protects. Bodies count who meets whom and record nothing.
    """

    refs: tuple[str, ...]
    milliseconds: Int32 = 100


Step = (
    AddComponent
    | RemoveComponent
    | GetPortElement
    | Connect
    | Disconnect
    | Start
    | Stop
    | GetComponents
    | CreateContainer
    | RemoveContainer
    | Destroy
    | Invoke
    | OpenGate
    | ReachGate
    | Settle
    | Join
    | Link
    | Attach
    | Detach
    | Break
    | Mend
    | ReadLog
    | Pause
    | AwaitMessages
    | Stress
)

ContainerCall = (
    AddComponent
    | RemoveComponent
    | GetPortElement
    | Connect
    | Disconnect
    | Start
    | Stop
    | GetComponents
    | CreateContainer
    | RemoveContainer
    | Destroy
)
"""The steps that are operations of Container or ContainerManager (12.10)."""

ConnectorCall = Link | Attach | Detach | Break | Mend
"""The steps that an adapter offers for connectors; one that does not skips them."""


class Scenario(Value, frozen=True):
    """Component declarations by name, steps in order, ``patience``: milliseconds a wait step may take, and ``interfaces``
    by name. Workers in ``may_stay`` need not come back; no host is told so.
    """

    components: dict[str, Declaration]
    steps: tuple[Step, ...]
    patience: Int64 = 2000
    interfaces: dict[str, Interface] = {}
    may_stay: tuple[str, ...] = ()


def operation(step: Step) -> str:
    """The step's operation as it is spelled in 12.10 and on the wire."""
    return _OPERATIONS[type(step)]


_OPERATIONS: dict[type, str] = {kind: str(kind.__struct_config__.tag) for kind in get_args(Step)}
