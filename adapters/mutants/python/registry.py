"""Where derived frameworks are registered: mutants by the requirements they must fail, conformant variants by name.

``@breaks(requirement, ...)`` names what the suite must find: every named requirement fails, and no other, except those
in ``also``: requirements that the same defect breaks, too.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import PortConnection, PortElementObject
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.connectors import Link
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import HasMembers, Member
from ucm_cts.adapters.reference.python.object_timers import ScheduledTimer, Triggers
from ucm_cts.adapters.reference.python.pacing import Pace, PacedExecutor
from ucm_cts.adapters.reference.python.request_response import RequestResponseLink
from ucm_cts.adapters.reference.python.shared_data import SharedDataLink
from ucm_cts.adapters.reference.python.timers import Timers

CONTAINER = ("11", "12.10")
POLICIES = ("10.1.3",)
REQUESTS = ("10.4.1",)
SHARED = ("10.4.2",)
PACED = ("10.5",)
TIMED = ("10.3.2",)
TRIGGERED = ("10.3.1",)
CORE = ("10.1.1", "10.1.2", "10.1.4", "10.1.5", "10.1.6")

MISSING_CALLBACKS = (
    "R-10.3.2-21",
    "R-10.3.2-30",
    "R-10.3.2-33",
    "R-10.3.2-36",
    "R-10.3.2-37",
    "R-10.3.2-39",
    "R-10.3.2-44",
    "R-10.3-04",
)
"""What a callback of a timer that does not come breaks, by what sets its timer apart."""

MISSING_TRIGGERS = ("R-10.3.1-18", "R-10.3.1-23", "R-10.3.1-32", "R-10.3.1-34", "R-10.3.1-36")
"""The same for triggers of object timers."""


@dataclass(frozen=True)
class Mutant:
    """A defective framework's adapter and the ``requirements`` it must fail; ``also`` are those it may fail, too.

    ``clauses`` are those whose test purposes are to find it out, ``readings`` what its vendor declares of options.
    ``made_from`` is the conformant variant that was altered; without one it was the reference framework.
    """

    name: str
    adapter: type[ReferenceAdapter]
    requirements: tuple[str, ...]
    also: tuple[str, ...] = ()
    clauses: tuple[str, ...] = CONTAINER
    readings: Mapping[str, str] = field(default_factory=dict)
    made_from: str = ""

    @property
    def lie(self) -> str:
        """The defect, in one sentence or two."""
        return " ".join((self.adapter.__doc__ or "").split())


@dataclass(frozen=True)
class Variant:
    """A conformant framework's adapter, of interest for the test purposes of ``clauses`` under declared ``readings``."""

    name: str
    adapter: type[ReferenceAdapter]
    clauses: tuple[str, ...]
    readings: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Cheat:
    """An adapter that hides what a framework does. ``detected_by`` says what must come out, all of it: requirements that fail,
    or kinds of incident; nothing if no observation can tell it from an honest adapter of a conformant framework.

    ``or_else`` says what comes out instead where ``detected_by`` depends on time and the machine is busy, or on a sandbox.
    ``endpoint`` is how it is named on the command line. ``rehearsals`` are runs in which it learns, before it cheats.
    """

    name: str
    endpoint: str
    lie: str
    detected_by: tuple[str, ...]
    clauses: tuple[str, ...] = CONTAINER
    rehearsals: int = 0
    adapter: type[ReferenceAdapter] | None = None
    or_else: tuple[str, ...] = ()


MUTANTS: dict[str, Mutant] = {}
VARIANTS: dict[str, Variant] = {}
CHEATS: dict[str, Cheat] = {}
UNSEEN: dict[str, Cheat] = {}
"""Cheats that no observation detects; an auditor must find them (docs/honesty.md)."""


def adapter_of(name: str) -> type[ReferenceAdapter] | None:
    """The adapter of the derived framework ``name``, if the module that registers it has been imported."""
    known = (registered[name].adapter for registered in (MUTANTS, VARIANTS, CHEATS, UNSEEN) if name in registered)
    return next((adapter for adapter in known if adapter is not None), None)


def mutants_of(clauses: tuple[str, ...]) -> dict[str, Mutant]:
    """The mutants that the test purposes of some of these clauses must detect."""
    return {name: mutant for name, mutant in MUTANTS.items() if mutant.clauses[0].startswith(clauses)}


def variants_of(clauses: tuple[str, ...]) -> dict[str, Variant]:
    """The variants that are of interest for some of these clauses."""
    return {name: variant for name, variant in VARIANTS.items() if variant.clauses[0].startswith(clauses)}


