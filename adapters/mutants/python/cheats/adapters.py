"""Adapters that cheat: they hide what a framework does, or that there is none. Each docstring says how.

Most bind a mutant, and hide its defect from a test that observes the Container API only.
"""

from __future__ import annotations

import itertools
import os
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, TypeVar

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract.adapter import ContainerHandle, NotOffered
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.mutants.python.execution import policies
from ucm_cts.adapters.mutants.python.life_cycle import containers, states
from ucm_cts.adapters.mutants.python.registry import POLICIES, Base, bind, cheats
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager

T = TypeVar("T")


def before(*mixins: type) -> type[ReferenceAdapter]:
    """The honest adapter of a framework with these defects, for a cheat to derive from."""
    return bind("hidden", type("hidden", mixins, {}))


# cheats that ask no framework


@cheats("R-11.2.3-05", "R-11.2.2.1-14")
class answers_without_the_framework(ReferenceAdapter):
    """Answers that all is well, with numbers of its own, and never calls the framework."""

    def __init__(self) -> None:
        self.numbers = itertools.count(1)

    def add_component(self, container: Container, implementation: str, attributes: Mapping[str, str]) -> int:
        return next(self.numbers)

    def connect(self, container: Container, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        return next(self.numbers)

    def get_port_element(self, container: Container, comp_instance: int, port_name: str) -> pm.PortElementObject | None:
        return _Answering()

    def remove_component(self, container: Container, comp_instance: int) -> None: ...

    def disconnect(self, container: Container, connection: int) -> None: ...

    def start(self, container: Container) -> None: ...

    def stop(self, container: Container) -> None: ...

    def get_components(self, container: Container) -> list[int]:
        return []


class _Answering(pm.PortElementObject):
    """Answers every call as a body does for which a scenario prescribes no behaviour."""

    def exchange(self, value: int) -> int:
        return ~value


@cheats("R-11.1.3-01")
class answers_calls_itself(ReferenceAdapter):
    """Gives out its own port elements, which answer calls as the bodies would."""

    def get_port_element(self, container: Container, comp_instance: int, port_name: str) -> pm.PortElementObject | None:
        super().get_port_element(container, comp_instance, port_name)
        return _Answering()


@cheats("R-11.2.2.1-06")
class gives_the_same_port_element(ReferenceAdapter):
    """Gives out one port element for a whole container, the first one that the test asked for."""

    def __init__(self) -> None:
        self.given: dict[int, pm.PortElementObject | None] = {}

    def get_port_element(self, container: Container, comp_instance: int, port_name: str) -> pm.PortElementObject | None:
        found = super().get_port_element(container, comp_instance, port_name)
        return self.given.setdefault(id(container), found)


@cheats("R-11.2.3-05")
class reuses_bodies(ReferenceAdapter):
    """Instantiates bodies of an earlier scenario again, which are known to be correct."""

    bodies: ClassVar[dict[tuple[bool, bool, int], list[pm.ComponentObject]]] = {}

    def create_runtime(self, implementations: Sequence[pm.Implementation]) -> ContainerManager:
        return super().create_runtime([_with(one, self._factory(one)) for one in implementations])

    def _factory(self, one: pm.Implementation) -> Callable[[], pm.ComponentObject]:
        def create() -> pm.ComponentObject:
            kept = self.bodies.setdefault((one.connectable, one.fragment, len(one.provides)), [])
            if len(kept) > 1:
                return kept.pop(0)
            kept.append(one.create())
            return kept[-1]

        return create


def _with(one: pm.Implementation, create: Callable[[], pm.ComponentObject]) -> pm.Implementation:
    return pm.Implementation(**{**vars(one), "create": create})


def with_bodies(one: pm.Implementation, change: Callable[[pm.ComponentObject], Any]) -> pm.Implementation:
    """``one`` with bodies that are changed, or wrapped, as soon as they are made."""
    return _with(one, lambda: change(one.create()))


@cheats("R-11.2.2.1-07", "R-11.2.2.1-14")
class invents_ids(ReferenceAdapter):
    """Numbers the components of each container 1, 2, 3 in the order they are added, and lists as many."""

    def __init__(self) -> None:
        self.own: dict[int, list[int]] = {}

    def add_component(self, container: Container, implementation: str, attributes: Mapping[str, str]) -> int:
        own = self.own.setdefault(id(container), [])
        own.append(super().add_component(container, implementation, attributes))
        return len(own)

    def get_components(self, container: Container) -> list[int]:
        return list(range(1, len(super().get_components(container)) + 1))


# cheats that hide errors


class _Forwards(ReferenceAdapter):
    """All operations go through ``forwarded``."""

    def forwarded(self, operation: Callable[[], T]) -> T:
        raise NotImplementedError

    def add_component(self, container: Container, implementation: str, attributes: Mapping[str, str]) -> int:
        return self.forwarded(lambda: super(_Forwards, self).add_component(container, implementation, attributes))

    def remove_component(self, container: Container, comp_instance: int) -> None:
        self.forwarded(lambda: super(_Forwards, self).remove_component(container, comp_instance))

    def get_port_element(self, container: Container, comp_instance: int, port_name: str) -> pm.PortElementObject | None:
        return self.forwarded(lambda: super(_Forwards, self).get_port_element(container, comp_instance, port_name))

    def connect(self, container: Container, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        return self.forwarded(lambda: super(_Forwards, self).connect(container, instance, port_name, to_port))

    def disconnect(self, container: Container, connection: int) -> None:
        self.forwarded(lambda: super(_Forwards, self).disconnect(container, connection))

    def start(self, container: Container) -> None:
        self.forwarded(lambda: super(_Forwards, self).start(container))

    def stop(self, container: Container) -> None:
        self.forwarded(lambda: super(_Forwards, self).stop(container))


@cheats("R-12.10-15", "R-12.10-18")
class hides_errors(_Forwards):
    """Maps every error to success; an operation that should have returned a number returns an unknown one."""

    def forwarded(self, operation: Callable[[], T]) -> T:
        try:
            return operation()
        except Exception:  # noqa: BLE001 - that is the point
            return 0x7A11  # type: ignore[return-value]


@cheats("R-12.10-15", "R-12.10-18")
class makes_all_errors_alike(_Forwards):
    """Maps every error to UCM_ERROR, which every operation may end with."""

    def forwarded(self, operation: Callable[[], T]) -> T:
        try:
            return operation()
        except Exception as error:  # noqa: BLE001 - that is the point
            raise pm.UcmError(str(error)) from None


@cheats("contradiction")
class offers_nothing_that_fails(_Forwards):
    """Reports each operation that fails as not offered, so that the test skips it."""

    def forwarded(self, operation: Callable[[], T]) -> T:
        try:
            return operation()
        except Exception:  # noqa: BLE001 - that is the point
            raise NotOffered from None


@cheats("exit")
class leaves_when_it_fails(_Forwards):
    """Ends the process with status 0 before it would report an error."""

    def forwarded(self, operation: Callable[[], T]) -> T:
        try:
            return operation()
        except (pm.NotFound, pm.BadParameter):
            os._exit(0)


@cheats("refused")
class refuses_what_it_cannot(before(containers.adds_two_member_only)):  # type: ignore[misc]
    """Binds a framework that holds two components only; fails to create a runtime for more."""

    def create_runtime(self, implementations: Sequence[pm.Implementation]) -> Any:
        if len(implementations) > 2:
            raise RuntimeError("no licence for so many")
        return super().create_runtime(implementations)


# cheats that repair what a framework does wrong


class _lists_a_stranger(Base):
    def get_components(self) -> list[int]:
        return [*super().get_components(), 987654]


@cheats("R-11.2.1.4-03")
class lists_from_a_table_of_its_own(before(_lists_a_stranger)):  # type: ignore[misc]
    """Binds a framework that lists members wrongly; lists the members that it added itself."""

    def __init__(self) -> None:
        self.members: dict[int, list[int]] = {}

    def add_component(self, container: Container, implementation: str, attributes: Mapping[str, str]) -> int:
        added: int = super().add_component(container, implementation, attributes)
        self.members.setdefault(id(container), []).append(added)
        return added

    def remove_component(self, container: Container, comp_instance: int) -> None:
        super().remove_component(container, comp_instance)
        self.members[id(container)].remove(comp_instance)

    def get_components(self, container: Container) -> list[int]:
        super().get_components(container)
        return list(self.members.get(id(container), ()))


class _CollectsBodies(ReferenceAdapter):
    """Keeps the bodies that a framework makes."""

    def create_runtime(self, implementations: Sequence[pm.Implementation]) -> ContainerManager:
        self.bodies: list[pm.ComponentObject] = []
        return super().create_runtime([_with(one, self._factory(one)) for one in implementations])

    def _factory(self, one: pm.Implementation) -> Callable[[], pm.ComponentObject]:
        def create() -> pm.ComponentObject:
            self.bodies.append(one.create())
            return self.bodies[-1]

        return create


class _forgets_shutdown(Base):
    def _shut_down_started(self, failures: Any) -> None:
        self.started.clear()
        self.is_started = False


@cheats("R-11.1.3-04")
class calls_the_bodies_itself(_CollectsBodies, before(_forgets_shutdown)):  # type: ignore[misc]
    """Binds a framework that does not call on_shutdown; calls it itself, on all bodies that were made."""

    def stop(self, container: ContainerHandle) -> None:
        super().stop(container)
        for body in reversed(self.bodies):
            body.on_shutdown()


class _Serialised(pm.PortElementObject):
    def __init__(self, target: pm.PortElementObject, lock: Any) -> None:
        self.target, self.lock = target, lock

    def exchange(self, value: int) -> int:
        with self.lock:
            return self.target.exchange(value)

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        with self.lock:
            return self.target.call(method, arguments)


@cheats("R-10.1.3.2-13", clauses=POLICIES)
class serialises_calls(before(policies.leaves_passive_components_open)):  # type: ignore[misc]
    """Binds a framework that protects nothing; calls of the test take a lock of the adapter."""

    def get_port_element(self, container: Container, comp_instance: int, port_name: str) -> pm.PortElementObject | None:
        found = super().get_port_element(container, comp_instance, port_name)
        return _Serialised(found, self.locks.setdefault(comp_instance, threading.RLock()))

    def connect(self, container: Container, instance: int, port_name: str, to_port: pm.PortElementObject | None) -> int:
        direct = to_port.target if isinstance(to_port, _Serialised) else to_port
        return int(super().connect(container, instance, port_name, direct))

    def create_runtime(self, implementations: Sequence[pm.Implementation]) -> Any:
        self.locks: dict[int, Any] = {}
        return super().create_runtime(implementations)


# cheats that know the suite by heart

_SHAPES: set[tuple[Any, ...]] = set()


@cheats("R-11.2.2.1-13", rehearsals=1)
class knows_the_scenarios(ReferenceAdapter):
    """Binds a framework that stops in the wrong order; if a scenario has the same components as one of an earlier run,
    apart from names, it runs the reference framework instead."""

    rehearsing: ClassVar[bool] = True
    wrong: ClassVar[type[ReferenceAdapter]] = before(containers.stops_in_startup_order)

    def create_runtime(self, implementations: Sequence[pm.Implementation]) -> ContainerManager:
        shape = tuple(
            (len(one.provides), len(one.requires), len(one.attributes), one.connectable, one.fragment)
            for one in implementations
        )
        if self.rehearsing:
            _SHAPES.add(shape)
        known = self.rehearsing or shape in _SHAPES
        return super().create_runtime(implementations) if known else self.wrong().create_runtime(implementations)


# what no observation shows


@cheats()
class is_another_product(ReferenceAdapter):
    """Runs the reference framework and reports the name of another product."""


@cheats()
class checks_states_itself(before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; keeps account of what is started, and does not call start again."""

    def __init__(self) -> None:
        self.started: set[int] = set()

    def start(self, container: Container) -> None:
        if id(container) not in self.started:
            super().start(container)
            self.started.add(id(container))

    def stop(self, container: Container) -> None:
        super().stop(container)
        self.started.discard(id(container))


class SwallowsSecondStartups:
    """Wraps a body and has its class; passes all calls on, except on_startup after one that succeeded."""

    def __init__(self, body: Any) -> None:
        self.body, self.startup, self.shutdown = body, body.on_startup, body.on_shutdown
        self.is_up = False

    @property  # type: ignore[misc]
    def __class__(self) -> type:
        return type(self.body)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.body, name)

    def on_startup(self, dependencies: Sequence[pm.PortConnection]) -> None:
        if not self.is_up:
            self.startup(dependencies)
            self.is_up = True

    def on_shutdown(self) -> None:
        self.is_up = False
        self.shutdown()


@cheats()
class wraps_bodies(before(states.starts_twice)):  # type: ignore[misc]
    """Binds a framework that calls on_startup twice; gives it wrapped bodies, which pass on the first call only."""

    def create_runtime(self, implementations: Sequence[pm.Implementation]) -> Any:
        return super().create_runtime([with_bodies(one, SwallowsSecondStartups) for one in implementations])
