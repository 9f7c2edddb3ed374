"""Builds declarations from what the grammar recognises, rule by rule of ``grammar.lark``."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import msgspec
from lark import Token, Transformer, v_args

from ucm_cts.reference_models.mapping.idl import declarations as idl

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


def _binary(operator: str) -> Callable[[Builder, idl.Expression, idl.Expression], idl.Binary]:
    def build(self: Builder, left: idl.Expression, right: idl.Expression) -> idl.Binary:
        return idl.Binary(operator, left, right)

    return build


def _unary(operator: str) -> Callable[[Builder, idl.Expression], idl.Unary]:
    def build(self: Builder, operand: idl.Expression) -> idl.Unary:
        return idl.Unary(operator, operand)

    return build


def _typed(type_: idl.Type, annotations: Sequence[idl.Annotation]) -> idl.Type:
    return idl.Annotated(type_, tuple(annotations)) if annotations else type_


def _of(kind: Any, things: Iterable[Any]) -> tuple[Any, ...]:
    return tuple(thing for thing in things if isinstance(thing, kind))


def _flat(things: Iterable[Any]) -> tuple[idl.Declaration, ...]:
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
        """The declarations that follow stand in ``file``."""
        self._file = file
        self.reserved = None

    def _place(self, token: Token) -> idl.Place:
        return idl.Place(self._file, token.line or 0, token.column or 0)

    def _named(self, token: Token) -> dict[str, Any]:
        return {"name": token.removeprefix("_"), "place": self._place(token)}

    def NAME(self, token: Token) -> Token:
        if self.reserved is None and token != "String" and token.lower() in RESERVED:  # clause 14 prints String
            self.reserved = token
        return token

    # Definitions
    def start(self, *definitions: Any) -> tuple[idl.Declaration, ...]:
        return _flat(definitions)

    def annotated(self, *parts: Any) -> Any:
        return self._with(_of(idl.Annotation, parts[:-1]), parts[-1])

    def _with(self, annotations: tuple[idl.Annotation, ...], declared: Any) -> Any:
        if isinstance(declared, tuple):
            return tuple(self._with(annotations, one) for one in declared)
        return msgspec.structs.replace(declared, annotations=annotations + declared.annotations)

    def module(self, name: Token, parameters: tuple[idl.TemplateParameter, ...] | None, *body: Any) -> idl.Module:
        return idl.Module(**self._named(name), parameters=parameters or (), body=_flat(body))

    def template_parameters(self, *parameters: idl.TemplateParameter) -> tuple[idl.TemplateParameter, ...]:
        return parameters

    def template_parameter(self, kind: Token, name: Token) -> idl.TemplateParameter:
        return idl.TemplateParameter(**self._named(name), kind=str(kind))

    def constant_parameter(self, type_: idl.Type, name: Token) -> idl.TemplateParameter:
        return idl.TemplateParameter(**self._named(name), kind="const")

    def module_instance(self, template: Any, *rest: Any) -> idl.ModuleInstance:
        return idl.ModuleInstance(
            **self._named(rest[-1]), template=str(template).removeprefix("_"), arguments=_of(idl.Syntax, rest[:-1])
        )

    def extended(self, kind: Token, name: Token, *rest: Any) -> idl.Extended:
        inside = _flat(part for part in rest if isinstance(part, (idl.Declaration, tuple)))
        return idl.Extended(
            **self._named(name),
            kind=str(kind),
            bases=rest[0]
            if rest and isinstance(rest[0], tuple) and all(isinstance(one, str) for one in rest[0])
            else (),
            members=_of(idl.ExtendedMember, inside),
            attributes=_of(idl.Attribute, inside),
        )

    def extended_member(self, *parts: Any) -> Any:
        if isinstance(parts[-1], tuple):
            return parts[-1]
        keyword, type_, name = parts[-3:]
        return idl.ExtendedMember(**self._named(name), kind=str(keyword), type=type_)

    # Types
    def named(self, name: str) -> idl.Named:
        return idl.Named(name)

    def basic(self, *words: Token) -> idl.Basic:
        return idl.Basic(" ".join(words))

    def nothing(self) -> idl.Basic:
        return idl.Basic("void")

    def text(self, keyword: Token, *rest: Any) -> idl.Text:
        return idl.Text(keyword == "wstring", next(iter(_of(idl.Syntax, rest)), None))

    def sequence(self, *parts: Any) -> idl.SequenceOf:
        element, bound = parts[-2:]
        return idl.SequenceOf(_typed(element, _of(idl.Annotation, parts)), bound)

    def declarators(self, *declarators: tuple[Token, tuple[idl.Expression, ...]]) -> list[Any]:
        return list(declarators)

    def declarator(self, name: Token, *dimensions: idl.Expression) -> tuple[Token, tuple[idl.Expression, ...]]:
        return name, dimensions

    def _each(self, kind: Any, parts: Sequence[Any]) -> tuple[idl.Declaration, ...]:
        """One declaration for each declarator, all with the annotations in front of the type."""
        *annotations, type_, declarators = parts
        return tuple(
            kind(
                **self._named(name),
                type=idl.ArrayOf(type_, dimensions) if dimensions else type_,
                annotations=_of(idl.Annotation, annotations),
            )
            for name, dimensions in declarators
        )

    def typedef(self, *parts: Any) -> tuple[idl.Declaration, ...]:
        return self._each(idl.Typedef, parts)

    def typedef_constructed(self, declared: idl.Declaration, declarators: Any) -> tuple[idl.Declaration, ...]:
        return (declared, *self._each(idl.Typedef, (idl.Named(declared.name), declarators)))

    def member(self, *parts: Any) -> tuple[idl.Declaration, ...]:
        return self._each(idl.Member, parts)

    def struct(self, name: Token, base: str | None, *members: Any) -> idl.Struct:
        return idl.Struct(**self._named(name), base=base or "", members=_of(idl.Member, _flat(members)))

    def forward(self, keyword: Token, name: Token) -> idl.Forward:
        return idl.Forward(**self._named(name), kind=str(keyword))

    def union(self, name: Token, *parts: Any) -> idl.Union:
        selector = next(iter(_of(idl.Syntax, parts)))
        return idl.Union(
            **self._named(name), selector=_typed(selector, _of(idl.Annotation, parts)), cases=_of(idl.Case, parts)
        )

    def case(self, *parts: Any) -> idl.Case:
        *before, type_, (name, dimensions) = parts
        return idl.Case(
            **self._named(name),
            annotations=_of(idl.Annotation, before),
            labels=tuple(label for (label,) in _of(list, before)),
            type=idl.ArrayOf(type_, dimensions) if dimensions else type_,
        )

    def label(self, value: idl.Expression) -> list[idl.Expression | None]:
        return [value]

    def default_label(self) -> list[idl.Expression | None]:
        return [None]

    def enum(self, name: Token, *enumerators: idl.Enumerator) -> idl.Enum:
        return idl.Enum(**self._named(name), enumerators=enumerators)

    def enumerator(self, *parts: Any) -> idl.Enumerator:
        return idl.Enumerator(**self._named(parts[-1]), annotations=_of(idl.Annotation, parts))

    def native(self, name: Token) -> idl.Native:
        return idl.Native(**self._named(name))

    def constant(self, type_: idl.Type, name: Token, value: idl.Expression) -> idl.Constant:
        return idl.Constant(**self._named(name), type=type_, value=value)

    def exception(self, name: Token, *members: Any) -> idl.Exception_:
        return idl.Exception_(**self._named(name), members=_of(idl.Member, _flat(members)))

    # Interfaces
    def interface(self, header: idl.Interface, *exports: Any) -> idl.Interface:
        return msgspec.structs.replace(header, body=_flat(exports))

    def interface_forward(self, header: idl.Interface) -> idl.Forward:
        return idl.Forward(name=header.name, place=header.place, kind="interface")

    def interface_header(self, local: Token | None, name: Token, bases: tuple[str, ...] | None) -> idl.Interface:
        return idl.Interface(**self._named(name), bases=bases or ())

    def inherits(self, *names: str) -> tuple[str, ...]:
        return names

    def export(self, *parts: Any) -> Any:
        return self.annotated(*parts)

    def operation(self, oneway: Token | None, result: idl.Type, name: Token, *rest: Any) -> idl.Operation:
        return idl.Operation(
            **self._named(name),
            returns=result,
            parameters=_of(idl.Parameter, rest),
            raises=tuple(itertools.chain.from_iterable(_of(tuple, rest))),
            oneway=oneway is not None,
        )

    def parameter(self, *parts: Any) -> idl.Parameter:
        *before, type_, name = parts
        direction = next(part for part in before if isinstance(part, Token))
        return idl.Parameter(
            **self._named(name), annotations=_of(idl.Annotation, before), direction=str(direction), type=type_
        )

    def raises(self, *names: str) -> tuple[str, ...]:
        return names

    def context(self, *texts: Token) -> None:
        return None

    def attribute(self, readonly: Token | None, type_: idl.Type, *names: Any) -> tuple[idl.Declaration, ...]:
        return tuple(
            idl.Attribute(**self._named(name), type=type_, readonly=readonly is not None) for name in _of(Token, names)
        )

    def attribute_raises(self, *names: str) -> None:
        return None

    # Annotations
    def annotation_definition(self, keyword: Token, name: Token, *members: Any) -> idl.AnnotationDefinition:
        return idl.AnnotationDefinition(**self._named(name), members=_of(idl.Member, members))

    def annotation_member(self, type_: idl.Type, name: Token, default: idl.Expression | None) -> idl.Member:
        return idl.Member(**self._named(name), type=type_)

    def annotation(self, name: Token, arguments: tuple[idl.Argument, ...] | None) -> idl.Annotation:
        return idl.Annotation(name[1:].strip(), arguments or (), self._place(name))

    def arguments(self, *arguments: idl.Argument) -> tuple[idl.Argument, ...]:
        return arguments

    def argument_alone(self, value: idl.Expression) -> tuple[idl.Argument, ...]:
        return (idl.Argument("", value),)

    def argument(self, name: Token, value: idl.Expression) -> idl.Argument:
        return idl.Argument(str(name), value)

    # Expressions and names
    or_, xor, and_ = _binary("|"), _binary("^"), _binary("&")
    left, right = _binary("<<"), _binary(">>")
    add, sub, mul, div, mod = _binary("+"), _binary("-"), _binary("*"), _binary("/"), _binary("%")
    minus, plus, invert = _unary("-"), _unary("+"), _unary("~")

    def constant_name(self, name: str) -> idl.Named:
        return idl.Named(name)

    def real(self, token: Token) -> idl.Literal:
        return idl.Literal("fixed" if token[-1] in "dD" and not token.lower().startswith("0x") else "real", str(token))

    def integer(self, token: Token) -> idl.Literal:
        return idl.Literal("integer", str(token))

    def character(self, token: Token) -> idl.Literal:
        return idl.Literal("character", token[token.index("'") + 1 : -1])

    def text_literal(self, *tokens: Token) -> idl.Literal:
        return idl.Literal("text", "".join(token[token.index('"') + 1 : -1] for token in tokens))

    def truth(self, token: Token) -> idl.Literal:
        return idl.Literal("truth", str(token))

    def scoped_name(self, name: str) -> str:
        return str(name).removeprefix("_")

    def qualified(self, *names: Token) -> str:
        return "::".join(name.removeprefix("_") for name in names)

    def absolute(self, *names: Token) -> str:
        return "::" + self.qualified(*names)
