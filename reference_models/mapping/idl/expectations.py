"""Expectations of a vendor's IDL, one for each demand of a requirement on one element of a model.

A ``path`` is where a declaration stands, from the root, in the names of the model: hyphens are still there. Types name what they
mean by such paths (``::m::t``); a path of an abstract type stands for the parameter of a template.
"""

from __future__ import annotations

import msgspec

from ucm_cts.reference_models.mapping.idl.declarations import Type

Path = tuple[str, ...]

STANDS_FOR: dict[str, tuple[str, ...]] = {
    "idl_generated": ("R-12-01",),
    "idl_syntax": ("R-12.1-03",),
    "idl_building_blocks": ("R-12.1-02",),
    "idl_types": (
        "R-12.2-03",
        *(f"R-12.3.1-{n:02}" for n in range(1, 14)),
        *(f"R-12.4.1-{n:02}" for n in range(1, 13)),
    ),
    "idl_annotations": (
        *("R-12.3.2-02", "R-12.3.2-03", "R-12.4.1.1-02", "R-12.4.1.1-03", "R-12.4.1.3-02", "R-12.4.1.3-03"),
        *(f"R-12.4.1.2-{n:02}" for n in (2, 4, 5, 6)),
        *(f"R-14-{n:02}" for n in range(2, 7)),
    ),
    "idl_constants": ("R-12.5-01", "R-12.5-02", "R-12.5-03"),
    "idl_interfaces": tuple(f"R-12.6-{n:02}" for n in range(1, 11)),
    "idl_modules": tuple(f"R-12.7-{n:02}" for n in range(2, 13)),
    "idl_components": (
        *(f"R-12.8.1-{n:02}" for n in range(1, 7)),
        *("R-12.8.2-01", "R-12.8.2-02", "R-12.8.2-03", "R-12.8.2-04", "R-12.8.3-01", "R-12.8.3-02"),
        *(f"R-12.8.4-{n:02}" for n in (2, 4, 5, 6, 7)),
        *(f"R-12.8.5-{n:02}" for n in (2, 3, 4, 5)),
    ),
    "idl_interactions": (
        *("R-12.9-02", "R-12.9-03", "R-12.9-05"),
        *("R-9.1.2-02", "R-9.3.3.7-01", "R-9.4.1-07", "R-9.5.5.9-01"),
    ),
    "idl_equivalents": (
        *("R-9.3.2.3-02", "R-9.3.4.7-01", "R-9.3.4.7-02", "R-9.3.5.5-01", "R-9.3.5.5-02", "R-9.3.5.5-03"),
        *("R-9.5.3.10-02", "R-9.5.3.10-04", "R-9.5.3.10-06"),
    ),
    "idl_decoration": ("R-9.2.9.4-04",),
    "idl_standard": (
        *(f"R-12.10-{n:02}" for n in range(29, 39)),
        "R-12.11.1-01",
        *(f"R-12.11.2-{n:02}" for n in range(1, 8)),
        *(f"R-12.11.3-{n:02}" for n in range(1, 6)),
    ),
}
"""The checks of profile idl, and the requirements that each stands for."""

RULE_OF = {requirement: rule for rule, requirements in STANDS_FOR.items() for requirement in requirements}


class Expected(msgspec.Struct, frozen=True, kw_only=True):
    """``element`` is the model's element by its qualified name, ``line`` where it stands in the model."""

    requirement: str
    element: str
    line: int
    path: Path

    @property
    def rule(self) -> str:
        """The check that the requirement belongs to."""
        return RULE_OF[self.requirement]


class Declares(Expected, frozen=True, kw_only=True):
    """There is a declaration of ``kind``; unless ``needed`` nothing is wrong without it."""

    kind: str
    needed: bool = True


class Means(Expected, frozen=True, kw_only=True):
    """What stands at the path has a type that means ``type``: a typedef, member, case, attribute, constant, operation."""

    type: Type


class Selects(Expected, frozen=True, kw_only=True):
    """The selector of the union has the type ``type``."""

    type: Type


class Lists(Expected, frozen=True, kw_only=True):
    """Its members, cases or enumerators are these, in this order if it is ``ordered``."""

    names: tuple[str, ...]
    ordered: bool = True


class Ordered(Expected, frozen=True, kw_only=True):
    """Its enumerators stand in one of these orders, unless option idl-enumerator-order frees them."""

    orders: tuple[tuple[str, ...], ...]


class Takes(Expected, frozen=True, kw_only=True):
    """The operation's parameters: direction and name of each; what the names count for is option idl-parameter-names."""

    parameters: tuple[tuple[str, str], ...]


class TakesType(Expected, frozen=True, kw_only=True):
    """The parameter at the path, the one at ``position`` (from 0) of ``parameters`` (see ``Takes``), has a type that means ``type``."""

    position: int
    parameters: tuple[tuple[str, str], ...]
    type: Type


class Labelled(Expected, frozen=True, kw_only=True):
    """The case of a union holds for these enumerators of the enumeration around them, and, if ``default``, for all others."""

    labels: tuple[Path, ...]
    default: bool


class Raises(Expected, frozen=True, kw_only=True):
    """The operation raises just these exceptions."""

    exceptions: tuple[Path, ...]


