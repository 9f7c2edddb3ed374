"""``ForwardingAdapter``: each operation is passed on to the framework's own object; a subclass says only what differs.

Nothing here checks a state or mends a result. Ids and references are translated one to one, and what the framework did not
give out reaches it as ``unknown``.
"""

from __future__ import annotations

import threading
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, ClassVar, Self

from ucm_cts.adapters.contract.adapter import Adapter, ContainerHandle, LinkHandle, NotOffered
from ucm_cts.adapters.contract.data_types import AnyType, Interface
from ucm_cts.adapters.contract.programming_model import BadParameter, NotFound, PortElementObject, UcmError

DeclaredError = type[NotFound] | type[BadParameter] | type[UcmError]


class Ids:
    """Integers (12.10) for ids of a framework that are names or objects. Equal ids have one number, for ever.

    So a framework that gives out an id twice is seen to do so, and an id that is out of date reaches the framework.
    """

    def __init__(self, unknown: Any = None) -> None:
        """``unknown``: what the framework gets for a number that stands for none of its ids."""
        self._unknown = unknown
        self._lock = threading.Lock()
        self._numbers: dict[Hashable, int] = {}
        self._ids: dict[int, Any] = {}

    def number(self, own: Any) -> int:
        """The number of the framework's id ``own``; a new one if it has none yet."""
        key = own if isinstance(own, Hashable) else id(own)  # _ids keeps the object, so that its address stays its own
        with self._lock:
            number = self._numbers.setdefault(key, len(self._numbers) + 1)
            self._ids.setdefault(number, own)
            return number

    def numbers(self, own: Iterable[Any]) -> list[int]:
        """The numbers of several ids of the framework, in order."""
        return [self.number(one) for one in own]

    def own(self, number: int) -> Any:
        """The framework's id behind ``number``, or ``unknown``."""
        return self._ids.get(number, self._unknown)


class ContainerMembers:
    """The container interface of fragments (11.2.1.4), for a framework that has none in the shape of 12.10."""

    def __init__(self, adapter: Adapter, container: ContainerHandle) -> None:
        self._adapter, self._container = adapter, container

    def get_components(self) -> Sequence[int]:
        """Ids of the container's members."""
        return self._adapter.get_components(self._container)


