"""Builds declarations from what the grammar recognises, rule by rule of ``grammar.lark``."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import msgspec
from lark import Token, Transformer, v_args

from ucm_cts.reference_models.mapping.idl.declarations import (
    Annotated,
    Annotation,
    AnnotationDefinition,
    Argument,
    ArrayOf,
    Attribute,
    Basic,
    Binary,
    Case,
    Constant,
    Declaration,
    Enum,
    Enumerator,
    Exception_,
    Expression,
    Extended,
    Forward,
    Interface,
    Literal,
    Member,
    Module,
    ModuleInstance,
    Named,
    Native,
    Operation,
    Parameter,
    Place,
    SequenceOf,
    Struct,
    Syntax,
    TemplateParameter,
    Text,
    Type,
    Typedef,
    Unary,
    Union,
)

RESERVED = frozenset(
    [
        "abstract",
        "any",
        "attribute",
        "boolean",
        "case",
        "char",
        "const",
        "context",
        "default",
        "double",
        "enum",
        "exception",
        "false",
        "fixed",
        "float",
        "in",
        "inout",
        "interface",
        "local",
        "long",
        "module",
        "native",
        "object",
        "octet",
        "oneway",
        "out",
        "raises",
        "readonly",
        "sequence",
        "short",
        "string",
        "struct",
        "switch",
        "true",
        "typedef",
        "union",
        "unsigned",
        "void",
        "wchar",
        "wstring",
    ]
)
"""Keywords of the building blocks that clause 12.1 retains, and of what every compiler reserves beside them; in lower case,
because IDL tells names from keywords without regard to it."""


def _binary(operator: str) -> Callable[[Builder, Expression, Expression], Binary]:
    def build(self: Builder, left: Expression, right: Expression) -> Binary:
        return Binary(operator, left, right)

    return build


def _unary(operator: str) -> Callable[[Builder, Expression], Unary]:
    def build(self: Builder, operand: Expression) -> Unary:
        return Unary(operator, operand)

    return build


def _typed(type_: Type, annotations: Sequence[Annotation]) -> Type:
    return Annotated(type_, tuple(annotations)) if annotations else type_


def _of(kind: Any, things: Iterable[Any]) -> tuple[Any, ...]:
    return tuple(thing for thing in things if isinstance(thing, kind))


def _flat(things: Iterable[Any]) -> tuple[Declaration, ...]:
    """Rules that declare several things give tuples."""
    lists = (thing if isinstance(thing, tuple) else (thing,) for thing in things)
    return tuple(itertools.chain.from_iterable(lists))


@v_args(inline=True)
class Builder(Transformer[Any, Any]):
    """``reserved`` is the first name of the present file that is a keyword, if there is one."""

    def __init__(self) -> None:
        super().__init__()
        self._file = ""
        self.reserved: Token | None = None

    def begin(self, file: str) -> None:
        """Whatever comes stands in ``file``."""
        self._file = file
        self.reserved = None

    def _place(self, token: Token) -> Place:
        return Place(self._file, token.line or 0, token.column or 0)

    def _named(self, token: Token) -> dict[str, Any]:
        return {"name": token.removeprefix("_"), "place": self._place(token)}

    def NAME(self, token: Token) -> Token:
        if self.reserved is None and token != "String" and token.lower() in RESERVED:  # clause 14 prints String
            self.reserved = token
        return token

    # Definitions
    def start(self, *definitions: Any) -> tuple[Declaration, ...]:
        return _flat(definitions)

    def annotated(self, *parts: Any) -> Any:
        return self._with(_of(Annotation, parts[:-1]), parts[-1])

    def _with(self, annotations: tuple[Annotation, ...], declared: Any) -> Any:
        if isinstance(declared, tuple):
            return tuple(self._with(annotations, one) for one in declared)
        return msgspec.structs.replace(declared, annotations=annotations + declared.annotations)

    def module(self, name: Token, parameters: tuple[TemplateParameter, ...] | None, *body: Any) -> Module:
        return Module(**self._named(name), parameters=parameters or (), body=_flat(body))

    def template_parameters(self, *parameters: TemplateParameter) -> tuple[TemplateParameter, ...]:
        return parameters

    def template_parameter(self, kind: Token, name: Token) -> TemplateParameter:
        return TemplateParameter(**self._named(name), kind=str(kind))

    def constant_parameter(self, type_: Type, name: Token) -> TemplateParameter:
        return TemplateParameter(**self._named(name), kind="const")

    def module_instance(self, template: Any, *rest: Any) -> ModuleInstance:
        return ModuleInstance(
            **self._named(rest[-1]), template=str(template).removeprefix("_"), arguments=_of(Syntax, rest[:-1])
        )

    def extended(self, kind: Token, name: Token, *rest: Any) -> Extended:
        return Extended(**self._named(name), kind=str(kind))

    # Types
    def named(self, name: str) -> Named:
        return Named(name)

    def basic(self, *words: Token) -> Basic:
        return Basic(" ".join(words))

    def nothing(self) -> Basic:
        return Basic("void")

    def text(self, keyword: Token, *rest: Any) -> Text:
        return Text(keyword == "wstring", next(iter(_of(Syntax, rest)), None))

    def sequence(self, *parts: Any) -> SequenceOf:
        element, bound = parts[-2:]
        return SequenceOf(_typed(element, _of(Annotation, parts)), bound)

    def declarators(self, *declarators: tuple[Token, tuple[Expression, ...]]) -> list[Any]:
        return list(declarators)

    def declarator(self, name: Token, *dimensions: Expression) -> tuple[Token, tuple[Expression, ...]]:
        return name, dimensions

    def _each(self, kind: Any, parts: Sequence[Any]) -> tuple[Declaration, ...]:
        """One declaration for each declarator, all with the annotations in front of the type."""
        *annotations, type_, declarators = parts
        return tuple(
            kind(
                **self._named(name),
                type=ArrayOf(type_, dimensions) if dimensions else type_,
                annotations=_of(Annotation, annotations),
            )
            for name, dimensions in declarators
        )

    def typedef(self, *parts: Any) -> tuple[Declaration, ...]:
        return self._each(Typedef, parts)

    def typedef_constructed(self, declared: Declaration, declarators: Any) -> tuple[Declaration, ...]:
        return (declared, *self._each(Typedef, (Named(declared.name), declarators)))

    def member(self, *parts: Any) -> tuple[Declaration, ...]:
        return self._each(Member, parts)

    def struct(self, name: Token, base: str | None, *members: Any) -> Struct:
        return Struct(**self._named(name), base=base or "", members=_of(Member, _flat(members)))

    def forward(self, keyword: Token, name: Token) -> Forward:
        return Forward(**self._named(name), kind=str(keyword))

    def union(self, name: Token, *parts: Any) -> Union:
        selector = next(iter(_of(Syntax, parts)))
        return Union(**self._named(name), selector=_typed(selector, _of(Annotation, parts)), cases=_of(Case, parts))

    def case(self, *parts: Any) -> Case:
        *before, type_, (name, dimensions) = parts
        return Case(
            **self._named(name),
            annotations=_of(Annotation, before),
            labels=tuple(label for (label,) in _of(list, before)),
            type=ArrayOf(type_, dimensions) if dimensions else type_,
        )

    def label(self, value: Expression) -> list[Expression | None]:
        return [value]

    def default_label(self) -> list[Expression | None]:
        return [None]

    def enum(self, name: Token, *enumerators: Enumerator) -> Enum:
        return Enum(**self._named(name), enumerators=enumerators)

    def enumerator(self, *parts: Any) -> Enumerator:
        return Enumerator(**self._named(parts[-1]), annotations=_of(Annotation, parts))

    def native(self, name: Token) -> Native:
        return Native(**self._named(name))

    def constant(self, type_: Type, name: Token, value: Expression) -> Constant:
        return Constant(**self._named(name), type=type_, value=value)

    def exception(self, name: Token, *members: Any) -> Exception_:
        return Exception_(**self._named(name), members=_of(Member, _flat(members)))

    # Interfaces
    def interface(self, header: Interface, *exports: Any) -> Interface:
        return msgspec.structs.replace(header, body=_flat(exports))

    def interface_forward(self, header: Interface) -> Forward:
        return Forward(name=header.name, place=header.place, kind="interface")

    def interface_header(self, local: Token | None, name: Token, bases: tuple[str, ...] | None) -> Interface:
        return Interface(**self._named(name), bases=bases or ())

    def inherits(self, *names: str) -> tuple[str, ...]:
        return names

    def export(self, *parts: Any) -> Any:
        return self.annotated(*parts)

    def operation(self, oneway: Token | None, result: Type, name: Token, *rest: Any) -> Operation:
        return Operation(
            **self._named(name),
            returns=result,
            parameters=_of(Parameter, rest),
            raises=tuple(itertools.chain.from_iterable(_of(tuple, rest))),
            oneway=oneway is not None,
        )

    def parameter(self, *parts: Any) -> Parameter:
        *before, type_, name = parts
        direction = next(part for part in before if isinstance(part, Token))
        return Parameter(**self._named(name), annotations=_of(Annotation, before), direction=str(direction), type=type_)

    def raises(self, *names: str) -> tuple[str, ...]:
        return names

    def context(self, *texts: Token) -> None:
        return None

    def attribute(self, readonly: Token | None, type_: Type, *names: Any) -> tuple[Declaration, ...]:
        return tuple(
            Attribute(**self._named(name), type=type_, readonly=readonly is not None) for name in _of(Token, names)
        )

    def attribute_raises(self, *names: str) -> None:
        return None

    # Annotations
    def annotation_definition(self, keyword: Token, name: Token, *members: Any) -> AnnotationDefinition:
        return AnnotationDefinition(**self._named(name), members=_of(Member, members))

    def annotation_member(self, type_: Type, name: Token, default: Expression | None) -> Member:
        return Member(**self._named(name), type=type_)

    def annotation(self, name: Token, arguments: tuple[Argument, ...] | None) -> Annotation:
        return Annotation(name[1:].strip(), arguments or (), self._place(name))

    def arguments(self, *arguments: Argument) -> tuple[Argument, ...]:
        return arguments

    def argument_alone(self, value: Expression) -> tuple[Argument, ...]:
        return (Argument("", value),)

    def argument(self, name: Token, value: Expression) -> Argument:
        return Argument(str(name), value)

    # Expressions and names
    or_, xor, and_ = _binary("|"), _binary("^"), _binary("&")
    left, right = _binary("<<"), _binary(">>")
    add, sub, mul, div, mod = _binary("+"), _binary("-"), _binary("*"), _binary("/"), _binary("%")
    minus, plus, invert = _unary("-"), _unary("+"), _unary("~")

    def constant_name(self, name: str) -> Named:
        return Named(name)

    def real(self, token: Token) -> Literal:
        return Literal("fixed" if token[-1] in "dD" and not token.lower().startswith("0x") else "real", str(token))

    def integer(self, token: Token) -> Literal:
        return Literal("integer", str(token))

    def character(self, token: Token) -> Literal:
        return Literal("character", token[token.index("'") + 1 : -1])

    def text_literal(self, *tokens: Token) -> Literal:
        return Literal("text", "".join(token[token.index('"') + 1 : -1] for token in tokens))

    def truth(self, token: Token) -> Literal:
        return Literal("truth", str(token))

    def scoped_name(self, name: str) -> str:
        return str(name).removeprefix("_")

    def qualified(self, *names: Token) -> str:
        return "::".join(name.removeprefix("_") for name in names)

    def absolute(self, *names: Token) -> str:
        return "::" + self.qualified(*names)
