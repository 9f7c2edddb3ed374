"""Scenario: a plain list of steps with symbolic variables, as it travels to a host.

A scenario never says what to expect. Its component declarations describe the probe bodies the framework shall host;
its steps are Container API calls (clause 12.10), stimuli through provided port elements, and gates.

Variables are names bound by a step (``bind``) and used by later ones. Two are always there: ``UNKNOWN`` designates an
identifier the framework never gave out, ``NIL`` a null reference. ``MANAGER`` is the runtime's root container.
"""

from __future__ import annotations

from typing import Annotated, Literal, get_args

import msgspec

MANAGER = "manager"
UNKNOWN = "unknown"
NIL = "nil"

Int32 = Annotated[int, msgspec.Meta(ge=-(2**31), le=2**31 - 1)]
"""A payload: what every framework's integers hold."""

Int64 = Annotated[int, msgspec.Meta(ge=-(2**63), le=2**63 - 1)]
"""Any other integer on the wire."""

PortElementName = str
"""How a port element is spelled at the Container API, ``<port>_<element>`` unless the adapter says otherwise."""


class Value(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """Base of all scenario values: immutable, and an unknown or wrong-typed field is an error."""


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


Action = RaiseError | ReturnValue | CallPort | HoldAtGate | QuerySiblings

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
]
"""Where a probe is entered: the callbacks of clause 11.2.1, ``exchange``, the probes' one business method, and ``run``
of a self-executing component (10.1.3).
"""


SELF_EXECUTING = "protected_self-executing_component"
ACTIVE = "protected_active_component"
PROTECTED_PASSIVE = "protected_passive_component"
UNPROTECTED_PASSIVE = "unprotected_passive_component"
"""The four execution policies of 10.1.3."""

SELF_EXECUTION_API = "self-execution_api"
"""The port element that a self-executing component provides to its container."""


class Policy(Value, frozen=True):
    """A technical policy of a component implementation (9.5.4.3): its ``definition`` and, of some, the ``port`` element."""

    definition: str
    port: PortElementName | None = None
    parameters: dict[str, str] = {}


class Declaration(Value, frozen=True):
    """One component implementation the framework shall be able to instantiate: a probe body and its plan.

    ``provides`` and ``requires`` list port element names; ``attributes`` maps attribute names to configured values;
    ``connectable`` bodies implement Connectable (11.2.1.3), ``fragment`` bodies FragmentObject (11.2.1.4).
    ``policies`` are its technical policies. ``plan`` lists, per hook, the actions the probe performs each time it is entered there. No port element twice.
    """

    provides: tuple[PortElementName, ...] = ()
    requires: tuple[PortElementName, ...] = ()
    attributes: dict[str, str] = {}
    connectable: bool = False
    fragment: bool = False
    plan: dict[Hook, tuple[Action, ...]] = {}
    policies: tuple[Policy, ...] = ()

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

    With ``more`` so many must arrive after the step has begun.
    """

    gate: str
    more: Int32 = 0


class Settle(StepBase, frozen=True, tag_field="op", tag="settle"):
    """Wait until worker ``worker`` is done, held at a gate or seen to be blocked, at most the scenario's patience."""

    worker: str


class Join(StepBase, frozen=True, tag_field="op", tag="join"):
    """Wait until worker ``worker`` has done all its steps, for at most the scenario's patience."""

    worker: str


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


class Scenario(Value, frozen=True):
    """Component declarations by name, steps in order, and ``patience``: milliseconds a wait step may take."""

    components: dict[str, Declaration]
    steps: tuple[Step, ...]
    patience: Int64 = 2000


def operation(step: Step) -> str:
    """The step's operation as it is spelled in 12.10 and on the wire."""
    return _OPERATIONS[type(step)]


_OPERATIONS: dict[type, str] = {kind: str(kind.__struct_config__.tag) for kind in get_args(Step)}
