"""A value of each message of the protocol, made from the schema."""

from __future__ import annotations

from typing import Any

from ucm_cts.adapters.contract.schema_types import Field, Protocol, Struct, Type, Union


class Samples:
    """Messages in which each field has a value."""

    def __init__(self, protocol: Protocol) -> None:
        self._protocol = protocol
        self._open: list[str] = []

    def message(self, name: str, alternative: str) -> dict[str, Any]:
        """The message ``alternative`` of the union ``name``."""
        union = self._protocol.unions[name]
        return self._object(next(s for s in union.alternatives if s.name == alternative), union)

    def _object(self, struct: Struct, union: Union | None = None) -> dict[str, Any]:
        tag = {union.tag_field: struct.tag} if union else {}
        return {**tag, **{f.name: self._field(f) for f in struct.fields}}

    def _field(self, field: Field) -> Any:
        if field.name in ("interface", "ports"):  # the interface has to be there
            return "m" if field.name == "interface" else {"m": "m"}
        if field.name in ("provides", "requires"):  # no port element twice
            return [field.name]
        if field.keys:
            return {word: self._value(field.type.of[0]) for word in self._protocol.enums[field.keys]}
        if field.type.kind == "map":
            return dict(zip("mnopqrstuvw", self._several(field.type.of[0]), strict=False))
        return self._value(field.type)

    def _value(self, type_: Type) -> Any:
        match type_.kind:
            case "text":
                return "some text"
            case "boolean":
                return True
            case "int32" | "int64" | "integer":
                return 7
            case "words":
                return type_.words[-1]
            case "enum":
                return self._protocol.enums[type_.name][-1]
            case "datum":
                return [1, "x", [True, -(2**40)]]
            case "list":
                return self._several(type_.of[0])
            case "any":
                return self._value(type_.of[-1])
            case "union" if type_.name == "MaybeReference":
                return "opaque"
            case "union":
                return self._several(type_)[0]
        union = self._protocol.union_of.get(type_.name)
        return self._object(self._protocol.structs[type_.name], self._protocol.unions[union] if union else None)

    def _several(self, type_: Type) -> list[Any]:
        """One value, or of a union one of each alternative; inside itself a union has one without fields."""
        union = self._protocol.unions.get(type_.name)
        if union is None:
            return [self._value(type_)]
        if union.name in self._open:
            return [{union.tag_field: next(one.tag for one in union.alternatives if not one.fields)}]
        self._open.append(union.name)
        values = [self._object(one, union) for one in union.alternatives]
        self._open.pop()
        return values
