"""Scenario: a plain list of steps with symbolic variables, as a host receives it.

A scenario never says what to expect. Its component declarations describe the probe bodies the framework shall host;
its steps are Container API calls (clause 12.10), stimuli through provided port elements, and gates.

Variables are names bound by a step (``bind``) and used by later ones. Two always exist: ``UNKNOWN`` stands for an
identifier that the framework never gave out, ``NIL`` a null reference. ``MANAGER`` is the runtime's root container.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, ClassVar, Literal, get_args

from ucm_cts.adapters.contract.data_types import Interface
from ucm_cts.adapters.contract.declarations import *  # their names are names of this module, too
from ucm_cts.adapters.contract.declarations import Declaration, Payload, PortElementName
from ucm_cts.adapters.contract.traits import Binds, Kind, Lasts, Names, Uses, fields
from ucm_cts.adapters.contract.value import Int32, Int64, Value

MANAGER = "manager"
UNKNOWN = "unknown"
NIL = "nil"

UsedComponent = Annotated[str, Uses("component", (UNKNOWN,))]
UsedConnection = Annotated[str, Uses("connection", (UNKNOWN,))]
UsedReference = Annotated[str, Uses("reference", (NIL,))]
UsedContainer = Annotated[str, Uses("container")]
UsedLink = Annotated[str, Uses("link")]
"""Variables that a step reads (see ``traits``)."""

KnownAs = Callable[[str, Kind], str]

Ending = Literal["return", "opened", "settled", "counted", "paused", "stressed", ""]
Returns = Literal["id", "ids", "reference", "value", "records"]


class StepBase(Value, frozen=True, kw_only=True):
    """Common to all steps.

    ``thread``: the worker that runs the step while the scenario continues; none for the scenario's own thread."""

    ends_with: ClassVar[Ending] = "return"
    """The kind of event that ends the step. A step that ends with ``return`` is a call: ``call`` begins it, and it may end
    with ``raise`` instead. Empty: no event reports success."""

    returns: ClassVar[Returns | None] = None
    """What the call gives back."""

    optional: ClassVar[bool] = False
    """The adapter may not offer the call. Then the step is skipped: ``skip`` follows ``call``."""

    waits: ClassVar[int] = 0
    """How many times the host may let patience pass before the step ends."""

    reads_only: ClassVar[bool] = False
    """The call changes nothing about containers, components and connections."""

    wording: ClassVar[str] = ""
    """The arguments as people read them, a format of the fields. Variables are replaced by what they hold."""

    thread: str | None = None

    @property
    def claim(self) -> str:
        """What a vendor must claim for the step to be sent: a capability, or a reading as ``option=value``. Empty: nothing."""
        return ""

    def words(self, known_as: KnownAs = lambda variable, kind: variable) -> str:
        """The arguments as people read them; ``known_as`` names, for readers, what a variable holds."""
        read = {field: getattr(self, field) for field in self.__struct_fields__}
        for field, trait in fields(type(self)):
            if isinstance(trait, Uses):
                variables = (read[field],) if isinstance(read[field], str) else read[field]
                read[field] = ", ".join(known_as(variable, trait.kind) for variable in variables)
        return self.wording.format(**read)


class AddComponent(StepBase, frozen=True, tag_field="op", tag="add_component"):
    """``add_component``.

    ``component``: the declaration to instantiate; one that the scenario does not declare asks for an unknown implementation.
    ``container``: where.
    ``bind``: variable for the id; by default the name of the component.
    """

    returns = "id"

    component: Annotated[str, Names("implementation")]
    container: UsedContainer = MANAGER
    bind: Annotated[str, Binds("component", "component")] = ""

    def words(self, known_as: KnownAs = lambda variable, kind: variable) -> str:
        """``as`` only where the variable has a name of its own."""
        return self.component + (f" as {self.bind}" if self.bind not in ("", self.component) else "")


class RemoveComponent(StepBase, frozen=True, tag_field="op", tag="remove_component"):
    """``remove_component``.

    ``id``: the component.
    ``container``: where.
    """

    wording = "{id}"

    id: UsedComponent
    container: UsedContainer = MANAGER


class GetPortElement(StepBase, frozen=True, tag_field="op", tag="get_port_element"):
    """``get_port_element``.

    ``id``: the component.
    ``port``: the port element.
    ``bind``: variable for the reference.
    ``container``: where.
    """

    returns = "reference"
    reads_only = True
    wording = "{id}.{port}"

    id: UsedComponent
    port: PortElementName
    bind: Annotated[str, Binds("reference")]
    container: UsedContainer = MANAGER


