"""The part of a container that has to do with the connectors of 10.4."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract import platform_interfaces as platform
from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract.data_types import AnyType
from ucm_cts.adapters.reference.python.connectors import AnyLink, UsesConnectors
from ucm_cts.adapters.reference.python.port_links import PortLink
from ucm_cts.adapters.reference.python.request_response import RequestResponseLink
from ucm_cts.adapters.reference.python.shared_data import SharedDataLink


class UsesExtensions(UsesConnectors):
    """A container whose components may be joined by the connectors of 10.4; variants replace their classes."""

    request_response_class: type[RequestResponseLink] = RequestResponseLink
    shared_data_class: type[SharedDataLink] = SharedDataLink

    def link_with_types(self, connector: str, types: Mapping[str, AnyType]) -> AnyLink:
        """A connection without ends, with a connector of 10.4. Raises ``UcmError`` if there is no such connector."""
        with self._operation():
            classes: tuple[type[PortLink], ...] = (self.request_response_class, self.shared_data_class)
            made = next((one for one in classes if one.connector == connector), None)
            if made is None or platform.connector_of(types) != connector:
                raise pm.UcmError(f"no connector {connector!r} for {', '.join(types)}")
            link = made(self.manager, types)
            self.manager.extended_links.append(link)
            return link