def bind(name: str, part: type, doc: str | None = None) -> type[ReferenceAdapter]:
    """An adapter for the reference framework with ``part`` in the place where it belongs.

    A ``Link`` is the class of all connectors of 10.1, a ``RequestResponseLink`` of those of 10.4.1, a ``SharedDataLink`` of those of
    10.4.2; a ``Pace`` and a ``PacedExecutor`` serve components of 10.5, ``Timers`` those of 10.3.2, ``Triggers`` and ``ScheduledTimer`` those of 10.3.1; a ``Proxy`` is what ``get_port_element`` returns, a ``PeerProxy`` what components get at start, and any other class is a
    mixin in front of both container classes.
    """
    mixin = part
    if issubclass(part, Link):
        mixin = type(name, (Base,), {"link_class": part})
    elif issubclass(part, RequestResponseLink):
        mixin = type(name, (Base,), {"request_response_class": part})
    elif issubclass(part, SharedDataLink):
        mixin = type(name, (Base,), {"shared_data_class": part})
    elif issubclass(part, Pace):
        mixin = type(name, (Base,), {"pace_class": part})
    elif issubclass(part, PacedExecutor):
        mixin = type(name, (Base,), {"paced_executor_class": part})
    elif issubclass(part, ScheduledTimer):
        mixin = type(name, (Base,), {"triggers_class": type(name, (Triggers,), {"timer_class": part})})
    elif issubclass(part, Triggers):
        mixin = type(name, (Base,), {"triggers_class": part})
    elif issubclass(part, Timers):
        mixin = type(name, (Base,), {"timers_class": part})
    elif issubclass(part, Proxy):
        giver = HandsOverProxies if issubclass(part, PeerProxy) else GivesOutProxies
        mixin = type(name, (giver,), {"proxy": part})
    container = type(name, (mixin, Container), {})
    manager = type(f"{name}_manager", (mixin, ContainerManager), {"container_class": container})
    return type(f"{name}_adapter", (ReferenceAdapter,), {"manager_class": manager, "product": name, "__doc__": doc})


def breaks(
    *requirements: str,
    also: tuple[str, ...] = (),
    clauses: tuple[str, ...] = CONTAINER,
    readings: Mapping[str, str] = {},
) -> Callable[[type], type]:
    """Register the decorated mixin as a mutant that the test purposes of ``clauses`` must detect."""

    def register(mixin: type) -> type:
        name = mixin.__name__
        assert adapter_of(name) is None, name
        adapter = bind(name, mixin, mixin.__doc__)
        MUTANTS[name] = Mutant(name, adapter, requirements, also, clauses, readings, _variant_below(mixin))
        return mixin

    return register


def _variant_below(mixin: type) -> str:
    """The registered variant that ``mixin`` derives from, the nearest one; empty if from none."""
    for base in mixin.__mro__[1:]:
        variant = VARIANTS.get(base.__name__)
        if variant is not None and issubclass(variant.adapter.manager_class, base):
            return variant.name
    return ""


class Row(NamedTuple):
    """A mutant of a family: ``value`` is what is wrong, and ``requirement`` what it breaks."""

    requirement: str
    lie: str
    value: Any
    also: tuple[str, ...] = ()
    readings: Mapping[str, str] = {}


def family(base: type, attribute: str, rows: Mapping[str, Row], clauses: tuple[str, ...]) -> None:
    """Make each row a mutant: ``base`` with the row's value as ``attribute``."""
    for name, row in rows.items():
        value = staticmethod(row.value) if callable(row.value) else row.value
        mixin = type(name, (base,), {attribute: value, "__doc__": row.lie})
        breaks(row.requirement, also=row.also, clauses=clauses, readings=row.readings)(mixin)


def variant_of(*clauses: str, readings: Mapping[str, str] = {}) -> Callable[[type], type]:
    """Register the decorated mixin as a conformant framework that is of interest for the purposes of ``clauses``."""

    def register(mixin: type) -> type:
        name = mixin.__name__
        assert adapter_of(name) is None, name
        VARIANTS[name] = Variant(name, bind(name, mixin, mixin.__doc__), clauses, readings)
        return mixin

    return register


def cheats(
    *detected_by: str, clauses: tuple[str, ...] = CONTAINER, rehearsals: int = 0, or_else: tuple[str, ...] = ()
) -> Callable[[type[ReferenceAdapter]], type[ReferenceAdapter]]:
    """Register the decorated adapter as a cheat; without ``detected_by`` as one that no observation detects."""

    def register(adapter: type[ReferenceAdapter]) -> type[ReferenceAdapter]:
        name = adapter.__name__
        lie = " ".join((adapter.__doc__ or "").split())
        known = CHEATS if detected_by else UNSEEN
        assert name not in {**CHEATS, **UNSEEN, **MUTANTS, **VARIANTS}, name
        adapter.product = name
        known[name] = Cheat(name, f"{__package__}:{name}", lie, detected_by, clauses, rehearsals, adapter, or_else)
        return adapter

    return register


def variant(mixin: type) -> type:
    """Register the decorated mixin as a conformant framework of interest for the container profile."""
    return variant_of(*CONTAINER)(mixin)


class Base(Container):
    """The base of mixins; it gives them the types of a container."""


class Proxy(PortElementObject):
    """Stands for a body's port element; calls go through it."""

    def __init__(self, target: PortElementObject, member: Member) -> None:
        self.target, self.member = target, member

    def exchange(self, value: int) -> int:
        return self.target.exchange(value)

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self.target.call(method, arguments)


class PeerProxy(Proxy):
    """A proxy that only ``member`` uses, which gets it at start."""


class HandsOverProxies(Base):
    """Components are given proxies at start, one a reference."""

    proxy: type[Proxy] = Proxy

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return [PortConnection(d.from_port, tuple(self.proxy(t, member) for t in d.to_port if t)) for d in given]


class GivesOutProxies(Base):
    """get_port_element gives out proxies to the test; components are connected to the bodies' own objects."""

    proxy: type[Proxy] = Proxy

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        return self.proxy(element, self.members[comp_instance])

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        return super().connect(instance, port_name, to_port.target if isinstance(to_port, Proxy) else to_port)


def container_of(member: Member) -> Container:
    """The container that has the member."""
    assert isinstance(member.container, Container)
    return member.container


def is_below(container: HasMembers) -> bool:
    """Is it a sub-container?"""
    return container is not container.manager
