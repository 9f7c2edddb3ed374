"""The iPOPO adapter: containers, components and connections in terms of iPOPO."""

from __future__ import annotations

import importlib
import itertools
import logging
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from types import ModuleType, SimpleNamespace
from typing import Any

import pelix.ipopo.decorators as ipopo
from pelix.constants import OBJECTCLASS, BundleException
from pelix.framework import Bundle, FrameworkFactory, create_framework
from pelix.ipopo.constants import IPopoEvent, get_ipopo_svc_ref
from pelix.ipopo.core import BUILTIN_HANDLERS
from pelix.ipopo.handlers.constants import PROP_HANDLER_ID, HandlerFactory

from ucm_cts.adapters.contract import programming_model as ucm
from ucm_cts.adapters.contract.adapter import Adapter

logging.basicConfig(level=os.environ.get("UCM_CTS_IPOPO_LOG", logging.CRITICAL + 1))  # WARNING: what callbacks raise
_MODULES = {name: importlib.import_module(name) for name in ("pelix.ipopo.core", *BUILTIN_HANDLERS)}


class IpopoAdapter(Adapter):
    """Binds iPOPO: a runtime is a Pelix framework, a container a bundle in it with component factories of its own.

    A provided port element is a service, there while its component is valid. A required one is a mandatory requirement
    whose filter follows a property that ``connect`` and ``disconnect`` reconfigure; a connection replaces an older.
    Attributes are properties. ``on_init`` is called where a constructor is; ``@Validate`` calls ``on_startup``,
    ``@Invalidate`` ``on_shutdown``, (un)binding a field ``on_(dis)connect``, the event KILLED ``on_remove``. iPOPO
    starts what it can by itself: ``stop`` invalidates members, last first; ``start`` reconfigures each with nothing.
    """

    product = "iPOPO"
    version = ipopo.__version__

    def __init__(self) -> None:
        self._numbers = itertools.count(1)
        self._bodies: dict[str | None, Any] = {}
        self._targets: dict[ucm.PortElementObject | None, _Target] = {}
        self._connections: dict[tuple[str, str], int] = {}

    def create_runtime(self, implementations: Sequence[ucm.Implementation]) -> Bundle:
        self._implementations = implementations
        sys.modules.update(_MODULES)  # deleting a framework unloads them, and importing them takes long
        context = create_framework(["pelix.ipopo.core"], auto_start=True).get_bundle_context()
        self._ipopo: Any = get_ipopo_svc_ref(context)[1]  # type: ignore[index]
        self._ipopo.add_listener(self)
        context.register_service(HandlerFactory, self, {PROP_HANDLER_ID: __name__})
        return self.create_container(context.get_framework())

    def add_component(self, container: Bundle, implementation: str, attributes: Mapping[str, str]) -> int:
        number = next(self._numbers)
        try:
            self._ipopo.instantiate(_name(container, implementation), _name(container, number), dict(attributes))
        except Exception as error:  # iPOPO says that it may raise any
            raise ucm.UcmError(str(error)) from error
        return number

    def remove_component(self, container: Bundle, comp_instance: int) -> None:
        with _translated_errors():
            self._ipopo.kill(_name(container, comp_instance))

    def get_port_element(self, container: Bundle, comp_instance: int, port_name: str) -> ucm.PortElementObject:
        name, context = _name(container, comp_instance), container.get_bundle_context()
        with _translated_errors():
            service: Any = context.get_service_reference(port_name, f"(instance.name={name})")
            if service is None:
                raise ucm.NotFound(f"{name} has no service {port_name}")
            element: ucm.PortElementObject = context.get_service(service)
        self._targets[element] = _Target(instance=name, port=port_name)
        return element

    def connect(self, container: Bundle, instance: int, port_name: str, to_port: ucm.PortElementObject | None) -> int:
        name = _name(container, instance)
        with _translated_errors():
            field = self._ipopo.get_instance(name).fields[port_name]
            if to_port not in self._targets:
                raise ucm.BadParameter("not a service of this framework")
            self._ipopo.reconfigure(name, {field: self._targets[to_port]})
        self._connections[name, field] = number = next(self._numbers)
        return number

    def disconnect(self, container: Bundle, connection: int) -> None:
        with _translated_errors():
            name, field = {n: k for k, n in [*self._connections.items()] if _name(container, "") in k[0]}[connection]
            del self._connections[name, field]
            self._ipopo.reconfigure(name, {field: _Target(instance="-", port="-")})

    def start(self, container: Bundle) -> None:
        for number in self.get_components(container):
            self._ipopo.reconfigure(_name(container, number), {})

    def stop(self, container: Bundle) -> None:
        for number in reversed(self.get_components(container)):
            self._ipopo.invalidate(_name(container, number))

    def get_components(self, container: Bundle) -> list[int]:
        names = [name.rpartition("/") for name, _, _ in self._ipopo.get_instances()]
        return sorted(int(number) for holder, _, number in names if holder == container.get_symbolic_name())

    def create_container(self, manager: Bundle) -> Bundle:
        module = ModuleType(f"container-{next(self._numbers)}")
        for index, implementation in enumerate(self._implementations):
            setattr(module, f"Component{index:06}", _factory(implementation, module.__name__))
        sys.modules[module.__name__] = module  # Pelix looks for bundles here and takes them out when it uninstalls them
        with _translated_errors():
            bundle = manager.get_bundle_context().install_bundle(module.__name__)
            bundle.start()
        return bundle

    def remove_container(self, manager: Bundle, sub_container: Bundle | None) -> None:
        if sub_container is None:
            raise ucm.NotFound("the container is null")
        with _translated_errors(BundleException):  # "invalid bundle"
            sub_container.uninstall()

    def destroy(self, manager: Bundle) -> None:
        self.close()

    def close(self) -> None:
        FrameworkFactory.delete_framework()

    def get_handlers(self, context: Any, component: Any) -> Sequence[Any]:  # called by iPOPO while it instantiates
        body, container = component.body, context.get_bundle_context().get_bundle()
        for attribute in filter(context.properties.__contains__, component.attributes):
            body.set_attribute(attribute, context.properties[attribute])
        if isinstance(body, ucm.FragmentObject):
            body.set_container_interface(SimpleNamespace(get_components=lambda: self.get_components(container)))
        body.on_init()
        self._bodies[context.name] = body
        return ()

    def handle_ipopo_event(self, event: IPopoEvent) -> None:  # called by iPOPO
        if event.get_kind() == IPopoEvent.KILLED:
            self._bodies.pop(event.get_component_name()).on_remove()


