"""Beans with a service connector, for docs/profile-core.md: a wire has many callers and one server."""

import copy

from beans import Trouble
from my_adapter import BeansAdapter

from ucm_cts.adapters.contract.adapter import NotOffered
from ucm_cts.adapters.contract.programming_model import PortElementObject


class Wire(PortElementObject):
    """What a caller is tied to; it leads to one server."""

    def __init__(self):
        self.server, self.is_cut = None, False

    def serve(self, server):
        if self.server is not None:
            raise Trouble("there is a server already")
        self.server = server

    def exchange(self, value):
        raise Trouble("wires carry typed calls only")

    def call(self, method, arguments):
        if self.is_cut or self.server is None:
            raise Trouble("nobody is there")
        return copy.deepcopy(self.server.call(method, copy.deepcopy(arguments)))


class WiredBeansAdapter(BeansAdapter):
    product = "Beans with wires"

    def link(self, manager, connector, interface):
        if connector != "simple_service_connector":
            raise NotOffered
        return Wire()

    def attach(self, link, role, container, comp_instance, port_name):
        if role == "client":
            self.connect(container, comp_instance, port_name, link)
        else:
            self.forward(link, "serve", self.get_port_element(container, comp_instance, port_name))

    def break_link(self, link, where):
        link.is_cut = True

    def mend_link(self, link):
        link.is_cut = False
