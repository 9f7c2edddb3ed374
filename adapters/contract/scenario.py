"""Scenario: a plain list of steps with symbolic variables, as a host receives it.

A scenario never says what to expect. Its component declarations describe the probe bodies the framework shall host;
its steps are Container API calls (clause 12.10), stimuli through provided port elements, and gates.

Variables are names bound by a step (``bind``) and used by later ones. Two always exist: ``UNKNOWN`` stands for an
identifier that the framework never gave out, ``NIL`` a null reference. ``MANAGER`` is the runtime's root container.
"""

from __future__ import annotations

from typing import Annotated, Literal, get_args

from ucm_cts.adapters.contract.container_calls import *  # their names are names of this module, too
from ucm_cts.adapters.contract.container_calls import (
    ContainerCall,
    KnownAs,
    StepBase,
    UsedComponent,
    UsedContainer,
    UsedLink,
    UsedReference,
)
from ucm_cts.adapters.contract.data_types import AnyType, Interface
from ucm_cts.adapters.contract.declarations import *
from ucm_cts.adapters.contract.declarations import Declaration, Payload, PortElementName
from ucm_cts.adapters.contract.platform_interfaces import PARAMETERS
from ucm_cts.adapters.contract.traits import Binds, Lasts, Names, Uses
from ucm_cts.adapters.contract.value import Int32, Int64, Value


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
    """Make a connection without ends (9.5.5.4) with a connector of the platform.

    ``connector``: the connector of 10.1 or 10.4.
    ``interface``: what it is bound to; of the message connector: message_intf bound to a type, with ``push`` alone; of a connector
    of 10.4: a name in the scenario's ``types``.
    ``bind``: variable for the link.
    """

    optional = True
    wording = "{bind}: {connector} of {interface}"

    connector: Literal[
        "simple_service_connector", "simple_message_connector", "request-response_connector", "shared-data_connector"
    ]
    interface: Annotated[str, Names("interface")]
    bind: Annotated[str, Binds("link")]

    @property
    def claim(self) -> str:
        """The connector is a part of the platform: 10.1 has it by its name, 10.4 as an interaction."""
        return self.connector.removesuffix("_connector") if self.connector in PARAMETERS else self.connector


class Attach(StepBase, frozen=True, tag_field="op", tag="attach"):
    """Make a port element, or a port of 10.4 with all its elements, an end of a link.

    ``link``: the link.
    ``role``: clients and emitters require the port element, servers and receivers provide it; the other roles are the names of the
    connector ports of 10.4.
    ``id``: the component.
    ``port``: its port element; for a connector port of 10.4 its port.
    ``container``: where.
    """

    optional = True
    wording = "{role} {id}.{port} to {link}"

    link: UsedLink
    role: Literal[
        "client",
        "server",
        "emitter",
        "receiver",
        "rr_synchronous_client",
        "rr_synchronous_server",
        "rr_asynchronous_client",
        "rr_asynchronous_server",
        "sd_reader",
        "sd_writer",
    ]
    id: UsedComponent
    port: PortElementName
    container: UsedContainer = MANAGER


class Detach(StepBase, frozen=True, tag_field="op", tag="detach"):
    """A port element, or a port, is no longer an end of a link.

    ``link``: the link.
    ``id``: the component.
    ``port``: as in ``Attach``.
    ``container``: where.
    """

    optional = True
    undoes = "connection"
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
    undoes = "transmission"
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
    ``types``: by name, what a connector of 10.4 is bound to: data types by template parameter. The interfaces that follow from it
    are among ``interfaces``, as ``platform_interfaces.named_interfaces`` has them.
    """

    components: dict[str, Declaration]
    steps: tuple[Step, ...]
    patience: Int64 = 2000
    interfaces: dict[str, Interface] = {}
    may_stay: tuple[str, ...] = ()
    types: dict[str, dict[str, AnyType]] = {}


def operation(step: Step) -> str:
    """The step's operation as it is spelled in 12.10 and on the wire."""
    return _OPERATIONS[type(step)]


_OPERATIONS: dict[type, str] = {kind: str(kind.__struct_config__.tag) for kind in get_args(Step)}
