"""Clause 11's component interfaces in Python: the view that a framework has of the bodies it hosts.

Names are those of 12.10. The SDK's probes implement these classes; a framework or its adapter only calls them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from ucm_cts.adapters.contract.data_types import Datum, Interface
from ucm_cts.adapters.contract.scenario import Policy


class NotFound(Exception):
    """NOT_FOUND of 12.10."""


class BadParameter(Exception):
    """BAD_PARAMETER of 12.10."""


class UcmError(Exception):
    """UCM_ERROR of 12.10."""


class DeclaredException(Exception):
    """An exception that the called method declares.

    ``name``: its name.
    ``fields``: values of its fields, in order.
    """

    def __init__(self, name: str, fields: Sequence[Datum] = ()) -> None:
        super().__init__(name)
        self.name, self.fields = name, tuple(fields)


class PortElementObject(ABC):
    """A provided port element (11.2.1.1). One without interface has one business method, ``exchange``."""

    @abstractmethod
    def exchange(self, value: int) -> int:
        """The business method of the probe models' only interface: a signed 32-bit value in, one out."""

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        """Any method of an interface, by name: takes IN and INOUT values, returns those of OUT, INOUT and RETURN, each in
        the order of declaration. Raises ``DeclaredException``.

        What stands between caller and body (connectors, proxies of protected components) offers it, too: it is what
        generated code would be. Values are as ``data_types`` says; lists among arguments and results are the caller's own,
        and change after the call.
        """
        raise NotImplementedError(method)


@dataclass(frozen=True)
class PortConnection:
    """A connected required port element (12.10).

    ``from_port``: name of the required port element.
    ``to_port``: the connected references.
    """

    from_port: str
    to_port: Sequence[PortElementObject | None]


class ObjectTimer(ABC):
    """A timer of 10.3.1, which a scheduler gives out. ``rounds`` and ``id`` are the getters of its attributes."""

    @abstractmethod
    def rounds(self) -> int:
        """Its rounds, from 0 to 2**32 - 1."""

    @abstractmethod
    def id(self) -> str:
        """Its identifier."""

    @abstractmethod
    def cancel(self) -> None:
        """It triggers no more."""

    @abstractmethod
    def is_cancelled(self) -> bool:
        """Was it cancelled?"""


class TimerHandler(ABC):
    """What a body passes to a scheduler, and the timer calls (10.3.1)."""

    @abstractmethod
    def on_trigger(self, timer: ObjectTimer, delta_time: Sequence[int], round: int) -> None:
        """``timer`` triggers. ``delta_time``: seconds and microseconds. ``round``: from 0 to 2**32 - 1."""


class TimerScheduler(PortElementObject):
    """The port element ``timer_scheduler`` that a component requires by the policy ``ott_timer`` (10.3.1). Times are seconds and
    microseconds. The methods raise what the framework raises where it refuses a call.
    """

    @abstractmethod
    def scheduler_trigger(self, handler: TimerHandler, delay: Sequence[int]) -> ObjectTimer:
        """Makes a timer that triggers ``handler`` once, after ``delay``."""

    @abstractmethod
    def schedule_repeated_trigger(
        self, handler: TimerHandler, start_delay: Sequence[int], interval: Sequence[int], max_rounds: int
    ) -> ObjectTimer | None:
        """Makes a timer that triggers ``handler`` ``max_rounds`` times, and returns it if ``repeated-result=timer`` is declared."""

    def exchange(self, value: int) -> int:
        """A scheduler has no such method."""
        raise NotImplementedError("exchange")


class ComponentExecution(ABC):
    """What a self-executing component provides to its container (10.1.3): ``self-execution_api``."""

    @abstractmethod
    def run(self) -> None:
        """Execute once."""


class ComponentObject(ABC):
    """A component body (11.2.1.2)."""

    @abstractmethod
    def on_init(self) -> None:
        """Called once, when the attributes have their configured values."""

    @abstractmethod
    def on_startup(self, dependencies: Sequence[PortConnection]) -> None:
        """Called when the operational phase begins, with the references of the required port elements."""

    @abstractmethod
    def on_shutdown(self) -> None:
        """Called when the operational phase ends."""

    @abstractmethod
    def on_remove(self) -> None:
        """Called when the instance is about to be removed."""

    @abstractmethod
    def get_portElement(self, provided: str) -> PortElementObject | None:
        """The body's own object for the provided port element of that name, or None if it has none."""

    def get_policy_element(self, policy: str, element: str) -> ComponentExecution | None:
        """The body's own object for the port element that its technical policy makes it provide, or None (12.8.5)."""
        return None

    def get_policy_port(self, policy: str, element: str) -> PortElementObject | None:
        """The same, for a port element with an interface, as timer_callback of the index timers (10.3.2)."""
        return None

    @abstractmethod
    def set_attribute(self, name: str, value: str) -> None:
        """Set a component attribute. Clause 13.5 spells one mutator an attribute; generic bodies have this one."""


class Connectable(ABC):
    """Bodies that are informed of each connection (11.2.1.3)."""

    @abstractmethod
    def on_connect(self, port_name: str, required: PortElementObject | None) -> None:
        """The required port element ``port_name`` has been connected to ``required``."""

    @abstractmethod
    def on_disconnect(self, port_name: str) -> None:
        """The required port element ``port_name`` has been disconnected."""


class ContainerInterface(Protocol):
    """The part of the Container API that a fragment gets at least (11.2.1.4)."""

    def get_components(self) -> Sequence[int]:
        """Ids of the container's members."""


class FragmentObject(ABC):
    """What a fragment implements beside ComponentObject (11.2.1.4)."""

    @abstractmethod
    def set_container_interface(self, container: ContainerInterface) -> None:
        """Gives the fragment access to the container that holds it."""


@dataclass(frozen=True)
class Implementation:
    """A component implementation that a framework can instantiate.

    ``name``: its name.
    ``provides``: provided port elements.
    ``requires``: required port elements. ``on_startup`` also gets those of policies, as ``policy.element``; they have ``call``.
    ``attributes``: attribute names.
    ``defaults``: the default value of each attribute that has one.
    ``connectable``: the bodies implement Connectable.
    ``fragment``: the bodies implement FragmentObject.
    ``create``: makes a body.
    ``policies``: technical policies that the container applies (10.1.3, 10.1.4).
    ``interfaces``: the interface of each port element that has one; the others have ``exchange``.
    """

    name: str
    provides: Sequence[str]
    requires: Sequence[str]
    attributes: Sequence[str]
    connectable: bool
    fragment: bool
    create: Callable[[], ComponentObject]
    policies: Sequence[Policy] = ()
    interfaces: Mapping[str, Interface] = field(default_factory=dict)
    defaults: Mapping[str, str] = field(default_factory=dict)
