"""Conformant variants that read the two phases of 11.2.3 in other ways: for the application, in parallel, or prolonged."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from typing import ClassVar

from ucm_cts.adapters.contract.programming_model import PortElementObject, UcmError
from ucm_cts.adapters.mutants.python.methods import refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import (
    CONTAINER,
    Base,
    GivesOutProxies,
    Proxy,
    is_below,
    variant,
    variant_of,
)
from ucm_cts.adapters.mutants.python.variants.readings import manager_reaches_down
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Failures, State


def _all_containers(container: Container) -> list[Container]:
    return [container.manager, *container.manager.sub_containers]


@replaces("_check_configuring")
def configures_when_nothing_runs(self: Base) -> None:
    """Configuration is refused everywhere while any container is started."""
    if any(container.is_started for container in _all_containers(self)):
        raise UcmError("the application has been started")


@replaces("_check_startable")
def starts_when_all_is_configured(self: Base) -> None:
    """No container is started while a component anywhere is unconfigured."""
    for container in _all_containers(self):
        Container._check_startable(container)


@refuses_if("create_container", readings={"late-container": "refuse"})
def makes_no_late_containers(self: Base) -> bool:
    """A started manager makes no containers."""
    return self.is_started


@refuses_if("_check_startable")
def starts_nothing_empty(self: Base) -> bool:
    """A container without members is not started."""
    return not self.members


@replaces("connect", readings={"self-connection": "refuse"})
def connects_nothing_to_itself(self: Base, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
    """A component's own port element cannot be connected to it."""
    member = self.members.get(instance)
    own = [member.body.get_portElement(port) for port in member.implementation.provides] if member else []
    if to_port is not None and any(to_port is element for element in own):
        raise UcmError("a component is not connected to itself")
    return Base.connect(self, instance, port_name, to_port)


class _Waiting(Proxy):
    """Calls wait until the component is ready, and fail if it is no component any more."""

    ready: threading.Condition
    container: Container

    def _is_removed(self) -> bool:
        return all(self.member not in each.members.values() for each in _all_containers(self.container))

    def exchange(self, value: int) -> int:
        with self.ready:
            self.ready.wait_for(lambda: self.member.state is State.READY or self._is_removed())
        if self._is_removed():
            raise UcmError("the component has been removed")
        return self.target.exchange(value)


@variant
class calls_wait_for_the_start(GivesOutProxies):
    """A call through a reference is served once its component is ready."""

    proxy = _Waiting

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        proxy = super().get_port_element(comp_instance, port_name)
        assert isinstance(proxy, _Waiting)
        proxy.ready, proxy.container = _changes_of(self), self
        return proxy

    def start(self) -> None:
        super().start()
        changes = _changes_of(self)
        with changes:
            changes.notify_all()


def _changes_of(container: Container) -> threading.Condition:
    return container.manager.__dict__.setdefault("changes", threading.Condition())  # type: ignore[no-any-return]


@variant_of(*CONTAINER, readings={"start-order": "at-once"})
class starts_all_at_a_time(Base):
    """Members are started by a thread each, and stopped in the order they were added in reverse."""

    def start(self) -> None:
        with self._operation():
            if self.is_started:
                return
            self._check_startable()
            failures = [Failures() for _ in self.members]
            meeting = threading.Barrier(max(len(self.members), 1))

            def start_up(member: object, own: Failures) -> None:
                meeting.wait()
                self._start_up(member, own)  # type: ignore[arg-type]

            threads = [
                threading.Thread(target=start_up, args=pair)
                for pair in zip(self.members.values(), failures, strict=True)
            ]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            order = list(self.members.values())
            if not any(own.first for own in failures):
                self.started.sort(key=order.index)
                self._begin_operation()
                return
            self._shut_down_started(Failures())
            next(own for own in failures if own.first).report()


@variant
class stays_operational_when_shutdown_fails(Base):
    """A component whose on_shutdown raises stays operational: the next stop tries again, a start starts only the others."""

    def stop(self) -> None:
        with self._operation():
            failures = Failures()
            for member in reversed(tuple(self.started)):
                if failures.attempt(member.body.on_shutdown):
                    member.state = State.CONFIGURING
                    self.started.remove(member)
            self.is_started = bool(self.started)
            failures.report()

    def start(self) -> None:
        with self._operation():
            self._check_startable()
            failures = Failures()
            for member in self._start_order():
                if member not in self.started and not self._start_up(member, failures):
                    self._shut_down_started(failures)
                    failures.report()
            self._begin_operation()


@variant
class stays_operational_below(manager_reaches_down, stays_operational_when_shutdown_fails):
    """The same; after a failed stop of the manager its sub-containers are left alone."""

    def _also(self, own: Callable[[], None], below: Callable[[Container], None]) -> None:
        own()
        if not is_below(self):
            for container in self.manager.sub_containers:
                getattr(container, below.__name__)()


@replaces("_set_attributes")
def attributes_by_name(self: Base, member: object, attributes: Mapping[str, str]) -> None:
    """Attributes are set in the order of their names."""
    Base._set_attributes(self, member, dict(sorted(attributes.items())))  # type: ignore[arg-type]


@variant
class keeps_a_pool_of_threads(Base):
    """All runtimes of a process share threads, of which each start adds one until there are enough. They stay."""

    pool: ClassVar[list[threading.Thread]] = []

    def start(self) -> None:
        super().start()
        if len(self.pool) < _POOL:
            self.pool.append(threading.Thread(target=threading.Event().wait, daemon=True))
            self.pool[-1].start()


@variant
class ends_its_thread_a_little_later(Base):
    """A runtime has a thread that ends some time after destroy."""

    def start(self) -> None:
        super().start()
        if "over" not in self.manager.__dict__:
            over = self.manager.__dict__["over"] = threading.Event()
            threading.Thread(target=_lasts_longer, args=(over,), daemon=True).start()

    def _remove_members(self, failures: Failures) -> None:
        super()._remove_members(failures)
        if "over" in self.__dict__:
            self.__dict__["over"].set()


def _lasts_longer(over: threading.Event) -> None:
    over.wait()
    time.sleep(0.2)


_POOL = 20
