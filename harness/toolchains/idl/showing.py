"""IDL for people: types and values as they are written."""

from __future__ import annotations

from ucm_cts.harness.toolchains.idl.values import Chosen, Worth
from ucm_cts.reference_models.idl.declarations import (
    Annotated,
    ArrayOf,
    Attribute,
    Basic,
    Case,
    Constant,
    Declaration,
    Expression,
    Literal,
    Member,
    Named,
    Operation,
    Parameter,
    SequenceOf,
    Text,
    Type,
    Typedef,
)


def show(type_: Type) -> str:
    """A type as IDL writes it."""
    match type_:
        case Basic():
            return type_.name
        case Named():
            return type_.name
        case Text():
            bound = f"<{_expression(type_.bound)}>" if type_.bound is not None else ""
            return ("wstring" if type_.wide else "string") + bound
        case SequenceOf():
            bound = f", {_expression(type_.bound)}" if type_.bound is not None else ""
            return f"sequence<{show(type_.element)}{bound}>"
        case ArrayOf():
            return show(type_.element) + "".join(f"[{_expression(d)}]" for d in type_.dimensions)
        case Annotated():
            return " ".join((*(f"@{one.name}" for one in type_.annotations), show(type_.type)))


def _expression(expression: Expression) -> str:
    match expression:
        case Literal():
            return expression.text
        case Named():
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


def type_of(declaration: Declaration) -> Type | None:
    """The type that a declaration gives to its name, the result of an operation; None for those that make a type."""
    match declaration:
        case Typedef() | Member() | Case() | Parameter() | Attribute() | Constant():
            return declaration.type
        case Operation():
            return declaration.returns
    return None
