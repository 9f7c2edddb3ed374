"""Wrong frameworks, clause 10.1: parts are claimed that the adapter does not offer."""

from __future__ import annotations

from ucm_cts.adapters.contract.adapter import NotOffered
from ucm_cts.adapters.contract.data_types import Interface
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR, SERVICE_CONNECTOR
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.reference.python.connectors import Link

_CORE = "R-10.1-01"


@breaks(_CORE, clauses=("10.1.5",))
class has_no_services(Base):
    """The service connector is left out."""

    def link(self, connector: str, interface: Interface) -> Link:
        if connector == SERVICE_CONNECTOR:
            raise NotOffered
        return super().link(connector, interface)


@breaks(_CORE, clauses=("10.1.6",))
class has_no_messages(Base):
    """The message connector is left out."""

    def link(self, connector: str, interface: Interface) -> Link:
        if connector == MESSAGE_CONNECTOR:
            raise NotOffered
        return super().link(connector, interface)


@breaks(_CORE, clauses=("10.1.2",), readings={"transport-fault": "hook", "connector-fault": "hook"})
class never_breaks_a_transport(Link):
    """It is claimed that the transport can be broken, and it cannot."""

    def break_link(self, where: str) -> None:
        if where == "transport":
            raise NotOffered
        super().break_link(where)


@breaks(_CORE, clauses=("10.1.4",), readings={"trace-sink": "hook"})
class keeps_its_log(Base):
    """It is claimed that the trace can be read back, and it cannot."""

    def read_log(self) -> list[tuple[str, str]]:
        raise NotOffered