class Connect(StepBase, frozen=True, tag_field="op", tag="connect"):
    """``connect``.

    ``id``: the component that requires.
    ``port``: its required port element.
    ``to``: the reference.
    ``bind``: variable for the id of the connection.
    ``container``: where.
    """

    returns = "id"
    wording = "{id}.{port} → {to}"

    id: UsedComponent
    port: PortElementName
    to: UsedReference
    bind: Annotated[str, Binds("connection")]
    container: UsedContainer = MANAGER


class Disconnect(StepBase, frozen=True, tag_field="op", tag="disconnect"):
    """``disconnect``.

    ``connection``: the connection.
    ``container``: where.
    """

    wording = "{connection}"

    connection: UsedConnection
    container: UsedContainer = MANAGER


class Start(StepBase, frozen=True, tag_field="op", tag="start"):
    """``start`` the container."""

    container: UsedContainer = MANAGER


class Stop(StepBase, frozen=True, tag_field="op", tag="stop"):
    """``stop`` the container."""

    container: UsedContainer = MANAGER


class GetComponents(StepBase, frozen=True, tag_field="op", tag="get_components"):
    """``get_components`` of the container."""

    returns = "ids"
    reads_only = True

    container: UsedContainer = MANAGER


class CreateContainer(StepBase, frozen=True, tag_field="op", tag="create_container"):
    """``create_container`` of the manager.

    ``bind``: variable for the new container.
    """

    wording = "{bind}"

    bind: Annotated[str, Binds("container")]


class RemoveContainer(StepBase, frozen=True, tag_field="op", tag="remove_container"):
    """``remove_container`` of the manager.

    ``container``: the container to remove.
    """

    wording = "{container}"

    container: Annotated[str, Uses("container", (NIL,))]


class Destroy(StepBase, frozen=True, tag_field="op", tag="destroy"):
    """``destroy`` the runtime."""


class Invoke(StepBase, frozen=True, tag_field="op", tag="invoke"):
    """Stimulus: call ``exchange`` of a provided port element.

    ``ref``: the reference.
    ``value``: the argument.
    """

    returns = "value"
    reads_only = True
    wording = "{ref} exchange({value})"

    ref: UsedReference
    value: Payload


class OpenGate(StepBase, frozen=True, tag_field="op", tag="open"):
    """Let every probe at a gate continue, now and later.

    ``gate``: name of the gate.
    """

    ends_with = "opened"
    wording = "{gate}"

    gate: Annotated[str, Names("gate")]


class ReachGate(StepBase, frozen=True, tag_field="op", tag="reach"):
    """Wait until a probe has arrived at a gate, open or not, for at most the scenario's patience.

    ``gate``: name of the gate.
    ``more``: how many must arrive after the step has begun; 0 asks for nothing more.
    ``total``: how many must have arrived since the scenario began; 0 asks for nothing more.
    """

    ends_with = ""
    waits = 1
    wording = "{gate}"

    gate: Annotated[str, Names("gate")]
    more: Int32 = 0
    total: Int32 = 0


class Settle(StepBase, frozen=True, tag_field="op", tag="settle"):
    """Wait until a worker is done, held at a gate or blocked, for at most the scenario's patience.

    ``worker``: the worker.
    """

    ends_with = "settled"
    waits = 1
    wording = "{worker}"

    worker: Annotated[str, Names("worker")]


class Join(StepBase, frozen=True, tag_field="op", tag="join"):
    """Wait until a worker has done all its steps, for at most the scenario's patience.

    ``worker``: the worker.
    """

    ends_with = ""
    waits = 1
    wording = "{worker}"

    worker: Annotated[str, Names("worker")]


class Link(StepBase, frozen=True, tag_field="op", tag="link"):
    """Make a connection without ends (9.5.5.4) with a core connector.

    ``connector``: the connector of 10.1.
    ``interface``: what it is bound to; of the message connector: message_intf bound to a type, with ``push`` alone.
    ``bind``: variable for the link.
    """

    optional = True
    wording = "{bind}: {connector} of {interface}"

    connector: Literal["simple_service_connector", "simple_message_connector"]
    interface: Annotated[str, Names("interface")]
    bind: Annotated[str, Binds("link")]

    @property
    def claim(self) -> str:
        """The connector is a part of 10.1."""
        return self.connector


