"""Declarations of IDL as values, for the contents of IDL files and for expectations of them.

Names in types are scoped names as they are written, ``::`` in front if they begin at the root. Names are not resolved here.
"""

from __future__ import annotations

import msgspec


class Place(msgspec.Struct, frozen=True):
    """Where a declaration's name stands. Lines and columns are counted from 1; 0 if unknown."""

    file: str = ""
    line: int = 0
    column: int = 0


class Syntax(msgspec.Struct, frozen=True):
    """Base of types and expressions."""


class Literal(Syntax, frozen=True):
    """``kind`` is integer, real, fixed, character, text or truth; ``text`` as written, adjacent strings joined."""

    kind: str
    text: str


class Named(Syntax, frozen=True):
    """A scoped name, of a constant or an enumerator in expressions, of a type in types."""

    name: str


class Unary(Syntax, frozen=True):
    """``operator`` is ``-``, ``+`` or ``~``."""

    operator: str
    operand: Expression


class Binary(Syntax, frozen=True):
    """``operator`` is one of ``| ^ & >> << + - * / %``."""

    operator: str
    left: Expression
    right: Expression


Expression = Literal | Named | Unary | Binary


class Basic(Syntax, frozen=True):
    """A type that IDL has by itself, by its keywords with one blank between them; ``void`` where nothing is returned."""

    name: str


class Text(Syntax, frozen=True):
    """``string`` or, if ``wide``, ``wstring``; without a ``bound`` of any length."""

    wide: bool = False
    bound: Expression | None = None


class SequenceOf(Syntax, frozen=True):
    """``sequence<element, bound>``."""

    element: Type
    bound: Expression | None = None


class ArrayOf(Syntax, frozen=True):
    """What a declarator with ``[dimension]`` behind it declares."""

    element: Type
    dimensions: tuple[Expression, ...]


class Annotated(Syntax, frozen=True):
    """A type with annotations of its own, in front of it."""

    type: Type
    annotations: tuple[Annotation, ...]


Type = Basic | Text | SequenceOf | ArrayOf | Named | Annotated


class Argument(msgspec.Struct, frozen=True):
    """A value for a member of an annotation; ``name`` is empty if only the value is written."""

    name: str
    value: Expression


class Annotation(msgspec.Struct, frozen=True):
    """The use of an annotation."""

    name: str
    arguments: tuple[Argument, ...] = ()
    place: Place = Place()


class Declaration(msgspec.Struct, frozen=True, kw_only=True):
    """Anything with a name. A leading underscore, which only escapes keywords, is not part of it."""

    name: str
    annotations: tuple[Annotation, ...] = ()
    place: Place = Place()


class TemplateParameter(Declaration, frozen=True, kw_only=True):
    """``kind`` is typename, interface, or another keyword."""

    kind: str


class Module(Declaration, frozen=True, kw_only=True):
    """A module, a template if it has ``parameters``."""

    parameters: tuple[TemplateParameter, ...] = ()
    body: tuple[Declaration, ...] = ()


class ModuleInstance(Declaration, frozen=True, kw_only=True):
    """``module template<arguments> name`` or ``alias template<arguments> name``."""

    template: str
    arguments: tuple[Type, ...] = ()


class Typedef(Declaration, frozen=True, kw_only=True):
    """Another name for a type."""

    type: Type


class Member(Declaration, frozen=True, kw_only=True):
    """Of a structure, an exception or an annotation."""

    type: Type


class Struct(Declaration, frozen=True, kw_only=True):
    """``base`` is empty if it extends none."""

    members: tuple[Member, ...] = ()
    base: str = ""


class Case(Declaration, frozen=True, kw_only=True):
    """A member of a union; the label ``default`` is None."""

    type: Type
    labels: tuple[Expression | None, ...]


class Union(Declaration, frozen=True, kw_only=True):
    """``selector`` is the type of the values that select a case."""

    selector: Type
    cases: tuple[Case, ...] = ()


class Enumerator(Declaration, frozen=True, kw_only=True):
    """A value of an enumeration; its name belongs to the scope around the enumeration."""


class Enum(Declaration, frozen=True, kw_only=True):
    """An enumeration."""

    enumerators: tuple[Enumerator, ...] = ()


class Constant(Declaration, frozen=True, kw_only=True):
    """A constant."""

    type: Type
    value: Expression


class Exception_(Declaration, frozen=True, kw_only=True):
    """An exception."""

    members: tuple[Member, ...] = ()


class Parameter(Declaration, frozen=True, kw_only=True):
    """``direction`` is in, out or inout."""

    direction: str
    type: Type


class Operation(Declaration, frozen=True, kw_only=True):
    """An operation; ``raises`` are scoped names."""

    returns: Type
    parameters: tuple[Parameter, ...] = ()
    raises: tuple[str, ...] = ()
    oneway: bool = False


class Attribute(Declaration, frozen=True, kw_only=True):
    """An attribute of an interface."""

    type: Type
    readonly: bool = False


class Interface(Declaration, frozen=True, kw_only=True):
    """``bases`` are scoped names; ``body`` holds all declarations inside."""

    bases: tuple[str, ...] = ()
    body: tuple[Declaration, ...] = ()


class Native(Declaration, frozen=True, kw_only=True):
    """A native type."""


class Forward(Declaration, frozen=True, kw_only=True):
    """Says that there is a declaration of ``kind``: interface, struct or union."""

    kind: str


class AnnotationDefinition(Declaration, frozen=True, kw_only=True):
    """What an annotation may say."""

    members: tuple[Member, ...] = ()


class ExtendedMember(Declaration, frozen=True, kw_only=True):
    """``kind`` is provides, uses, port, mirrorport or another keyword."""

    kind: str
    type: Type


class Extended(Declaration, frozen=True, kw_only=True):
    """A declaration of another building block, named by its first keyword: component, connector, porttype or valuetype.

    ``bases``: what it extends.
    ``members``: what it provides, uses and the like.
    ``attributes``: its attributes.
    """

    kind: str
    bases: tuple[str, ...] = ()
    members: tuple[ExtendedMember, ...] = ()
    attributes: tuple[Attribute, ...] = ()


KINDS: dict[type[Declaration], str] = {
    Module: "module",
    ModuleInstance: "module",
    Typedef: "typedef",
    Struct: "struct",
    Union: "union",
    Enum: "enum",
    Enumerator: "enumerator",
    Constant: "const",
    Exception_: "exception",
    Interface: "interface",
    Native: "native",
    Operation: "operation",
    Attribute: "attribute",
    Parameter: "parameter",
    Member: "member",
    Case: "union case",
    ExtendedMember: "member",
    TemplateParameter: "template parameter",
    AnnotationDefinition: "annotation",
}
"""How people call each class of declarations."""


def kind_of(declaration: Declaration) -> str:
    """The keyword or words for what ``declaration`` declares."""
    if isinstance(declaration, (Forward, Extended)):
        return declaration.kind
    return KINDS[type(declaration)]
