"""Containers that several threads may call at once, as their vendors declare: one that bears it, and others that do not."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from ucm_cts.adapters.contract.programming_model import PortElementObject, UcmError
from ucm_cts.adapters.mutants.python.registry import CONTAINER, Base, breaks, variant_of
from ucm_cts.adapters.reference.python.members import Failures, Member

_AT_ONCE = {"container-operations": "at-once"}
_SECONDS = 0.0005


@variant_of(*CONTAINER, readings=_AT_ONCE)
class bears_operations_at_once(Base):
    """The vendor declares that several threads may call containers at once; their operations wait for each other."""


class _Unlocked(Base):
    """Operations do not wait for each other."""

    @contextmanager
    def _operation(self) -> Iterator[None]:
        self._check_alive()
        yield


@breaks("R-11.2.2.1-14", also=("R-12.10-15",), readings=_AT_ONCE)
class loses_members_added_at_once(_Unlocked):
    """Of components that are added at once only the last one becomes a member."""

    def _initialise(self, member: Member) -> None:
        before = dict(self.members)
        time.sleep(_SECONDS)
        super()._initialise(member)
        self.members = before


@breaks("R-11.2.2.1-03", also=("R-11.2.2.1-14", "R-11.2.1.2-06"), readings=_AT_ONCE)
class gives_the_same_number_twice_at_once(_Unlocked):
    """Components that are added at once get the same number."""

    def _new_id(self) -> int:
        number = int(vars(self.manager).get("highest", 0)) + 1
        time.sleep(_SECONDS)
        vars(self.manager)["highest"] = number
        return number


@breaks("R-11.2.1.2-06", also=("R-11.2.2.1-14",), readings=_AT_ONCE)
class announces_one_of_several_removals(Base):
    """Of components that are removed at once only one gets on_remove."""

    def remove_component(self, comp_instance: int) -> None:
        with self._counted("leaving"):
            super().remove_component(comp_instance)

    @contextmanager
    def _counted(self, what: str) -> Iterator[None]:
        self.__dict__[what] = self.__dict__.get(what, 0) + 1
        time.sleep(_SECONDS)
        try:
            yield
        finally:
            self.__dict__[what] -= 1

    def _remove(self, member: Member, failures: Failures) -> None:
        if self.__dict__.get("leaving", 0) > 1:
            del self.members[member.id]
        else:
            super()._remove(member, failures)


@breaks("R-11.2.1.3-02", readings=_AT_ONCE)
class refuses_a_second_connect_at_once(Base):
    """connect is refused while another one is in progress."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        lock: threading.Lock = self.__dict__.setdefault("connecting", threading.Lock())
        if not lock.acquire(blocking=False):
            raise UcmError("busy")
        try:
            time.sleep(_SECONDS)
            return super().connect(instance, port_name, to_port)
        finally:
            lock.release()


@breaks("R-11.2.3-05", readings=_AT_ONCE)
class refuses_to_add_beside_another_one(Base):
    """add_component is refused while another component is being added."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        lock: threading.Lock = self.__dict__.setdefault("adding", threading.Lock())
        if not lock.acquire(blocking=False):
            raise UcmError("busy")
        try:
            return super().add_component(implementation, attributes)
        finally:
            lock.release()
