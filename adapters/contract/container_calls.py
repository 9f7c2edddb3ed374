"""Container calls: the steps of a scenario that are operations of the Container API (12.10), and what all steps have in common.

``adapters.contract.scenario`` exports all names of this module.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, ClassVar, Literal

from ucm_cts.adapters.contract.declarations import PortElementName
from ucm_cts.adapters.contract.traits import Binds, Kind, Names, Uses, fields
from ucm_cts.adapters.contract.value import Value

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
Undone = Literal["phase", "connection", "transmission"]


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

    undoes: ClassVar[Undone | None] = None
    """What the call may end: the operational ``phase`` of components, a ``connection``, or ``transmission`` on one."""

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
    ``attributes``: values that configure this instance in place of those of the declaration, or beside them. A name that
    the declaration does not have is a configuration value that means nothing to the implementation.
    """

    returns = "id"

    component: Annotated[str, Names("implementation")]
    container: UsedContainer = MANAGER
    bind: Annotated[str, Binds("component", "component")] = ""
    attributes: Annotated[dict[str, str], Names("attribute")] = {}

    def words(self, known_as: KnownAs = lambda variable, kind: variable) -> str:
        """``as`` only where the variable has a name of its own, and the values that are this instance's alone."""
        own = ", ".join(f"{name}={value}" for name, value in self.attributes.items())
        named = self.component + (f" as {self.bind}" if self.bind not in ("", self.component) else "")
        return f"{named} with {own}" if own else named


class RemoveComponent(StepBase, frozen=True, tag_field="op", tag="remove_component"):
    """``remove_component``.

    ``id``: the component.
    ``container``: where.
    """

    undoes = "phase"
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

    undoes = "connection"
    wording = "{connection}"

    connection: UsedConnection
    container: UsedContainer = MANAGER


class Start(StepBase, frozen=True, tag_field="op", tag="start"):
    """``start`` the container."""

    container: UsedContainer = MANAGER


class Stop(StepBase, frozen=True, tag_field="op", tag="stop"):
    """``stop`` the container."""

    undoes = "phase"

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

    undoes = "phase"
    wording = "{container}"

    container: Annotated[str, Uses("container", (NIL,))]


class Destroy(StepBase, frozen=True, tag_field="op", tag="destroy"):
    """``destroy`` the runtime."""

    undoes = "phase"


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
