"""UCM data types (9.2.3 to 9.2.5) and interfaces (9.2.7) as data, and the wire format of their values.

A value is plain JSON without its type; the interface has the type. Integers and characters (code points) are
integers, booleans booleans, strings strings, enumerators their names; a structure is the list of its fields, a union
``[enumerator, value]``, arrays (dimension by dimension) and sequences are lists. A float is the hexadecimal digits of its
IEEE 754 bits, most significant first, so that two values are the same exactly when they are written the same.
"""

from __future__ import annotations

from typing import Any, Literal

from ucm_cts.adapters.contract.value import Value

Datum = bool | int | str | list[Any]
"""A value on the wire."""

IntegerKind = Literal["BYTE", "SHORT", "LONG", "LONGLONG", "UBYTE", "USHORT", "ULONG", "ULONGLONG"]
"""The integer kinds of 9.2.3.2."""

_BITS: dict[IntegerKind, int] = {
    "BYTE": 8, "SHORT": 16, "LONG": 32, "LONGLONG": 64, "UBYTE": 8, "USHORT": 16, "ULONG": 32, "ULONGLONG": 64
}  # fmt: skip


def integer_range(kind: IntegerKind) -> tuple[int, int]:
    """Lower and upper bound of an integer kind (9.2.3.2)."""
    bits = _BITS[kind]
    return (0, 2**bits - 1) if kind.startswith("U") else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)


class DataType(Value, frozen=True, tag_field="type"):
    """Base of all data types."""


class Integer(DataType, frozen=True, tag="integer"):
    """PrimitiveInteger.

    ``kind``: its size and sign.
    """

    kind: IntegerKind


class Float(DataType, frozen=True, tag="float"):
    """PrimitiveFloat.

    ``kind``: FLOAT or DOUBLE; LONGDOUBLE has no portable form and is not sent.
    """

    kind: Literal["FLOAT", "DOUBLE"]


class Char(DataType, frozen=True, tag="char"):
    """PrimitiveChar.

    ``kind``: CHAR8 or CHAR32.
    """

    kind: Literal["CHAR8", "CHAR32"]


class Boolean(DataType, frozen=True, tag="boolean"):
    """PrimitiveBoolean."""


class String(DataType, frozen=True, tag="string"):
    """StringType.

    ``base``: kind of its characters; those of CHAR8 have code points below 256.
    ``size``: the greatest number of characters; -1 is unbounded.
    """

    base: Literal["CHAR8", "CHAR32"]
    size: int = -1


class Enumeration(DataType, frozen=True, tag="enumeration"):
    """Enumeration.

    ``name``: its name.
    ``index``: type of the index values.
    ``values``: index values by enumerator, in order.
    """

    name: str
    index: IntegerKind
    values: dict[str, int]


class Structure(DataType, frozen=True, tag="structure"):
    """Structure, or a declared exception.

    ``name``: its name.
    ``fields``: types by field name, in order.
    """

    name: str
    fields: dict[str, AnyType]


class UnionCase(Value, frozen=True):
    """An alternative of a union.

    ``name``: its name.
    ``of``: type of its value.
    ``selectors``: the enumerators that select it.
    ``default``: it is selected by every enumerator that no other case names.
    """

    name: str
    of: AnyType
    selectors: tuple[str, ...] = ()
    default: bool = False


class Union(DataType, frozen=True, tag="union"):
    """Union: a value of the case that the enumerator selects.

    ``name``: its name.
    ``selector``: the type of the enumerators.
    ``cases``: the alternatives, in order.
    """

    name: str
    selector: Enumeration
    cases: tuple[UnionCase, ...]


class Array(DataType, frozen=True, tag="array"):
    """Array.

    ``of``: type of the elements.
    ``sizes``: number of elements in each dimension.
    """

    of: AnyType
    sizes: tuple[int, ...]


class Sequence(DataType, frozen=True, tag="sequence"):
    """Sequence.

    ``of``: type of the elements.
    ``size``: the greatest number of elements; -1 is unbounded.
    """

    of: AnyType
    size: int = -1


class Alias(DataType, frozen=True, tag="alias"):
    """Another name of a type.

    ``name``: the name.
    ``of``: the type.
    """

    name: str
    of: AnyType


AnyType = Integer | Float | Char | Boolean | String | Enumeration | Structure | Union | Array | Sequence | Alias


Direction = Literal["IN", "OUT", "INOUT", "RETURN"]
"""Which way the value of a parameter goes; RETURN is the result."""


class Parameter(Value, frozen=True):
    """A parameter of a method.

    ``name``: its name.
    ``direction``: which way its value goes.
    ``of``: its type.
    """

    name: str
    direction: Direction
    of: AnyType


class Method(Value, frozen=True):
    """A method of an interface.

    ``parameters``: in order.
    ``raises``: the exceptions that it may raise.
    """

    parameters: tuple[Parameter, ...] = ()
    raises: tuple[Structure, ...] = ()

    @property
    def arguments(self) -> tuple[Parameter, ...]:
        """What the caller sends: IN and INOUT."""
        return tuple(p for p in self.parameters if p.direction in ("IN", "INOUT"))

    @property
    def results(self) -> tuple[Parameter, ...]:
        """What comes back: OUT, INOUT and RETURN, in the order of declaration."""
        return tuple(p for p in self.parameters if p.direction != "IN")


class Interface(Value, frozen=True):
    """An interface (9.2.7).

    ``methods``: its own and inherited methods, by name.
    ``inherited``: names of the interfaces that it inherits (9.2.7.2).
    """

    methods: dict[str, Method]
    inherited: tuple[str, ...] = ()


COMM_ECODE = Enumeration("comm_ecode", "BYTE", {"ok": 0, "internal_error": 1, "comm_error": 2})
"""The return codes of 10.1.2."""


def message_interface(of: AnyType) -> Interface:
    """message_intf of 10.1.6.2, bound to messages of type ``of``."""
    return Interface({"push": Method((Parameter("message", "IN", of), Parameter("ecode", "RETURN", COMM_ECODE)))})
