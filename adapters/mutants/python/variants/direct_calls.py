"""Conformant frameworks that guard what components and connectors call, and not what the test itself calls (``raw-references``)."""

from __future__ import annotations

from ucm_cts.adapters.contract.data_types import Interface
from ucm_cts.adapters.contract.programming_model import PortElementObject
from ucm_cts.adapters.mutants.python.registry import POLICIES, Base, variant_of
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.policies import ProtectedElement


@variant_of(*POLICIES, readings={"raw-references": "unprotected"})
class protects_what_components_call(Base):
    """get_port_element gives out the bodies' own objects; components and connectors get protected references."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        return element.element if isinstance(element, ProtectedElement) else element

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        protected = [
            container._reference_to(provider, provided)
            for container in (self.manager, *self.manager.sub_containers)
            for provider in container.members.values()
            for provided in provider.implementation.provides
            if provider.body.get_portElement(provided) is target
        ]
        return super()._connect_to(member, port, next(filter(None, protected), target))

    def _interfaces_of(self, target: PortElementObject) -> list[Interface | None]:
        return []


@variant_of("10.3", readings={"raw-references": "unprotected"})
class protects_what_timers_call(protects_what_components_call):
    """The same, beside timers."""


@variant_of("10.4", readings={"raw-references": "unprotected"})
class protects_what_extended_connectors_call(protects_what_components_call):
    """The same, beside requests and shared data."""


@variant_of("10.5", readings={"raw-references": "unprotected"})
class paces_what_components_call(protects_what_components_call):
    """The same; executions by the policies of 10.5 are paced where components call."""
