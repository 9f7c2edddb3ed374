"""The Python reference framework's adapter: each operation forwarded one to one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.data_types import Interface
from ucm_cts.adapters.contract.programming_model import Implementation, PortElementObject
from ucm_cts.adapters.reference.python.connectors import Link
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager


class ReferenceAdapter(Adapter):
    """Binds the Python reference framework. Subclasses bind variants of it by naming another ``manager_class``."""

    product = "UCM-CTS reference framework (Python)"
    version = "1"
    manager_class: ClassVar[type[ContainerManager]] = ContainerManager

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        return self.manager_class(implementations)

    def add_component(self, container: Container, implementation: str, attributes: Mapping[str, str]) -> int:
        return container.add_component(implementation, attributes)

    def remove_component(self, container: Container, comp_instance: int) -> None:
        container.remove_component(comp_instance)

    def get_port_element(self, container: Container, comp_instance: int, port_name: str) -> PortElementObject | None:
        return container.get_port_element(comp_instance, port_name)

    def connect(self, container: Container, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        return container.connect(instance, port_name, to_port)

    def disconnect(self, container: Container, connection: int) -> None:
        container.disconnect(connection)

    def start(self, container: Container) -> None:
        container.start()

    def stop(self, container: Container) -> None:
        container.stop()

    def get_components(self, container: Container) -> list[int]:
        return container.get_components()

    def create_container(self, manager: ContainerManager) -> Container:
        return manager.create_container()

    def remove_container(self, manager: ContainerManager, sub_container: Container | None) -> None:
        manager.remove_container(sub_container)

    def link(self, manager: ContainerManager, connector: str, interface: Interface) -> Link:
        return manager.link(connector, interface)

    def attach(self, link: Link, role: str, container: Container, comp_instance: int, port_name: str) -> None:
        link.attach(role, container, comp_instance, port_name)

    def detach(self, link: Link, container: Container, comp_instance: int, port_name: str) -> None:
        link.detach(container, comp_instance, port_name)

    def break_link(self, link: Link, where: str) -> None:
        link.break_link(where)

    def mend_link(self, link: Link) -> None:
        link.mend_link()

    def read_log(self, manager: ContainerManager) -> list[tuple[str, str]]:
        return manager.read_log()

    def advance(self, manager: ContainerManager, milliseconds: int) -> None:
        manager.advance(milliseconds)

    def destroy(self, manager: ContainerManager) -> None:
        manager.destroy()
