"""What the C++ mapping makes of a model: claims about C++ names."""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract.value import Value
from ucm_cts.reference_models.mapping.cpp.classes import Abstract, Class, Forms, Sample

Standard = Literal["cpp11", "cpp03"]

StructForm = Literal["accessors", "plain"]
"""How fields are read and written: functions of the field's name, or data members."""


# claims about names and types
class Namespace(Value, frozen=True):
    """There is a namespace of this name."""

    name: str


class Declares(Value, frozen=True):
    """``name`` is a type."""

    name: str


class Is(Value, frozen=True):
    """``name`` is the same type as one of ``types``."""

    name: str
    types: tuple[str, ...]


class ArrayOf(Value, frozen=True):
    """``name`` is ``template`` of ``element``, as deep as there are ``sizes``, whatever these are."""

    name: str
    template: str
    element: str
    depth: int


class Sizes(Value, frozen=True):
    """Values of ``name`` have so many elements, and their elements as many as the next size says."""

    name: str
    sizes: tuple[int, ...]


class BoundedSequence(Value, frozen=True):
    """``name`` is ``array`` of so many elements, or a vector that holds no more; one of ``forms``."""

    name: str
    array: str
    element: Sample
    size: int
    forms: tuple[Literal["array", "bounded-vector"], ...]


class IsClass(Value, frozen=True):
    """``name`` is a class."""

    name: str


class Regular(Value, frozen=True):
    """``name`` can be made without arguments, copied and assigned."""

    name: str


class Field(Value, frozen=True):
    """A value written to ``field`` of ``owner`` is read from it."""

    owner: str
    field: str
    sample: Sample
    forms: tuple[StructForm, ...]


class Copied(Value, frozen=True):
    """A value written to ``field`` of ``owner`` is there in copies and what it is assigned to, or in what is caught."""

    owner: str
    field: str
    sample: Sample
    forms: tuple[StructForm, ...]
    thrown: bool = False


class Discriminator(Value, frozen=True):
    """Once ``case`` of the union ``owner`` was written, and read, one of ``functions`` returns one of ``values``."""

    owner: str
    functions: tuple[str, ...]
    case: str
    sample: Sample
    values: tuple[str, ...]
    forms: tuple[StructForm, ...]


class EnumForm(Value, frozen=True):
    """``name`` is an enumeration, scoped or not as ``forms`` say."""

    name: str
    forms: tuple[Literal["enum", "enum-class"], ...]


class Underlying(Value, frozen=True):
    """``name`` is stored as one of ``types``."""

    name: str
    types: tuple[str, ...]


class EnumeratorOf(Value, frozen=True):
    """``enumerator`` is found in ``owner`` and gives a value of ``type``."""

    owner: str
    enumerator: str
    type: str


class EnumeratorValue(Value, frozen=True):
    """``enumerator`` in ``owner`` has the index ``value``."""

    owner: str
    enumerator: str
    value: int


class NoOtherEnumerators(Value, frozen=True):
    """All values of the enumeration ``name`` are called by one of ``enumerators``."""

    name: str
    enumerators: tuple[str, ...]


class SafeEnum(Value, frozen=True):
    """``name`` is an instance of ``ucm::safe_enum`` with ``definition`` as its first parameter."""

    name: str
    definition: str


class SafeEnumInner(Value, frozen=True):
    """``name`` is an instance of ``ucm::safe_enum`` with one of ``types`` as its second parameter."""

    name: str
    types: tuple[str, ...]


class Works(Value, frozen=True):
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


class IsConstant(Value, frozen=True):
    """Nothing can be assigned to ``name``."""

    name: str


class ConstantIs(Value, frozen=True):
    """``name`` has the type ``type`` and equals ``value``."""

    name: str
    type: str
    value: str


class NotInHeader(Value, frozen=True):
    """No header gives the constant ``name`` its value."""

    name: str


# claims about classes
class Derives(Value, frozen=True):
    """A reference to ``derived`` is one to ``base``."""

    derived: Class
    base: str


class NotDerived(Value, frozen=True):
    """``derived`` does not derive from ``base``."""

    derived: Class
    base: str


class IsAbstract(Value, frozen=True):
    """No object can be made of ``name``."""

    name: Class


class NoMember(Value, frozen=True):
    """``owner`` has no member ``member``."""

    owner: Class
    member: str


class Thrown(Value, frozen=True):
    """What is thrown as ``name`` is caught as ``base``."""

    name: str
    base: str


