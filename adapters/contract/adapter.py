"""The Python adapter: subclass ``Adapter`` to bind a framework.

An adapter forwards each operation of the Container API (12.10) one to one and translates errors. It adds no state
checks of its own: they would hide what is being measured. ``ContainerHandle`` is any object that the framework, or the
adapter, uses for a container; references and ids go through unchanged.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from ucm_cts.adapters.contract.data_types import AnyType, Interface
from ucm_cts.adapters.contract.programming_model import Implementation, PortElementObject

ContainerHandle = Any
LinkHandle = Any


class NotOffered(Exception):
    """The adapter does not offer this optional operation."""


class Adapter(ABC):
    """Binds one framework. One instance is made for each scenario and serves one runtime.

    Operations end by returning or by raising ``NotFound``, ``BadParameter`` or ``UcmError``; any other exception is
    reported as an undeclared one, which 12.10 forbids, so let the framework's own surprises through.
    """

    product: ClassVar[str] = "unnamed framework"
    """The framework's name, as it stands in the report."""

    version: ClassVar[str] = "0"
    """The framework's version, as it stands in the report."""

    port_element_name: ClassVar[str] = "{port}_{element}"
    """How the framework spells the name of a port element at its API."""

    @abstractmethod
    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerHandle:
        """Make an empty runtime that can instantiate ``implementations``; return its root container (11.2.2.2)."""

    @abstractmethod
    def add_component(self, container: ContainerHandle, implementation: str, attributes: Mapping[str, str]) -> int:
        """``add_component`` with the configuration values that select ``implementation`` and set ``attributes``.

        The adapter knows how the framework wants that said; clause 12.10 only fixes name and value pairs.
        """

    @abstractmethod
    def remove_component(self, container: ContainerHandle, comp_instance: int) -> None:
        """``remove_component``."""

    @abstractmethod
    def get_port_element(
        self, container: ContainerHandle, comp_instance: int, port_name: str
    ) -> PortElementObject | None:
        """``get_port_element``."""

    @abstractmethod
    def connect(
        self, container: ContainerHandle, instance: int, port_name: str, to_port: PortElementObject | None
    ) -> int:
        """``connect``; returns the connection id."""

    @abstractmethod
    def disconnect(self, container: ContainerHandle, connection: int) -> None:
        """``disconnect``."""

    @abstractmethod
    def start(self, container: ContainerHandle) -> None:
        """``start``."""

    @abstractmethod
    def stop(self, container: ContainerHandle) -> None:
        """``stop``."""

    @abstractmethod
    def get_components(self, container: ContainerHandle) -> Sequence[int]:
        """``get_components``."""

    @abstractmethod
    def create_container(self, manager: ContainerHandle) -> ContainerHandle:
        """``create_container`` on the root container."""

    @abstractmethod
    def remove_container(self, manager: ContainerHandle, sub_container: ContainerHandle) -> None:
        """``remove_container`` on the root container."""

    @abstractmethod
    def destroy(self, manager: ContainerHandle) -> None:
        """``destroy`` the runtime. Also called after a scenario that has not done so, with any outcome ignored."""

    # What profiles core and extensions need beside; what an adapter does not override stays untested.

    def link(self, manager: ContainerHandle, connector: str, interface: Interface) -> LinkHandle:
        """Make a connection without ends (9.5.5.4) with a ``connector`` of 10.1, bound to ``interface``."""
        raise NotOffered

    def link_with_types(self, manager: ContainerHandle, connector: str, types: Mapping[str, AnyType]) -> LinkHandle:
        """Make a connection without ends with a ``connector`` of 10.4, bound to data ``types`` by template parameter."""
        raise NotOffered

    def attach(
        self, link: LinkHandle, role: str, container: ContainerHandle, comp_instance: int, port_name: str
    ) -> None:
        """Make the port element an end of ``link``, in the ``role`` of client, server, emitter or receiver.

        If ``role`` is a connector port of 10.4, ``port_name`` is the name of a port: its elements are those of
        ``platform_interfaces.CONNECTOR_PORTS``, spelled as ``port_element_name`` says.
        """
        raise NotOffered

    def detach(self, link: LinkHandle, container: ContainerHandle, comp_instance: int, port_name: str) -> None:
        """The port element, or the port, is no longer an end of ``link``."""
        raise NotOffered

    def break_link(self, link: LinkHandle, where: str) -> None:
        """Break the ``transport`` of ``link``, or its connector ``inside``, until it is mended (10.1.2)."""
        raise NotOffered

    def mend_link(self, link: LinkHandle) -> None:
        """Mend what was broken."""
        raise NotOffered

    def read_log(self, manager: ContainerHandle) -> Sequence[tuple[str, str]]:
        """All records of the trace (10.1.4.2) so far, oldest first: severity and text."""
        raise NotOffered

    def advance(self, manager: ContainerHandle, milliseconds: int) -> None:
        """Let so much virtual time pass for all components at once."""
        raise NotOffered

    def close(self) -> None:  # noqa: B027 - optional hook
        """Free the adapter's own resources. Always called, as the last method."""
