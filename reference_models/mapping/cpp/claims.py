"""Claims about C++ declarations: each says what must hold of a name, a class or a component."""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract.value import Value
from ucm_cts.reference_models.mapping.cpp.classes import Class, Forms, Sample

StructForm = Literal["accessors", "plain"]
"""How fields are read and written: functions of the field's name, or data members."""


class Claim(Value, frozen=True):
    """What must hold of a declaration."""


class _OfName(Claim, frozen=True):
    name: str


class _OfTypes(_OfName, frozen=True):
    types: tuple[str, ...]


class _OfOwner(Claim, frozen=True):
    owner: Class


class _OfMethod(_OfOwner, frozen=True):
    method: str
    parameters: int


class _Within(Claim, frozen=True):
    owner: str


class _OfField(_Within, frozen=True):
    field: str
    sample: Sample


class _OfFieldInForms(_OfField, frozen=True):
    forms: tuple[StructForm, ...]


class _OfEnumerator(_Within, frozen=True):
    enumerator: str


class _OfConnection(_Within, frozen=True):
    connection: str


class _OfDerived(Claim, frozen=True):
    derived: Class
    base: str


# claims about names and types
class Namespace(_OfName, frozen=True):
    """There is a namespace of this name."""


class Declares(_OfName, frozen=True):
    """``name`` is a type."""


class Is(_OfTypes, frozen=True):
    """``name`` is the same type as one of ``types``."""


class ArrayOf(_OfName, frozen=True):
    """``name`` is ``template`` of ``element``, nested ``depth`` times."""

    template: str
    element: str
    depth: int


class Sizes(_OfName, frozen=True):
    """Values of ``name`` have so many elements, and their elements as many as the next size says."""

    sizes: tuple[int, ...]


class BoundedSequence(_OfName, frozen=True):
    """``name`` is ``array`` of so many elements, or a vector that holds no more; one of ``forms``."""

    array: str
    element: Sample
    size: int
    forms: tuple[Literal["array", "bounded-vector"], ...]


class IsClass(_OfName, frozen=True):
    """``name`` is a class."""


class Regular(_OfName, frozen=True):
    """``name`` can be made without arguments, copied and assigned."""


class Field(_OfFieldInForms, frozen=True):
    """A value written to ``field`` of ``owner`` is read from it."""


class Copied(_OfFieldInForms, frozen=True):
    """A value written to ``field`` of ``owner`` is there in copies and what it is assigned to, or in what is caught."""

    thrown: bool = False


class Changed(_OfField, frozen=True):
    """A value assigned to what the accessor ``field`` of ``owner`` returns is read from it."""


class Constructed(_Within, frozen=True):
    """``owner`` is made from a value of each of its fields, in their order; ``fields`` has names and values."""

    fields: tuple[tuple[str, Sample], ...]


class Discriminator(_Within, frozen=True):
    """Once ``case`` of the union ``owner`` was written, and read, one of ``functions`` returns one of ``values``."""

    functions: tuple[str, ...]
    case: str
    sample: Sample
    values: tuple[str, ...]
    forms: tuple[StructForm, ...]


class EnumForm(_OfName, frozen=True):
    """``name`` is an enumeration, scoped or not as ``forms`` say."""

    forms: tuple[Literal["enum", "enum-class"], ...]


class FixedType(_OfName, frozen=True):
    """The enumeration is scoped, or its declaration names the type of its values."""


class Underlying(_OfTypes, frozen=True):
    """``name`` is stored as one of ``types``."""


class EnumeratorOf(_OfEnumerator, frozen=True):
    """``enumerator`` is found in ``owner`` and gives a value of ``type``."""

    type: str


class EnumeratorValue(_OfEnumerator, frozen=True):
    """``enumerator`` in ``owner`` has the index ``value``."""

    value: int


class NoOtherEnumerators(_OfName, frozen=True):
    """All values of the enumeration ``name`` are called by one of ``enumerators``."""

    enumerators: tuple[str, ...]


class SafeEnum(_OfName, frozen=True):
    """``name`` is an instance of ``ucm::safe_enum`` with ``definition`` as its first parameter."""

    definition: str


class SafeEnumInner(_OfTypes, frozen=True):
    """``name`` is an instance of ``ucm::safe_enum`` with one of ``types`` as its second parameter."""