class NotCorba(Value, frozen=True):
    """Nothing that ``owner`` derives from is declared in a namespace CORBA."""

    owner: Class


class Pure(Value, frozen=True):
    """``method`` of ``owner``, with so many parameters, is public and pure virtual; ``key`` is what ``owner`` consists of."""

    owner: Class
    key: str
    method: str
    parameters: int


class Arity(Value, frozen=True):
    """``method`` of ``owner`` has so many parameters, and is constant only if ``forms`` say so.

    Of several such functions one has one of ``forms``.
    """

    owner: Class
    method: str
    parameters: int
    forms: Forms = Forms()


class Passed(Value, frozen=True):
    """A parameter of ``method`` of ``owner``, counted from 1, is passed as one of ``types``; 0 is the result.

    ``parameters`` is how many the method has.
    """

    owner: Class
    method: str
    parameters: int
    position: int
    types: tuple[str, ...]
    forms: Forms = Forms()


class NoMutator(Value, frozen=True):
    """``owner`` has no function ``method`` that takes one value of ``type``."""

    owner: Class
    method: str
    type: str


class NothingElse(Value, frozen=True):
    """All pure virtual functions of ``owner`` are among ``members``."""

    owner: Class
    members: tuple[str, ...]


class NoOperations(Value, frozen=True):
    """The class ``base`` that ``owner`` derives from has no member functions of its own."""

    owner: Class
    base: str


class Implemented(Value, frozen=True):
    """A class that defines the functions of ``key`` and derives from ``owner`` can be made, and calls come to it."""

    owner: Class
    key: str


class InheritsElement(Value, frozen=True):
    """``owner`` derives from PortElementObject, wherever that is declared."""

    owner: Class


# claims about components
class DeclaresConnection(Value, frozen=True):
    """``connection`` is a type where the class ``owner`` is declared, or in it."""

    owner: str
    connection: str


class ConnectionShape(Value, frozen=True):
    """``connection`` of ``owner`` has a string ``port_name`` and a reference ``ref``, and is made of both."""

    owner: str
    connection: str


class ConnectionTemplate(Value, frozen=True):
    """``connection`` of ``owner`` is an instance of a class template PortConnection."""

    owner: str
    connection: str


class ConnectionTo(Value, frozen=True):
    """The reference of ``connection`` of ``owner`` leads to the class ``interface`` or one that derives from it."""

    owner: str
    connection: str
    interface: str


class Startup(Value, frozen=True):
    """``on_startup`` of ``owner`` takes from ``least`` to ``most`` constant references, all of ``connections`` among them."""

    owner: str
    least: int
    most: int
    connections: tuple[str, ...]


class StartupTakes(Value, frozen=True):
    """Among what ``on_startup`` takes is a constant reference of type ``connection``, as often as this is the type of one of the
    connections that ``startup`` names.
    """

    owner: str
    connection: str
    startup: Startup


class ReturnsReference(Value, frozen=True):
    """``getter`` of ``owner`` returns a shared pointer; to ``interface``, or what derives from it, if that has a name."""

    owner: str
    getter: str
    interface: str


class Runs(Value, frozen=True):
    """A component that implements ``owner`` lives: it is started, called, calls what it is connected to, and is stopped."""

    owner: str
    key: str


Claim = (
    Namespace
    | Declares
    | Is
    | ArrayOf
    | Sizes
    | BoundedSequence
    | IsClass
    | Regular
    | Field
    | Copied
    | Discriminator
    | EnumForm
    | Underlying
    | EnumeratorOf
    | EnumeratorValue
    | NoOtherEnumerators
    | SafeEnum
    | SafeEnumInner
    | Works
    | IsConstant
    | ConstantIs
    | NotInHeader
    | Derives
    | NotDerived
    | IsAbstract
    | NoMember
    | Thrown
    | NotCorba
    | Pure
    | Arity
    | Passed
    | NoMutator
    | NothingElse
    | NoOperations
    | Implemented
    | InheritsElement
    | DeclaresConnection
    | ConnectionShape
    | ConnectionTemplate
    | ConnectionTo
    | Startup
    | StartupTakes
    | ReturnsReference
    | Runs
)


class Expected(Value, frozen=True):
    """``claim`` must hold for ``requirement`` to be kept, because of ``element``, which begins at ``line`` of the model."""

    requirement: str
    element: str
    line: int
    claim: Claim


class ExpectedCpp(Value, frozen=True):
    """What a model makes the tool chain declare, in the order of the model."""

    standard: Standard
    expected: tuple[Expected, ...]
    abstract: tuple[Abstract, ...]
