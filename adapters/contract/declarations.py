"""Declarations: the probe bodies that a framework hosts in a scenario, and what each does in its hooks.

``adapters.contract.scenario`` gives all names of this module, too.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.traits import Names
from ucm_cts.adapters.contract.value import Int32, Int64, Value

PortElementName = Annotated[str, Names("port element")]
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

SERVICE_CONNECTOR: Final = "simple_service_connector"
MESSAGE_CONNECTOR: Final = "simple_message_connector"
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