class Only(Expected, frozen=True, kw_only=True):
    """The interface has no other operations or attributes, not even inherited ones.

    ``kind``: operation or attribute.
    ``names``: the permitted names.
    ``tolerated``: permitted ends of names.
    ``patterns``: patterns of permitted names, with ``*`` for any part.
    ``ancestors``: all interfaces that the model lets it inherit from; what they have is permitted.
    """

    kind: str
    names: tuple[str, ...]
    tolerated: tuple[str, ...] = ()
    patterns: tuple[str, ...] = ()
    ancestors: tuple[Path, ...] = ()


class Inherits(Expected, frozen=True, kw_only=True):
    """The interface inherits, directly or not, from ``base``; a base of one name may stand in any module."""

    base: Path


class InheritsNone(Expected, frozen=True, kw_only=True):
    """The interface has none of ``bases``, names of 12.10, among its ancestors."""

    bases: tuple[str, ...]


class Access(Expected, frozen=True, kw_only=True):
    """The attribute can be written, or only read."""

    readonly: bool


class Valued(Expected, frozen=True, kw_only=True):
    """The constant's value is what ``value``, in IDL's syntax, means for ``type``."""

    type: Type
    value: str


class Numbered(Expected, frozen=True, kw_only=True):
    """Each enumerator has its value: by an annotation, or by its position if there is none."""

    values: tuple[tuple[str, int], ...]


class Tagged(Expected, frozen=True, kw_only=True):
    """The declaration carries the annotation ``name``; ``maximum`` is its value if it has one."""

    name: str
    maximum: int | None = None


class Indexed(Expected, frozen=True, kw_only=True):
    """An IndexType annotation names an integer type of one of the ``kinds`` of the model."""

    kinds: tuple[str, ...]


class Defaulted(Expected, frozen=True, kw_only=True):
    """A default value, if the IDL gives one, is the model's ``value`` of ``type``."""

    type: Type
    value: str


class Templated(Expected, frozen=True, kw_only=True):
    """The module's parameters: each of ``required`` (paths of abstract types), none beyond ``allowed``."""

    required: tuple[Path, ...]
    allowed: tuple[Path, ...]


class Parametrized(Expected, frozen=True, kw_only=True):
    """The module's parameter for the abstract type ``parameter``: its ``keyword`` if that is asked, else its name."""

    parameter: Path
    keyword: str = ""


class Signature(msgspec.Struct, frozen=True):
    """An operation of an interface with all abstract types bound: direction, name and type of its parameters."""

    name: str
    returns: Type
    parameters: tuple[tuple[str, str, Type], ...]


class BoundInterface(msgspec.Struct, frozen=True):
    """What an interface has, inherited members too, with all abstract types bound: operations, and names and types of attributes."""

    signatures: tuple[Signature, ...]
    attributes: tuple[tuple[str, Type], ...]


class Getter(Expected, frozen=True, kw_only=True):
    """The interface at ``path`` has this operation, itself or by inheritance.

    ``aspect``: what is expected of it: presence, arguments or result.
    ``names``: alternative names, with ``*`` for any part.
    ``returns``: the type of the result.
    ``otherwise``: the interface that has it if there is none at ``path``.
    ``bound``: if given, the result may be any interface with these operations, and with these types of its attributes.
    ``needed``: whether it must be there.
    """

    aspect: str
    names: tuple[str, ...]
    returns: Type
    otherwise: Path = ()
    bound: BoundInterface | None = None
    needed: bool = True


class NoGetter(Expected, frozen=True, kw_only=True):
    """The interface has none of the operations ``names``, not even inherited."""

    names: tuple[str, ...]


class NoMember(Expected, frozen=True, kw_only=True):
    """The interface has no operation and no attribute of these names itself; ``*`` is any part of a name."""

    names: tuple[str, ...]


class Undeclared(Expected, frozen=True, kw_only=True):
    """Nothing has been made of this element: there is no declaration of its name where it would stand."""


class Equivalent(Expected, frozen=True, kw_only=True):
    """It is there as ``kind`` (connector or porttype), as clause 9 shows it."""

    kind: str


class EquivalentMember(Expected, frozen=True, kw_only=True):
    """The ``kind`` at the path has a member of ``keyword`` and ``name``; ``type`` is where its type stands, empty if that is open."""

    kind: str
    keyword: str
    name: str
    type: Path


class EquivalentComponent(Expected, frozen=True, kw_only=True):
    """A component of the name has just these ``names`` of an ``aspect``: ports, attributes or base."""

    aspect: str
    names: tuple[str, ...]


class OnlyInteractions(Expected, frozen=True, kw_only=True):
    """The module has nothing but connectors, port types and modules."""


class Abstract(msgspec.Struct, frozen=True):
    """An abstract type of the model: ``keyword`` of a template's parameter, and the ``name`` in the model."""

    keyword: str
    name: str


class ExpectedIdl(msgspec.Struct, frozen=True):
    """All that is expected of a model.

    ``facts``: the expectations.
    ``types``: the types that data types with a typedef rename, by path.
    ``abstract``: the abstract types, by path.
    ``unmapped``: data types without a mapping in clause 12; what refers to them is not judged.
    """

    facts: tuple[Expected, ...]
    types: dict[Path, Type]
    abstract: dict[Path, Abstract]
    unmapped: frozenset[Path] = frozenset()
