"""The GStreamer adapter: containers, components and connections in terms of GStreamer."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

from ucm_cts.adapters.contract import programming_model as ucm
from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.integrations.gstreamer.binding import Gst
from ucm_cts.adapters.sdk.python.bodies import initialise, port_connections
from ucm_cts.adapters.sdk.python.forwarding import ContainerMembers

_PROVIDED, _REQUIRED = "provided_", "required_"
_SIZE = 4  # bytes of a value in a buffer


class GStreamerAdapter(Adapter):
    """Binds GStreamer: a runtime is a pipeline and its root container, a container a bin in it, a component an element.

    A container's resting state is READY; ``start`` sets it PLAYING, ``stop`` READY, and GStreamer passes that on to the
    elements, but not to other bins in the pipeline: their states are locked. Elements call ``on_init`` on the way from NULL
    to READY, ``on_startup`` from PAUSED, where pads are active, to PLAYING, ``on_shutdown`` back to PAUSED, ``on_remove`` from
    READY to NULL. An element is set READY and added to its bin; to go it is set READY, taken out of the bin, which unlinks
    it, and set NULL. What bodies raise fails a change upwards; no element fails on the way down, as GStreamer demands.

    Port elements are request pads, one for each connection: source pads where required, sink pads where provided. A
    connection links two, through ghost pads where it leads from bin to bin. A call is a buffer, pushed; its answer is
    an event that comes upstream before the push is over. The signals ``linked`` and ``unlinked`` call ``on_(dis)connect``.
    """

    product = "GStreamer"
    version = ".".join(map(str, Gst.version()[:3]))

    def __init__(self) -> None:
        self._numbers = itertools.count(1)
        self._connections: dict[tuple[Any, int], Any] = {}

    def create_runtime(self, implementations: Sequence[ucm.Implementation]) -> Any:
        self._implementations = {implementation.name: implementation for implementation in implementations}
        pipeline = Gst.Pipeline()
        _set_state(pipeline, Gst.State.READY)
        return pipeline

    def add_component(self, container: Any, implementation: str, attributes: Mapping[str, str]) -> int:
        if implementation not in self._implementations:
            raise ucm.UcmError(f"no element {implementation}")
        number = next(self._numbers)
        members = ContainerMembers(self, container)
        element = _Component(str(number), self._implementations[implementation], attributes, members)
        _set_state(element, Gst.State.READY)
        container.add(element)
        return number

    def remove_component(self, container: Any, comp_instance: int) -> None:
        _take_out(container, _element(container, comp_instance))

    def get_port_element(self, container: Any, comp_instance: int, port_name: str) -> ucm.PortElementObject:
        outside = Gst.Pad.new(None, Gst.PadDirection.SRC)
        outside.set_event_function_full(_take_event)
        outside.set_active(True)
        outside.link(_request_pad(_element(container, comp_instance), _PROVIDED + port_name))
        return _Reference(outside)

    def connect(self, container: Any, instance: int, port_name: str, to_port: ucm.PortElementObject | None) -> int:
        client = _element(container, instance)
        if not isinstance(to_port, _Reference):
            raise ucm.BadParameter("no port element of this framework")
        source, sink = _request_pad(client, _REQUIRED + port_name), to_port.another_sink()
        if not source.link_maybe_ghosting(sink):
            raise ucm.UcmError("the pads cannot be linked")
        number = next(self._numbers)
        self._connections[container, number] = source, sink
        return number

    def disconnect(self, container: Any, connection: int) -> None:
        source, sink = self._connections.pop((container, connection), (None, None))
        peer = source and source.get_peer()
        if not peer:
            raise ucm.NotFound(f"no connection {connection}")
        source.unlink(peer)
        for pad in (source, sink):
            if element := pad.get_parent_element():  # the provider may be gone
                element.release_request_pad(pad)

    def start(self, container: Any) -> None:
        _set_state(container, Gst.State.PLAYING)

    def stop(self, container: Any) -> None:
        _set_state(container, Gst.State.READY)

    def get_components(self, container: Any) -> list[int]:
        return sorted(int(child.get_name()) for child in container.children if isinstance(child, _Component))

    def create_container(self, manager: Any) -> Any:
        container = Gst.Bin()
        manager.add(container)
        container.set_locked_state(True)
        _set_state(container, Gst.State.READY)
        return container

    def remove_container(self, manager: Any, sub_container: Any) -> None:
        if sub_container is None or not manager.remove(sub_container):
            raise ucm.NotFound("no such bin")
        self.destroy(sub_container)

    def destroy(self, manager: Any) -> None:
        self.stop(manager)
        for child in manager.children:
            remove = _take_out if isinstance(child, _Component) else self.remove_container
            remove(manager, child)
        _set_state(manager, Gst.State.NULL)


class _Component(Gst.Element):
    """An element around a body."""

    def __init__(self, name: str, implementation: ucm.Implementation, attributes: Any, members: Any) -> None:
        super().__init__(name=name)
        self.ports = {_REQUIRED: implementation.requires, _PROVIDED: implementation.provides}
        self.attributes, self.members = attributes, members
        self.body: Any = implementation.create()

    def do_change_state(self, change: Any) -> Any:
        try:
            if change == Gst.StateChange.NULL_TO_READY:
                initialise(self.body, self.attributes, self.members)
            elif change == Gst.StateChange.PAUSED_TO_PLAYING:
                self.body.on_startup(self._dependencies())
        except Exception:  # noqa: BLE001 - a body may raise anything
            return Gst.StateChangeReturn.FAILURE
        with suppress(Exception):  # GStreamer wants no element to fail on the way down
            if change == Gst.StateChange.PLAYING_TO_PAUSED:
                self.body.on_shutdown()
            elif change == Gst.StateChange.READY_TO_NULL:
                self.body.on_remove()
        return Gst.Element.do_change_state(self, change)

    def _dependencies(self) -> list[ucm.PortConnection]:
        return port_connections((pad.port, _Reference(pad)) for pad in self.srcpads if pad.is_linked())

    def do_request_new_pad(self, template: Any, name: str, caps: Any) -> Any:
        kind = _REQUIRED if template.direction == Gst.PadDirection.SRC else _PROVIDED
        port = name.removeprefix(kind)
        if port not in self.ports[kind]:
            return None
        pad = Gst.Pad.new_from_template(template, None)
        pad.port = port
        pad.set_event_function_full(_take_event)
        if kind == _PROVIDED:
            pad.set_chain_function_full(_serve)
        elif isinstance(self.body, ucm.Connectable):
            pad.connect("linked", _linked)
            pad.connect("unlinked", _unlinked)
        pad.set_active(self.current_state > Gst.State.READY)  # who adds a pad to a running element has to
        self.add_pad(pad)
        return pad

    def do_release_pad(self, pad: Any) -> None:
        self.remove_pad(pad)


for _kind, _direction in ((_PROVIDED, Gst.PadDirection.SINK), (_REQUIRED, Gst.PadDirection.SRC)):
    _Component.add_pad_template(
        Gst.PadTemplate.new(_kind + "%s", _direction, Gst.PadPresence.REQUEST, Gst.Caps.new_any())
    )


class _Reference(ucm.PortElementObject):
    """What a caller holds: a source pad."""

    def __init__(self, pad: Any) -> None:
        self._pad = pad

    def exchange(self, value: int) -> int:
        segment = Gst.Segment()
        segment.init(Gst.Format.BYTES)
        for event in (Gst.Event.new_stream_start(""), Gst.Event.new_segment(segment)):  # what has to precede a buffer
            self._pad.push_event(event)
        flow = self._pad.push(Gst.Buffer.new_wrapped(value.to_bytes(_SIZE, "big", signed=True)))
        if flow != Gst.FlowReturn.OK:
            raise RuntimeError(Gst.flow_get_name(flow))
        answer: int = _answers.value
        return answer

    def another_sink(self) -> Any:
        """A further sink pad of the provided port element that this pad leads to. Raises ``BadParameter``."""
        sink = self._pad.get_peer()
        if sink is None:
            raise ucm.BadParameter("the port element is gone")
        return _request_pad(sink.get_parent_element(), _PROVIDED + sink.port)


_answers = threading.local()
"""The answer that came last to a thread."""

# Functions of pads. They are no methods: a pad that held its element would keep it alive for ever.


def _serve(pad: Any, element: Any, buffer: Any) -> Any:
    try:
        value = int.from_bytes(buffer.extract_dup(0, _SIZE), "big", signed=True)
        result = element.body.get_portElement(pad.port).exchange(value)
    except Exception:  # noqa: BLE001 - a body may raise anything
        return Gst.FlowReturn.ERROR
    answer = Gst.Structure.new_empty("answer")
    answer.set_value("value", result)
    taken = pad.push_event(Gst.Event.new_custom(Gst.EventType.CUSTOM_UPSTREAM, answer))
    return Gst.FlowReturn.OK if taken else Gst.FlowReturn.FLUSHING


def _take_event(pad: Any, element: Any, event: Any) -> bool:
    """No event goes further: calls are no stream that leads through a component."""
    if event.type == Gst.EventType.CUSTOM_UPSTREAM:
        _answers.value = event.get_structure().get_value("value")
    return True


def _linked(pad: Any, peer: Any) -> None:
    pad.get_parent_element().body.on_connect(pad.port, _Reference(pad))


def _unlinked(pad: Any, peer: Any) -> None:
    pad.get_parent_element().body.on_disconnect(pad.port)


def _element(container: Any, number: int) -> Any:
    element = container.get_child_by_name(str(number))
    if element is None:
        raise ucm.NotFound(f"no element {number}")
    return element


def _request_pad(element: Any, name: str) -> Any:
    pad = element.request_pad_simple(name)
    if pad is None:
        raise ucm.NotFound(f"no pad {name}")
    return pad


def _set_state(element: Any, state: Any) -> None:
    if element.set_state(state) == Gst.StateChangeReturn.FAILURE:
        raise ucm.UcmError(f"{element.get_name()} fails to become {state.value_nick}")


def _take_out(container: Any, element: Any) -> None:
    element.set_state(Gst.State.READY)
    container.remove(element)
    _set_state(element, Gst.State.NULL)