class Attach(StepBase, frozen=True, tag_field="op", tag="attach"):
    """Make a port element an end of a link.

    ``link``: the link.
    ``role``: clients and emitters require the port element, servers and receivers provide it.
    ``id``: the component.
    ``port``: its port element.
    ``container``: where.
    """

    optional = True
    wording = "{role} {id}.{port} to {link}"

    link: UsedLink
    role: Literal["client", "server", "emitter", "receiver"]
    id: UsedComponent
    port: PortElementName
    container: UsedContainer = MANAGER


class Detach(StepBase, frozen=True, tag_field="op", tag="detach"):
    """A port element is no longer an end of a link.

    ``link``: the link.
    ``id``: the component.
    ``port``: its port element.
    ``container``: where.
    """

    optional = True
    wording = "{id}.{port} from {link}"

    link: UsedLink
    id: UsedComponent
    port: PortElementName
    container: UsedContainer = MANAGER


class Break(StepBase, frozen=True, tag_field="op", tag="break"):
    """Break a link.

    ``link``: the link.
    ``where``: the ``transport``, so that nothing can be transmitted, or the connector ``inside``.
    """

    optional = True
    wording = "{where} of {link}"

    link: UsedLink
    where: Literal["transport", "inside"] = "transport"

    @property
    def claim(self) -> str:
        """One test operation for each place."""
        return "transport-fault=hook" if self.where == "transport" else "connector-fault=hook"


class Mend(StepBase, frozen=True, tag_field="op", tag="mend"):
    """Mend what was broken in a link.

    ``link``: the link.
    """

    optional = True
    wording = "{link}"

    link: UsedLink


class ReadLog(StepBase, frozen=True, tag_field="op", tag="read_log"):
    """Read the log (10.1.4.2), again and again until patience ends.

    ``records``: how many records end the waiting.
    """

    returns = "records"
    reads_only = True
    optional = True
    waits = 1

    records: Int32 = 0

    def words(self, known_as: KnownAs = lambda variable, kind: variable) -> str:
        """How many records it waits for, if any."""
        return f"until {self.records} records are there" if self.records else ""


class Pause(StepBase, frozen=True, tag_field="op", tag="pause"):
    """Let time pass, to compare clocks.

    ``milliseconds``: how long.
    """

    ends_with = "paused"
    wording = "{milliseconds} ms"

    milliseconds: Annotated[Int32, Lasts()]


class AwaitMessages(StepBase, frozen=True, tag_field="op", tag="await_messages"):
    """Wait until a body has counted messages, for at most the scenario's patience; then report its counters.

    ``component``: name of the declaration.
    ``count``: how many messages.
    ``instance``: number of the body, from 1.
    """

    ends_with = "counted"
    waits = 1
    wording = "{count} at {component}"

    component: Annotated[str, Names("component")]
    count: Int64
    instance: Int64 = 1


class Stress(StepBase, frozen=True, tag_field="op", tag="stress"):
    """Call ``exchange`` as fast as possible, one thread for each reference; then do the same with a body without protection.

    Bodies count overlaps and record no events.

    ``refs``: the references.
    ``milliseconds``: how long, each time.
    """

    ends_with = "stressed"
    waits = 2
    wording = "{refs} for {milliseconds} ms"

    refs: Annotated[tuple[str, ...], Uses("reference", (NIL,))]
    milliseconds: Annotated[Int32, Lasts(2, at_least=0)] = 100


class Advance(StepBase, frozen=True, tag_field="op", tag="advance"):
    """Let virtual time pass: all times that components read increase at once.

    ``milliseconds``: by how much.
    """

    optional = True
    claim = "virtual-time=hook"
    wording = "{milliseconds} ms"

    milliseconds: Int32


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
"""The steps that are calls for connectors."""

Step = (
    ContainerCall
    | Invoke
    | OpenGate
    | ReachGate
    | Settle
    | Join
    | ConnectorCall
    | ReadLog
    | Pause
    | AwaitMessages
    | Stress
    | Advance
)


class Scenario(Value, frozen=True):
    """A scenario.

    ``components``: declarations by name.
    ``steps``: in order.
    ``patience``: how long a wait step may wait, in milliseconds.
    ``interfaces``: by name.
    ``may_stay``: workers that need not return; hosts ignore it.
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
