"""The connectors of 10.4 and the interfaces of their ports, which are bound to data types; all names are those of the text."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final, Literal

from ucm_cts.adapters.contract.data_types import COMM_ECODE, AnyType, Integer, Interface, Method, Parameter

REQUEST_RESPONSE: Final = "request-response_connector"
SHARED_DATA: Final = "shared-data_connector"
"""The connectors of 10.4.1 and 10.4.2."""

BoundTypes = Mapping[str, AnyType]
"""The data types that a connector is bound to, by template parameter."""

REQUEST_DATA, RESPONSE_DATA, SHARED = "request_data_t", "response_data_t", "shared-data_t"
"""The template parameters of both connectors."""

REQUEST, RESPONSE = "request", "response"
"""The methods of 10.4.1."""

WRITE, PUBLISH, CANCEL = "write_data", "publish_data", "cancel_data"
READ, FREEZE, RELEASE = "read_data", "freeze_data", "release_data"
NOTIFY = "on_data_update"
"""Those of 10.4.2: of writers, of readers, and of the notification."""

_ID = Integer("ULONG")
_CODE = Parameter("ecode", "RETURN", COMM_ECODE)


def _synchronous(types: BoundTypes) -> Interface:
    request, response = types[REQUEST_DATA], types[RESPONSE_DATA]
    return Interface(
        {REQUEST: Method((Parameter("request", "IN", request), Parameter("response", "OUT", response), _CODE))}
    )


def _client_requests(types: BoundTypes) -> Interface:
    request = types[REQUEST_DATA]
    return Interface({REQUEST: Method((Parameter("request", "IN", request), Parameter("req_id", "OUT", _ID), _CODE))})


def _server_requests(types: BoundTypes) -> Interface:
    request = types[REQUEST_DATA]
    return Interface({REQUEST: Method((Parameter("request", "IN", request), Parameter("req_id", "IN", _ID), _CODE))})


def _responses(types: BoundTypes) -> Interface:
    response = types[RESPONSE_DATA]
    return Interface(
        {RESPONSE: Method((Parameter("response", "IN", response), Parameter("resp_id", "IN", _ID), _CODE))}
    )


def _reader(types: BoundTypes) -> Interface:
    read = Method((Parameter("data", "OUT", types[SHARED]), _CODE))
    return Interface({FREEZE: Method((_CODE,)), RELEASE: Method((_CODE,)), READ: read})


def _notification(types: BoundTypes) -> Interface:
    return Interface({NOTIFY: Method()})


def _writer(types: BoundTypes) -> Interface:
    write = Method((Parameter("data", "IN", types[SHARED]), _CODE))
    return Interface({WRITE: write, PUBLISH: Method((_CODE,)), CANCEL: Method((_CODE,))})


_INTERFACES: dict[str, dict[str, Callable[[BoundTypes], Interface]]] = {
    REQUEST_RESPONSE: {
        "rrsync_intf": _synchronous,
        "rrasync_req_client_intf": _client_requests,
        "rrasync_req_server_intf": _server_requests,
        "rrasync_resp_intf": _responses,
    },
    SHARED_DATA: {"data_reader": _reader, "data_notification": _notification, "data_writer": _writer},
}

PARAMETERS: Mapping[str, tuple[str, ...]] = {REQUEST_RESPONSE: (REQUEST_DATA, RESPONSE_DATA), SHARED_DATA: (SHARED,)}
"""The template parameters of each connector, by its name."""

METHODS: Final = frozenset((REQUEST, RESPONSE, WRITE, PUBLISH, CANCEL, READ, FREEZE, RELEASE, NOTIFY))
"""The methods of all interfaces here."""


@dataclass(frozen=True)
class Element:
    """A port element of a connector port.

    ``name``: its name.
    ``provided``: the component provides it, and the connector calls it; else the component calls the connector.
    ``interface``: the name of its interface.
    """

    name: str
    provided: bool
    interface: str


@dataclass(frozen=True)
class ConnectorPort:
    """A connector port of 10.4: what a component's port is attached to, as a whole.

    ``name``: its name, which is the ``role`` of ``attach``.
    ``connector``: whose it is.
    ``side``: clients ask and writers publish; the others are servers and readers.
    ``elements``: the port elements of its type.
    """

    name: str
    connector: str
    side: Literal["client", "server", "writer", "reader"]
    elements: tuple[Element, ...]

    @property
    def provided(self) -> Element | None:
        """The element that the component provides, if there is one."""
        return next((e for e in self.elements if e.provided), None)

    @property
    def required(self) -> Element | None:
        """The element that the component requires, if there is one."""
        return next((e for e in self.elements if not e.provided), None)


CONNECTOR_PORTS: Mapping[str, ConnectorPort] = {
    port.name: port
    for port in (
        ConnectorPort(
            "rr_synchronous_client", REQUEST_RESPONSE, "client", (Element("client_p", False, "rrsync_intf"),)
        ),
        ConnectorPort("rr_synchronous_server", REQUEST_RESPONSE, "server", (Element("server_p", True, "rrsync_intf"),)),
        ConnectorPort(
            "rr_asynchronous_client",
            REQUEST_RESPONSE,
            "client",
            (
                Element("client_req_p", False, "rrasync_req_client_intf"),
                Element("client_resp_p", True, "rrasync_resp_intf"),
            ),
        ),
        ConnectorPort(
            "rr_asynchronous_server",
            REQUEST_RESPONSE,
            "server",
            (
                Element("server_req_p", True, "rrasync_req_server_intf"),
                Element("server_resp_p", False, "rrasync_resp_intf"),
            ),
        ),
        ConnectorPort(
            "sd_reader",
            SHARED_DATA,
            "reader",
            (Element("reader_p", False, "data_reader"), Element("notification_p", True, "data_notification")),
        ),
        ConnectorPort("sd_writer", SHARED_DATA, "writer", (Element("writer_p", False, "data_writer"),)),
    )
}
"""The connector ports of 10.4, by name."""

ELEMENTS: Final = frozenset(element.name for port in CONNECTOR_PORTS.values() for element in port.elements)
"""The names of their port elements, which are those of the text at each framework."""


def connector_of(types: BoundTypes) -> str | None:
    """The connector that is bound to such types; None if there is none with these template parameters."""
    return next((name for name, parameters in PARAMETERS.items() if {*parameters} == {*types}), None)


def interfaces_of(types: BoundTypes) -> dict[str, Interface]:
    """The interfaces of the connector that is bound to ``types``, by name.

    Raises ``KeyError`` if no connector has these template parameters.
    """
    connector = connector_of(types)
    if connector is None:
        raise KeyError(f"no connector is bound to {', '.join(types) or 'nothing'}")
    return {name: make(types) for name, make in _INTERFACES[connector].items()}


def named_interfaces(name: str, types: BoundTypes) -> dict[str, Interface]:
    """The same, as scenarios that bind ``name`` to ``types`` name them: ``name.interface``."""
    return {f"{name}.{one}": interface for one, interface in interfaces_of(types).items()}
