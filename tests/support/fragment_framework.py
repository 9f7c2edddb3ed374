"""Connectors that are made of fragments (11.1.2.1): the Python reference framework with such a service connector; scenarios."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from typing import Any

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.fragments import EndFragment, FragmentConnectors, FragmentLink


class Channel:
    """How the fragments of one link reach each other."""

    server: pm.PortElementObject | None = None
    is_broken = False

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.server is None or self.is_broken:
            raise pm.UcmError("the server cannot be reached")
        try:
            return copy.deepcopy(self.server.call(method, copy.deepcopy(arguments)))
        except pm.DeclaredException as error:
            raise pm.DeclaredException(error.name, copy.deepcopy(error.fields)) from None


class CallersEnd(pm.PortElementObject):
    """What a client is connected to."""

    def __init__(self, channel: Channel) -> None:
        self.channel = channel

    def exchange(self, value: int) -> int:
        raise pm.UcmError("the port element has another interface")

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self.channel.call(method, arguments)


class End(pm.ComponentObject, pm.FragmentObject):
    """The fragment at one end of a link, configured with the link's number."""

    def __init__(self, channels: dict[str, Channel]) -> None:
        self.channels = channels

    def set_container_interface(self, container: pm.ContainerInterface) -> None: ...

    def set_attribute(self, name: str, value: str) -> None:
        assert name == "link"
        self.channel = self.channels.setdefault(value, Channel())
        self.element = CallersEnd(self.channel)

    def on_init(self) -> None: ...

    def on_startup(self, dependencies: Sequence[pm.PortConnection]) -> None: ...

    def on_shutdown(self) -> None: ...

    def on_remove(self) -> None: ...

    def get_portElement(self, provided: str) -> pm.PortElementObject:
        return self.element


class ServersEnd(End):
    """The fragment that is connected to the server; a link has one."""

    def on_startup(self, dependencies: Sequence[pm.PortConnection]) -> None:
        if self.channel.server is not None:
            raise pm.UcmError("the link has a server already")
        ((self.channel.server,),) = (dependency.to_port for dependency in dependencies)

    def on_shutdown(self) -> None:
        self.channel.server = None


class FragmentsAdapter(FragmentConnectors, ReferenceAdapter):
    """Everything but ``end_fragment`` and faults is the SDK's."""

    end_fragments = {s.SERVICE_CONNECTOR: {}}

    def create_runtime(self, implementations: Sequence[pm.Implementation]) -> Any:
        self.manager = super().create_runtime(implementations)
        self.channels: dict[str, Channel] = {}
        return self.manager

    def end_fragment(self, link: FragmentLink, role: str) -> EndFragment:
        name = f"{role} of link {link.number}"
        provides, requires = (("end",), ()) if role == "client" else ((), ("end",))
        kind = End if role == "client" else ServersEnd
        create: Callable[[], pm.ComponentObject] = lambda: kind(self.channels)
        self.manager.implementations[name] = pm.Implementation(
            name, provides, requires, ("link",), False, True, create, interfaces={"end": link.interface}
        )
        return EndFragment(name, "end")

    def break_link(self, link: Any, where: str) -> None:
        self.channels.setdefault(str(link.number), Channel()).is_broken = True

    def mend_link(self, link: Any) -> None:
        self.channels[str(link.number)].is_broken = False


SERVICE = d.Interface({"ask": d.Method((d.Parameter("a", "INOUT", d.Integer("ULONG")),))})


def served(*steps: s.Step) -> s.Scenario:
    """A client asks a server through a link; then ``steps``."""
    ask = s.CallMethod("out", "ask", (7,))
    components = {
        "C": s.Declaration(("go",), ("out",), plan={"exchange": (ask,)}, ports={"out": "service"}),
        "S": s.Declaration(("in",), ports={"in": "service"}, plan={"method": (s.Answer("ask"),)}),
    }
    before = (
        s.AddComponent("S"),
        s.AddComponent("C"),
        s.Link(s.SERVICE_CONNECTOR, "service", "l"),
        s.Attach("l", "server", "S", "in"),
        s.Attach("l", "client", "C", "out"),
        s.GetPortElement("C", "go", "go"),
        s.Start(),
        s.Invoke("go", 1),
    )
    return s.Scenario(components, (*before, *steps), 2000, {"service": SERVICE})


def in_short(events: Sequence[t.Event]) -> list[Any]:
    """Replies as results and whether an exception came, errors, numbers of members."""
    found: list[Any] = []
    for event in events:
        if isinstance(event, t.Reply):
            found.append((event.results, event.raised))
        elif isinstance(event, t.Raise):
            found.append(event.error)
        elif isinstance(event, t.Return) and isinstance(event.value, tuple):
            found.append(len(event.value))
    return found