class _Target(dict[str, str]):
    __format__ = dict.__getitem__  # what a filter takes from the property it follows


def _factory(implementation: ucm.Implementation, module: str) -> type[Any]:
    ports = {f"to_{index}": port for index, port in enumerate(implementation.requires)}

    class Component:
        attributes, fields = implementation.attributes, {port: field for field, port in ports.items()}

        def __init__(self) -> None:
            self.body: Any = implementation.create()

        def get_service(self, bundle: Bundle, service_registration: Any) -> Any:
            return self.body.get_portElement(service_registration.get_reference().get_property(OBJECTCLASS)[1])

        def unget_service(self, bundle: Bundle, service_registration: Any) -> None: ...

        @ipopo.Validate
        def validate(self, bundle_context: Any) -> None:
            self.body.on_startup([ucm.PortConnection(port, (getattr(self, field),)) for field, port in ports.items()])

        @ipopo.Invalidate
        def invalidate(self, bundle_context: Any) -> None:
            self.body.on_shutdown()

        def bind(self, field: str, service: Any, service_reference: Any) -> None:
            self.body.on_connect(ports[field], service)

        def unbind(self, field: str, service: Any, service_reference: Any) -> None:
            self.body.on_disconnect(ports[field])

    for field in ports:
        target = f"(&(instance.name={{{field}:instance}})(objectClass={{{field}:port}}))"
        ipopo.RequiresVarFilter(field, ucm.PortElementObject, spec_filter=target)(Component)
        if implementation.connectable:
            ipopo.BindField(field)(Component.bind)
            ipopo.UnbindField(field)(Component.unbind)
    for port in implementation.provides:
        ipopo.Provides([ucm.PortElementObject, port], factory=True)(Component)
    ipopo.get_factory_context(Component).set_handler(__name__, None)
    Component.__module__ = module
    return ipopo.ComponentFactory(f"{module}/{implementation.name}")(Component)


def _name(container: Bundle, member: str | int) -> str:
    return f"{container.get_symbolic_name()}/{member}"


@contextmanager
def _translated_errors(unknown: type[Exception] = KeyError) -> Iterator[None]:
    try:
        yield
    except (KeyError, ValueError, unknown) as error:  # a name or an id that iPOPO or a table does not know
        raise ucm.NotFound(str(error)) from error
    except BundleException as error:
        raise ucm.UcmError(str(error)) from error