class Works(Claim, frozen=True):
    """What ``subject`` is named for works as the standard says; ``types`` and ``values`` are what it is tried with."""

    subject: Literal[
        "safe-enum-construction",
        "safe-enum-underlying",
        "safe-enum-comparison",
        "safe-enum-default",
        "array",
        "shared_ptr",
    ]
    types: tuple[str, ...]
    values: tuple[str, ...] = ()
    detail: str = ""


class IsConstant(_OfName, frozen=True):
    """Nothing can be assigned to ``name``."""


class ConstantIs(_OfName, frozen=True):
    """``name`` has the type ``type`` and equals ``value``."""

    type: str
    value: str


class NotInHeader(_OfName, frozen=True):
    """No header gives the constant ``name`` its value."""


# claims about classes
class Derives(_OfDerived, frozen=True):
    """A reference to ``derived`` is one to ``base``."""


class NotDerived(_OfDerived, frozen=True):
    """``derived`` does not derive from ``base``."""


class IsAbstract(Claim, frozen=True):
    """No object can be made of ``name``."""

    name: Class


class NoMember(_OfOwner, frozen=True):
    """``owner`` has no member ``member``."""

    member: str


class Thrown(_OfName, frozen=True):
    """What is thrown as ``name`` is caught as ``base``."""

    base: str


class NotCorba(_OfOwner, frozen=True):
    """Nothing that ``owner`` derives from is declared in a namespace CORBA."""


class Pure(_OfOwner, frozen=True):
    """``method`` of ``owner``, with so many parameters, is public and pure virtual; ``key`` is what ``owner`` consists of."""

    key: str
    method: str
    parameters: int


class Arity(_OfMethod, frozen=True):
    """``method`` of ``owner`` has so many parameters, and is constant only if ``forms`` say so.

    Of several such functions one has one of ``forms``.
    """

    forms: Forms = Forms()


class Passed(_OfMethod, frozen=True):
    """A parameter of ``method`` of ``owner``, counted from 1, is passed as one of ``types``; 0 is the result.

    ``parameters`` is how many the method has.
    """

    position: int
    types: tuple[str, ...]
    forms: Forms = Forms()


class NoMutator(_OfOwner, frozen=True):
    """``owner`` has no function ``method`` that takes one value of ``type``."""

    method: str
    type: str


class NothingElse(_OfOwner, frozen=True):
    """All pure virtual functions of ``owner`` are among ``members``."""

    members: tuple[str, ...]


class NoOperations(_OfOwner, frozen=True):
    """The class ``base`` that ``owner`` derives from has no member functions of its own."""

    base: str


class Implemented(_OfOwner, frozen=True):
    """A class that defines the functions of ``key`` and derives from ``owner`` can be made, and calls come to it."""

    key: str


class InheritsElement(_OfOwner, frozen=True):
    """``owner`` derives from PortElementObject, in any namespace."""


# claims about components
class DeclaresConnection(_OfConnection, frozen=True):
    """``connection`` is a type where the class ``owner`` is declared, or in it."""


class ConnectionShape(_OfConnection, frozen=True):
    """``connection`` of ``owner`` has a string ``port_name`` and a reference ``ref``, and is made of both."""


class ConnectionTemplate(_OfConnection, frozen=True):
    """``connection`` of ``owner`` is an instance of a class template PortConnection."""


class ConnectionTo(_OfConnection, frozen=True):
    """The reference of ``connection`` of ``owner`` leads to the class ``interface`` or one that derives from it."""

    interface: str


class Startup(_Within, frozen=True):
    """``on_startup`` of ``owner`` takes from ``least`` to ``most`` constant references, all of ``connections`` among them."""

    least: int
    most: int
    connections: tuple[str, ...]


class StartupTakes(_OfConnection, frozen=True):
    """Among what ``on_startup`` takes is a constant reference of type ``connection``, as often as this is the type of one of the
    connections that ``startup`` names.
    """

    startup: Startup


class ReturnsReference(_Within, frozen=True):
    """``getter`` of ``owner`` returns a shared pointer; to ``interface``, or what derives from it, if that has a name."""

    getter: str
    interface: str


class Runs(_Within, frozen=True):
    """A component that implements ``owner`` lives: it is started, called, calls what it is connected to, and is stopped."""

    key: str
