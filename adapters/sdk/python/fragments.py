"""``FragmentConnectors``: links for frameworks whose connectors are fragments (11.1.2.1).

Each end of a link is a fragment, which the framework instantiates like a component. It gets a container of its own, so that
``get_components`` of other containers does not show it, and is operational before the component is connected.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Self

from ucm_cts.adapters.contract.adapter import Adapter, ContainerHandle, NotOffered
from ucm_cts.adapters.contract.data_types import Interface
from ucm_cts.adapters.contract.programming_model import NotFound, UcmError


@dataclass(frozen=True)
class EndFragment:
    """The fragment that a framework has for one role of a connector.

    ``implementation``: name of the fragment's implementation.
    ``port``: the fragment's port element that the component is connected to: provided where the component requires.
    """

    implementation: str
    port: str


@dataclass(frozen=True)
class AttachedEnd:
    """An end of a link: the fragment's container, and the connection in ``holder`` that leads to or from the component."""

    box: ContainerHandle
    holder: ContainerHandle
    connection: int


@dataclass
class FragmentLink:
    """A link.

    ``number``: tells its fragments that they belong together.
    ``manager``: the root container.
    ``connector``: one of 10.1.
    ``interface``: the interface that it carries.
    ``ends``: by component and port element.
    """

    number: int
    manager: ContainerHandle
    connector: str
    interface: Interface
    ends: dict[tuple[int, str], AttachedEnd] = field(default_factory=dict)


class FragmentConnectors(Adapter):
    """Makes ``link``, ``attach`` and ``detach`` of the other operations. Put it before the adapter's base class."""

    end_fragments: ClassVar[Mapping[str, Mapping[str, EndFragment]]] = {}
    """The fragments, by connector and role. A connector that is missing is not offered."""

    _link_numbers: Iterator[int]

    def __new__(cls) -> Self:  # not __init__: subclasses may have one of their own that knows nothing of this one
        made = super().__new__(cls)
        made._link_numbers = itertools.count(1)
        return made

    def end_fragment(self, link: FragmentLink, role: str) -> EndFragment:
        """The fragment for an end of ``link``; override it where that depends on the interface."""
        return self.end_fragments[link.connector][role]

    def fragment_attributes(self, link: FragmentLink, role: str) -> Mapping[str, str]:
        """Configuration values of the fragment for an end of ``link``; by default ``link``, the link's number."""
        return {"link": str(link.number)}

    def link(self, manager: ContainerHandle, connector: str, interface: Interface) -> FragmentLink:
        if connector not in self.end_fragments:
            raise NotOffered
        return FragmentLink(next(self._link_numbers), manager, connector, interface)

    def attach(self, link: Any, role: str, container: ContainerHandle, comp_instance: int, port_name: str) -> None:
        if (comp_instance, port_name) in link.ends:
            raise UcmError(f"{port_name} of {comp_instance} is an end of this link already")
        fragment = self.end_fragment(link, role)
        provides = role in ("server", "receiver")
        element = self.get_port_element(container, comp_instance, port_name) if provides else None
        box = self.create_container(link.manager)
        try:
            added = self.add_component(box, fragment.implementation, self.fragment_attributes(link, role))
            if provides:
                connection = self.connect(box, added, fragment.port, element)
                self.start(box)
            else:
                self.start(box)
                end = self.get_port_element(box, added, fragment.port)
                connection = self.connect(container, comp_instance, port_name, end)
        except Exception:
            self.remove_container(link.manager, box)
            raise
        link.ends[comp_instance, port_name] = AttachedEnd(box, box if provides else container, connection)

    def detach(self, link: Any, container: ContainerHandle, comp_instance: int, port_name: str) -> None:
        end = link.ends.get((comp_instance, port_name))
        if end is None:
            raise NotFound(f"{port_name} of {comp_instance} is no end of this link")
        if end.holder is not end.box:
            self.disconnect(end.holder, end.connection)
        self.remove_container(link.manager, end.box)
        del link.ends[comp_instance, port_name]
