"""IDL for people: types and values as they are written."""

from __future__ import annotations

from ucm_cts.harness.toolchains.idl.language.values import Chosen, Worth
from ucm_cts.reference_models.mapping.idl import declarations as idl


def show(type_: idl.Type) -> str:
    """A type as IDL writes it."""
    match type_:
        case idl.Basic():
            return type_.name
        case idl.Named():
            return type_.name
        case idl.Text():
            bound = f"<{_expression(type_.bound)}>" if type_.bound is not None else ""
            return ("wstring" if type_.wide else "string") + bound
        case idl.SequenceOf():
            bound = f", {_expression(type_.bound)}" if type_.bound is not None else ""
            return f"sequence<{show(type_.element)}{bound}>"
        case idl.ArrayOf():
            return show(type_.element) + "".join(f"[{_expression(d)}]" for d in type_.dimensions)
        case idl.Annotated():
            return " ".join((*(f"@{one.name}" for one in type_.annotations), show(type_.type)))


def show_declaration(declaration: idl.Declaration) -> str:
    """A declaration in one line as IDL writes it, an interface without its contents; parameters have no names if they are free."""
    match declaration:
        case idl.Typedef():
            return f"typedef {show(declaration.type)} {declaration.name}"
        case idl.Struct() | idl.Exception_():
            members = "".join(f"{show(one.type)} {one.name}; " for one in declaration.members)
            base = f" : {declaration.base}" if isinstance(declaration, idl.Struct) and declaration.base else ""
            return f"{idl.kind_of(declaration)} {declaration.name}{base} {{ {members}}}"
        case idl.Enum():
            return f"enum {declaration.name} {{ {', '.join(one.name for one in declaration.enumerators)} }}"
        case idl.Operation():
            taken = ", ".join(f"{one.direction} {show(one.type)} {one.name}".rstrip() for one in declaration.parameters)
            raised = f" raises ({', '.join(declaration.raises)})" if declaration.raises else ""
            return f"{show(declaration.returns)} {declaration.name}({taken}){raised}"
        case idl.Attribute():
            return f"{'readonly ' * declaration.readonly}attribute {show(declaration.type)} {declaration.name}"
    return f"{idl.kind_of(declaration)} {declaration.name}"


def _expression(expression: idl.Expression) -> str:
    match expression:
        case idl.Literal():
            return expression.text
        case idl.Named():
            return expression.name
    return "..."


def show_worth(value: Worth | None) -> str:
    """A value for a message."""
    if value is None:
        return "no value"
    return value.name if isinstance(value, Chosen) else repr(value)


def show_kind(kind: str) -> str:
    """What a kind of declarations is called in a message."""
    return kind or "a type"


def type_of(declaration: idl.Declaration) -> idl.Type | None:
    """The type that a declaration gives to its name, the result of an operation; None for those that make a type."""
    match declaration:
        case idl.Typedef() | idl.Member() | idl.Case() | idl.Parameter() | idl.Attribute() | idl.Constant():
            return declaration.type
        case idl.Operation():
            return declaration.returns
    return None
