"""The adapter of docs/adapter-python.md: binds the toy framework Beans."""

from beans import Missing, Pod, Trouble

from ucm_cts.adapters.contract.programming_model import FragmentObject, NotFound, PortConnection, UcmError
from ucm_cts.adapters.sdk.python.forwarding import ContainerMembers, ForwardingAdapter


class BeansAdapter(ForwardingAdapter):
    product = "Beans"
    version = "1.0"
    errors = {Missing: NotFound, Trouble: UcmError}  # everything else passes: the report shall show it
    names = {
        "remove_component": "pull",
        "connect": "tie",
        "disconnect": "untie",
        "stop": "sleep",
        "remove_container": "drop",
        "destroy": "clear",
    }
    numbered = True  # 12.10 wants integers, Beans has texts and objects

    def create_runtime(self, implementations):
        return Pod({i.name: (i.create, i.requires) for i in implementations})

    def add_component(self, container, implementation, attributes):
        def give_container(bean):
            if isinstance(bean, FragmentObject):
                bean.set_container_interface(ContainerMembers(self, container))

        return self.components.number(self.forward(container, "plant", implementation, attributes, give_container))

    def get_port_element(self, container, comp_instance, port_name):
        element = self.forward(container, "bean", self.components.own(comp_instance)).get_portElement(port_name)
        if element is None:
            raise NotFound(port_name)
        return element

    def start(self, container):
        container.wake(lambda link: PortConnection(link.port, (link.target,)))

    def get_components(self, container):
        return self.components.numbers(container.beans)

    def create_container(self, manager):
        manager.pods.append(Pod(manager.kinds))
        return manager.pods[-1]
