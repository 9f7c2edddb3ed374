"""The adapter of docs/adapter-python.md: binds the toy framework Beans."""

import itertools
from contextlib import contextmanager

from beans import Missing, Pod, Trouble

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.programming_model import FragmentObject, NotFound, PortConnection, UcmError


@contextmanager
def declared_errors():
    """The framework's errors, in the words of 12.10. Everything else passes: the report shall show it."""
    try:
        yield
    except Missing as error:
        raise NotFound(str(error)) from error
    except Trouble as error:
        raise UcmError(str(error)) from error


class BeansAdapter(Adapter):
    product = "Beans"
    version = "1.0"

    def create_runtime(self, implementations):
        self.beans, self.links = {}, {}  # 12.10 wants integers, Beans has texts and objects
        self.numbers = itertools.count(1)
        return Pod({i.name: (i.create, i.requires) for i in implementations})

    def add_component(self, container, implementation, attributes):
        def give_container(bean):
            if isinstance(bean, FragmentObject):
                bean.set_container_interface(Members(self, container))

        with declared_errors():
            name = container.plant(implementation, attributes, give_container)
        number = next(self.numbers)
        self.beans[number] = name
        return number

    def remove_component(self, container, comp_instance):
        with declared_errors():
            container.pull(self.beans.get(comp_instance))

    def get_port_element(self, container, comp_instance, port_name):
        with declared_errors():
            element = container.bean(self.beans.get(comp_instance)).get_portElement(port_name)
        if element is None:
            raise NotFound(port_name)
        return element

    def connect(self, container, instance, port_name, to_port):
        with declared_errors():
            link = container.tie(self.beans.get(instance), port_name, to_port)
        number = next(self.numbers)
        self.links[number] = link
        return number

    def disconnect(self, container, connection):
        with declared_errors():
            container.untie(self.links.get(connection))

    def start(self, container):
        container.wake(lambda link: PortConnection(link.port, (link.target,)))

    def stop(self, container):
        container.sleep()

    def get_components(self, container):
        return [number for number, name in self.beans.items() if name in container.beans]

    def create_container(self, manager):
        manager.pods.append(Pod(manager.kinds))
        return manager.pods[-1]

    def remove_container(self, manager, sub_container):
        with declared_errors():
            manager.drop(sub_container)

    def destroy(self, manager):
        manager.clear()


class Members:
    """What a fragment sees of its container."""

    def __init__(self, adapter, container):
        self.adapter, self.container = adapter, container

    def get_components(self):
        return self.adapter.get_components(self.container)