class ForwardingAdapter(Adapter):
    """Calls the function of the same name of the container, manager or link, with the same arguments.

    Override an operation where that is not enough, with ``own_errors`` and ``forward`` at hand. An operation of profile
    core that the framework's object does not have is not offered; another one fails with ``UcmError``.
    """

    errors: ClassVar[Mapping[type[Exception], DeclaredError]] = {}
    """What the framework's exceptions are called in 12.10, subclasses included. Others pass as they are."""

    names: ClassVar[Mapping[str, str]] = {}
    """The framework's names of operations that it spells differently."""

    numbered: ClassVar[bool] = False
    """Whether the framework's ids are no integers: ``components`` and ``connections`` number them."""

    components: Ids
    """Numbers of the framework's ids of components, if ``numbered``. A subclass may set it, to say what ``unknown`` is."""

    connections: Ids
    """Numbers of its ids of connections, if ``numbered``."""

    def __new__(cls) -> Self:  # not __init__: subclasses may have one of their own that knows nothing of this one
        made = super().__new__(cls)
        made.components, made.connections = Ids(), Ids()
        return made

    def configuration(self, implementation: str, attributes: Mapping[str, str]) -> Sequence[Any]:
        """The arguments of the framework's ``add_component``."""
        return implementation, attributes

    def to_framework(self, reference: PortElementObject | None) -> Any:
        """What the framework takes for a reference that it gave out."""
        return reference

    def to_suite(self, reference: Any) -> PortElementObject | None:
        """A reference of the framework as one that has ``exchange`` and ``call`` (see ``bodies.References``)."""
        return reference  # type: ignore[no-any-return]  # what else it is, the probes record

    @contextmanager
    def own_errors(self) -> Iterator[None]:
        """Within the block the framework's exceptions become those of 12.10, as ``errors`` says."""
        try:
            yield
        except Exception as error:
            declared = next((self.errors[kind] for kind in type(error).__mro__ if kind in self.errors), None)
            if declared is None:
                raise
            raise declared(str(error)) from error

    def forward(self, to: Any, operation: str, *arguments: Any) -> Any:
        """Call ``operation`` of the framework's object ``to``. Raises what 12.10 declares, and what the framework raises."""
        function = getattr(to, self.names.get(operation, operation), None)
        if function is None:
            raise NotOffered if operation in _OPTIONAL else UcmError(f"{self.product} has no {operation}")
        with self.own_errors():
            return function(*arguments)

    def add_component(self, container: ContainerHandle, implementation: str, attributes: Mapping[str, str]) -> int:
        added = self.forward(container, "add_component", *self.configuration(implementation, attributes))
        return self._number(self.components, added)

    def remove_component(self, container: ContainerHandle, comp_instance: int) -> None:
        self.forward(container, "remove_component", self._component(comp_instance))

    def get_port_element(
        self, container: ContainerHandle, comp_instance: int, port_name: str
    ) -> PortElementObject | None:
        return self.to_suite(self.forward(container, "get_port_element", self._component(comp_instance), port_name))

    def connect(
        self, container: ContainerHandle, instance: int, port_name: str, to_port: PortElementObject | None
    ) -> int:
        target = self.to_framework(to_port)
        connection = self.forward(container, "connect", self._component(instance), port_name, target)
        return self._number(self.connections, connection)

    def disconnect(self, container: ContainerHandle, connection: int) -> None:
        self.forward(container, "disconnect", self.connections.own(connection) if self.numbered else connection)

    def start(self, container: ContainerHandle) -> None:
        self.forward(container, "start")

    def stop(self, container: ContainerHandle) -> None:
        self.forward(container, "stop")

    def get_components(self, container: ContainerHandle) -> Sequence[int]:
        members: Sequence[int] = self.forward(container, "get_components")
        return self.components.numbers(members) if self.numbered else members

    def create_container(self, manager: ContainerHandle) -> ContainerHandle:
        return self.forward(manager, "create_container")

    def remove_container(self, manager: ContainerHandle, sub_container: ContainerHandle) -> None:
        self.forward(manager, "remove_container", sub_container)

    def destroy(self, manager: ContainerHandle) -> None:
        self.forward(manager, "destroy")

    def link(self, manager: ContainerHandle, connector: str, interface: Interface) -> LinkHandle:
        return self.forward(manager, "link", connector, interface)

    def link_with_types(self, manager: ContainerHandle, connector: str, types: Mapping[str, AnyType]) -> LinkHandle:
        return self.forward(manager, "link_with_types", connector, types)

    def attach(
        self, link: LinkHandle, role: str, container: ContainerHandle, comp_instance: int, port_name: str
    ) -> None:
        self.forward(link, "attach", role, container, self._component(comp_instance), port_name)

    def detach(self, link: LinkHandle, container: ContainerHandle, comp_instance: int, port_name: str) -> None:
        self.forward(link, "detach", container, self._component(comp_instance), port_name)

    def break_link(self, link: LinkHandle, where: str) -> None:
        self.forward(link, "break_link", where)

    def mend_link(self, link: LinkHandle) -> None:
        self.forward(link, "mend_link")

    def read_log(self, manager: ContainerHandle) -> Sequence[tuple[str, str]]:
        records: Sequence[tuple[str, str]] = self.forward(manager, "read_log")
        return records

    def advance(self, manager: ContainerHandle, milliseconds: int) -> None:
        self.forward(manager, "advance", milliseconds)

    def _component(self, number: int) -> Any:
        return self.components.own(number) if self.numbered else number

    def _number(self, ids: Ids, given: Any) -> int:
        return ids.number(given) if self.numbered else given


_OPTIONAL = {"link", "link_with_types", "attach", "detach", "break_link", "mend_link", "read_log", "advance"}
