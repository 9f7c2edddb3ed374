"""Adapters whose framework fails in some operation, always or now and then; each says how."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Mapping
from typing import Any

from ucm_cts.adapters.contract.adapter import ContainerHandle
from ucm_cts.adapters.contract.programming_model import PortElementObject
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Member


class HangsInStop(ReferenceAdapter):
    """Never comes back from a stop."""

    def stop(self, container: ContainerHandle) -> None:
        threading.Event().wait()


class CrashesInRemove(ReferenceAdapter):
    """Dies when a component is removed."""

    def remove_component(self, container: ContainerHandle, comp_instance: int) -> None:
        os.kill(os.getpid(), signal.SIGSEGV)


class IsSlow(ReferenceAdapter):
    """Takes its time for a start, and never comes back from the removal of no container."""

    def start(self, container: ContainerHandle) -> None:
        time.sleep(0.4)
        super().start(container)

    def remove_container(self, manager: ContainerHandle, sub_container: ContainerHandle) -> None:
        if sub_container is None:
            threading.Event().wait()
        super().remove_container(manager, sub_container)


class _Silent(PortElementObject):
    def exchange(self, value: int) -> int:
        threading.Event().wait()
        raise AssertionError


class LosesCalls(ReferenceAdapter):
    """Calls through references never come back."""

    def get_port_element(self, container: ContainerHandle, comp_instance: int, port_name: str) -> PortElementObject:
        super().get_port_element(container, comp_instance, port_name)
        return _Silent()


class _OfWhatRuns(PortElementObject):
    """Calls of a component that is not operational, or removed, never come back, nor those of one among more than ``most``."""

    def __init__(self, target: PortElementObject, container: Container, member: Member, most: int) -> None:
        self._target, self._container, self._member, self._most = target, container, member, most

    def exchange(self, value: int) -> int:
        if len(self._container.members) > self._most or self._member not in self._container.started:
            threading.Event().wait()
        return self._target.exchange(value)


class LeavesCallsWaiting(ReferenceAdapter):
    """Calls of what is not operational, or removed, wait for ever."""

    most = 1 << 20

    def get_port_element(self, container: ContainerHandle, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(container, comp_instance, port_name)
        assert isinstance(container, Container)
        return _OfWhatRuns(element, container, container.members[comp_instance], self.most)


class LosesCallsBesides(LeavesCallsWaiting):
    """The same; and calls of one of two components are lost."""

    most = 1


class DiesAtOnce(ReferenceAdapter):
    """Ends its host as soon as it is made."""

    def __init__(self) -> None:
        os._exit(7)


class DiesInAdd(ReferenceAdapter):
    """Ends its host when a component is added."""

    def add_component(self, container: ContainerHandle, implementation: str, attributes: Mapping[str, str]) -> int:
        os._exit(5)


class HangsInAdd(ReferenceAdapter):
    """Never comes back when a component is added."""

    def add_component(self, container: ContainerHandle, implementation: str, attributes: Mapping[str, str]) -> int:
        threading.Event().wait()
        raise AssertionError


class AddsNothing(ReferenceAdapter):
    """Says of each component that it adds that it is none."""

    def add_component(self, container: ContainerHandle, implementation: str, attributes: Mapping[str, str]) -> Any:
        super().add_component(container, implementation, attributes)
        return None


class TakesMemoryInStop(ReferenceAdapter):
    """Takes more and more memory."""

    def stop(self, container: ContainerHandle) -> None:
        hoard: list[bytes] = []
        while True:
            hoard.append(os.urandom(1 << 24))
