"""Checks that the text of a constant gives a value of its type (9.2.6.1): resolves names and computes expressions."""

from __future__ import annotations

import functools
import operator
from collections.abc import Callable, Mapping
from typing import TypeGuard

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.rules.contracts import constant_syntax as syntax
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import actual_type


class NoValueOfType(Exception):
    """It is a constant, but none that the type has."""


Result = bool | int | float | syntax.Text

_INTEGERS: Mapping[str, Callable[[int, int], int]] = {
    "|": operator.or_,
    "^": operator.xor,
    "&": operator.and_,
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
}
_FLOATS: Mapping[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
_WIDEST = 64
"""Bits that a shift may move (IDL 4, 7.4.1.4.3)."""

_DEEPEST = 100
"""Operations and constants that may stand inside one another."""

_MOST = 10_000
"""Operations and constants that one value may need."""

_LARGEST = 1 << 128
"""Integers on the way to a result stay below."""

Ranges = Mapping[str, tuple[int, int]]


def fit(text: str, type_: str, scope: Scope, ranges: Ranges = c.INTEGER_RANGES) -> None:
    """Raise ``NotAConstant`` or ``NoValueOfType`` unless ``text`` is a value of what ``type_`` means in ``scope``.

    Values of types that IDL has no constants of are not checked, nor are those of undeclared types.
    ``ranges`` are those of the kinds of integers.
    """
    found = actual_type(type_, scope)
    if found is not None and isinstance(found.element, c.Enumeration) and _names(found, text):
        return  # the name is not resolved
    if found is not None and isinstance(found.element, c.PrimitiveInteger):
        _fit_integer(syntax.parsed(text), found.element, scope, ranges)
    if found is not None and isinstance(found.element, c.Enumeration):
        _fit_enumeration(syntax.parsed(text), found, scope)
    for cls, fitting in _FITTING.items():
        if found is not None and isinstance(found.element, cls):
            fitting(syntax.parsed(text), found.element, scope)


def _names(enumeration: Declared, text: str) -> bool:
    element, scope = enumeration
    return text in scope.remembered(("names of enumerators", id(element)), functools.partial(_enumerators, element))


def _enumerators(enumeration: Named) -> frozenset[str]:
    assert isinstance(enumeration, c.Enumeration)
    return frozenset(enumerator.name for enumerator in enumeration.enumerators)


def _fit_integer(expression: syntax.Expression, type_: c.PrimitiveInteger, scope: Scope, ranges: Ranges) -> None:
    value = _Calculation().result(expression, scope)
    if not _is_integer(value):
        raise NoValueOfType("it is no integer")
    least, most = ranges.get(type_.kind, (value, value))
    if not least <= value <= most:
        raise NoValueOfType(f"{type_.kind} holds {least} to {most}")


def _fit_float(expression: syntax.Expression, _type: c.PrimitiveFloat, scope: Scope) -> None:
    value = _Calculation().result(expression, scope)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise NoValueOfType("it is no number")


def _fit_boolean(expression: syntax.Expression, _type: c.PrimitiveBoolean, scope: Scope) -> None:
    if not isinstance(_Calculation().result(expression, scope), bool):
        raise NoValueOfType("it is neither TRUE nor FALSE")


def _fit_char(expression: syntax.Expression, _type: c.PrimitiveChar, scope: Scope) -> None:
    value = _Calculation().result(expression, scope)
    if not isinstance(value, syntax.Text) or value.is_string:
        raise NoValueOfType("it is no character in single quotes")


def _fit_string(expression: syntax.Expression, type_: c.StringType, scope: Scope) -> None:
    value = _Calculation().result(expression, scope)
    if not isinstance(value, syntax.Text) or not value.is_string:
        raise NoValueOfType("it is no string in double quotes")
    if type_.max_size is not None and c.UNBOUNDED < type_.max_size < len(value.content):
        raise NoValueOfType(f"it has more than {type_.max_size} characters")


def _fit_enumeration(expression: syntax.Expression, type_: Declared, scope: Scope) -> None:
    if not isinstance(expression, syntax.Name):
        raise NoValueOfType("it is the name of no enumerator")
    if _names(type_, expression.reference):
        return
    constant = scope.find(expression.reference, c.Constant)
    if constant is None or not isinstance(constant.element, c.Constant):
        raise NoValueOfType(f"{type_.element.name} has no enumerator {expression.reference}")
    found = actual_type(constant.element.type, constant.scope)
    if found is None or found.element is not type_.element:
        raise NoValueOfType(f"{expression.reference} is a constant of another type")


_FITTING: Mapping[type, Callable[..., None]] = {
    c.PrimitiveFloat: _fit_float,
    c.PrimitiveBoolean: _fit_boolean,
    c.PrimitiveChar: _fit_char,
    c.StringType: _fit_string,
}


class _Calculation:
    """One value is calculated, within bounds: models may be hostile."""

    def __init__(self) -> None:
        self._depth = 0
        self._steps = 0

    def result(self, expression: syntax.Expression, scope: Scope) -> Result:
        """What ``expression`` comes to where ``scope`` is. Raises ``NoValueOfType``."""
        self._depth += 1
        self._steps += 1
        if self._depth > _DEEPEST or self._steps > _MOST:
            raise NoValueOfType("it goes in a circle, or is too long to calculate")
        found = self._result(expression, scope)
        self._depth -= 1
        if isinstance(found, int) and abs(found) >= _LARGEST:
            raise NoValueOfType("no integer is so large")
        return found

    def _result(self, expression: syntax.Expression, scope: Scope) -> Result:
        if isinstance(expression, syntax.Name):
            return self._of_constant(expression, scope)
        if not isinstance(expression, syntax.Operation):
            return expression
        right = self.result(expression.right, scope)
        if expression.left is None:
            return _of_sign(expression.sign, right)
        return _of_operands(expression.sign, self.result(expression.left, scope), right)

    def _of_constant(self, name: syntax.Name, scope: Scope) -> Result:
        found = scope.find(name.reference, c.Constant)
        if found is None or not isinstance(found.element, c.Constant):
            raise NoValueOfType(f"no constant is called {name.reference}")
        try:
            return self.result(syntax.parsed(found.element.value), found.scope)
        except syntax.NotAConstant:
            raise NoValueOfType(f"{name.reference} has no value itself") from None


def _of_sign(sign: str, operand: Result) -> Result:
    if sign == "~" and _is_integer(operand):
        return ~operand
    return _of_operands(sign, 0, operand)


def _of_operands(sign: str, left: Result, right: Result) -> Result:
    if _is_integer(left) and _is_integer(right):
        return _of_integers(sign, left, right)
    if isinstance(left, bool | syntax.Text) or isinstance(right, bool | syntax.Text) or sign not in _FLOATS:
        raise NoValueOfType(f"{sign} has no such operands")
    try:
        return _FLOATS[sign](left, right)
    except (ZeroDivisionError, OverflowError):
        raise NoValueOfType(f"{sign} has no result") from None


def _is_integer(value: object) -> TypeGuard[int]:
    return isinstance(value, int) and not isinstance(value, bool)


def _of_integers(sign: str, left: int, right: int) -> int:
    if sign in ("<<", ">>"):
        if not 0 <= right < _WIDEST:
            raise NoValueOfType(f"nothing is shifted by {right} bits")
        return left << right if sign == "<<" else left >> right
    if sign in ("/", "%"):
        if not right:
            raise NoValueOfType("nothing is divided by zero")
        quotient = abs(left) // abs(right) * (1 if (left < 0) == (right < 0) else -1)
        return quotient if sign == "/" else left - quotient * right
    if sign not in _INTEGERS:
        raise NoValueOfType(f"{sign} has no such operands")
    return _INTEGERS[sign](left, right)
