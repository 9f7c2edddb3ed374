"""Where derived frameworks are registered: wrong ones by the requirements they must fail, conformant ones by name.

``@breaks(requirement, ...)`` names what the suite must find: every named requirement fails, and no other, except those
in ``also``: requirements that are truly broken by the same defect.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import PortElementObject
from ucm_cts.adapters.reference_py.adapter import ReferenceAdapter
from ucm_cts.adapters.reference_py.framework import Container, ContainerManager, Member


@dataclass(frozen=True)
class WrongSubject:
    """A defective framework's adapter and the requirements it must fail."""

    name: str
    adapter: type[ReferenceAdapter]
    requirements: tuple[str, ...]
    also: tuple[str, ...]
    clauses: tuple[str, ...] = ()
    readings: Mapping[str, str] = field(default_factory=dict)


SUBJECTS: dict[str, WrongSubject] = {}

VARIANTS: dict[str, type[ReferenceAdapter]] = {}

POLICY_SUBJECTS: dict[str, WrongSubject] = {}
"""What only components with execution policies show; the container profile has none."""

POLICY_VARIANTS: dict[str, type[ReferenceAdapter]] = {}

POLICY_READINGS: dict[str, Mapping[str, str]] = {}
"""What the vendors of some of these variants declare."""

CORE_SUBJECTS: dict[str, WrongSubject] = {}
"""What only the test purposes of some ``clauses`` of the core show."""

CORE_VARIANTS: dict[str, type[ReferenceAdapter]] = {}

VARIANT_CLAUSES: dict[str, tuple[str, ...]] = {}
VARIANT_READINGS: dict[str, Mapping[str, str]] = {}
"""The clauses that a variant is of interest for; all of the core if it is not there."""


def bind(name: str, mixin: type, doc: str | None = None) -> type[ReferenceAdapter]:
    """An adapter for the reference framework with ``mixin`` in front of both container classes."""
    container = type(name, (mixin, Container), {})
    manager = type(f"{name}_manager", (mixin, ContainerManager), {"container_class": container})
    return type(f"{name}_adapter", (ReferenceAdapter,), {"manager_class": manager, "product": name, "__doc__": doc})


def breaks(*requirements: str, also: tuple[str, ...] = ()) -> Callable[[type], type]:
    """Register the decorated mixin as a wrong subject."""

    def register(mixin: type) -> type:
        adapter = bind(mixin.__name__, mixin, mixin.__doc__)
        SUBJECTS[mixin.__name__] = WrongSubject(mixin.__name__, adapter, requirements, also)
        return mixin

    return register


def variant(mixin: type) -> type:
    """Register the decorated mixin."""
    VARIANTS[mixin.__name__] = bind(mixin.__name__, mixin, mixin.__doc__)
    return mixin


def breaks_policy(
    *requirements: str, also: tuple[str, ...] = (), readings: Mapping[str, str] = {}
) -> Callable[[type], type]:
    """Register the decorated mixin as a framework that applies execution policies wrongly.

    ``readings`` are what its vendor declares of options.
    """

    def register(mixin: type) -> type:
        adapter = bind(mixin.__name__, mixin, mixin.__doc__)
        subject = WrongSubject(mixin.__name__, adapter, requirements, also, readings=readings)
        POLICY_SUBJECTS[mixin.__name__] = subject
        return mixin

    return register


def policy_variant(mixin: type) -> type:
    """Register the decorated mixin as a conformant framework that applies execution policies in its own way."""
    POLICY_VARIANTS[mixin.__name__] = bind(mixin.__name__, mixin, mixin.__doc__)
    return mixin


def policy_variant_under(readings: Mapping[str, str]) -> Callable[[type], type]:
    """Register the decorated mixin as a framework that conforms because its vendor declares ``readings``."""

    def register(mixin: type) -> type:
        POLICY_READINGS[mixin.__name__] = readings
        return policy_variant(mixin)

    return register


def breaks_core(
    *requirements: str, clauses: tuple[str, ...], also: tuple[str, ...] = (), readings: Mapping[str, str] = {}
) -> Callable[[type], type]:
    """Register the decorated mixin as a wrong subject that the test purposes of ``clauses`` are to find out.

    ``readings`` are what its vendor declares of options.
    """

    def register(mixin: type) -> type:
        adapter = bind(mixin.__name__, mixin, mixin.__doc__)
        CORE_SUBJECTS[mixin.__name__] = WrongSubject(mixin.__name__, adapter, requirements, also, clauses, readings)
        return mixin

    return register


def core_variant(mixin: type) -> type:
    """Register the decorated mixin as a conformant framework that does clause 10.1 in its own way."""
    CORE_VARIANTS[mixin.__name__] = bind(mixin.__name__, mixin, mixin.__doc__)
    return mixin


def core_variant_of(*clauses: str, readings: Mapping[str, str] = {}) -> Callable[[type], type]:
    """Register the decorated mixin as a conformant framework that is of interest for the purposes of ``clauses``.

    ``readings`` are what its vendor declares of options.
    """

    def register(mixin: type) -> type:
        core_variant(mixin)
        VARIANT_CLAUSES[mixin.__name__], VARIANT_READINGS[mixin.__name__] = clauses, readings
        return mixin

    return register


class Base(Container):
    """Typing only: what a mixin can rely on."""


class Proxy(PortElementObject):
    """What a framework could give out instead of a body's own object."""

    def __init__(self, target: PortElementObject, member: Member) -> None:
        self.target, self.member = target, member

    def exchange(self, value: int) -> int:
        return self.target.exchange(value)

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self.target.call(method, arguments)


class GivesOutProxies(Base):
    """get_port_element gives out proxies to the test; components are connected to the bodies' own objects."""

    proxy: type[Proxy]

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        return self.proxy(element, self.members[comp_instance])

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        return super().connect(instance, port_name, to_port.target if isinstance(to_port, Proxy) else to_port)


def is_below(container: Container) -> bool:
    """Is it a sub-container?"""
    return container is not container.manager
