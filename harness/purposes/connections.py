"""Connections with the core connectors (10.1.5, 10.1.6): the steps that make one, the same for both connectors."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Integer, Interface, Method, Parameter, message_interface
from ucm_cts.adapters.contract.scenario import MANAGER, Scenario, Step

SERVICE: Final = s.SERVICE_CONNECTOR
MESSAGE: Final = s.MESSAGE_CONNECTOR

Connector = Literal["simple_service_connector", "simple_message_connector"]

PROVIDER: dict[str, Literal["server", "receiver"]] = {SERVICE: "server", MESSAGE: "receiver"}
"""By connector: the role of an end whose port element is provided."""

REQUIRER: dict[str, Literal["client", "emitter"]] = {SERVICE: "client", MESSAGE: "emitter"}
"""By connector: the role of an end whose port element is required."""


SERVE: Final = "serve"
INTERFACES: dict[str, Interface] = {
    SERVICE: Interface({SERVE: Method((Parameter("given", "IN", Integer("LONG")),))}),
    MESSAGE: message_interface(Integer("ULONG")),
}
"""By connector: an interface that takes a number and gives nothing."""


def provided_end(connector: str, link: str, component: str, port: str = "in.api", container: str = MANAGER) -> Step:
    """Makes provided ``port`` of ``component`` an end of ``link``."""
    return s.Attach(link, PROVIDER[connector], component, port, container)


def required_end(connector: str, link: str, component: str, port: str = "out.api", container: str = MANAGER) -> Step:
    """Makes required ``port`` of ``component`` an end of ``link``."""
    return s.Attach(link, REQUIRER[connector], component, port, container)


def required_ends(scenario: Scenario) -> Iterator[tuple[str, str, str]]:
    """The required port elements that ``scenario`` attaches: the variable of the component, the port element, the connector."""
    connectors = {step.bind: step.connector for step in scenario.steps if isinstance(step, s.Link)}
    for step in scenario.steps:
        if isinstance(step, s.Attach) and step.role in REQUIRER.values() and step.link in connectors:
            yield step.id, step.port, connectors[step.link]
