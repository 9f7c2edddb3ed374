"""The definitions of ``protocol.schema.json`` as values, for the generator of message types in other languages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal


@dataclass(frozen=True)
class Type:
    """The type of a field, or of what a list or map contains.

    ``name``: the definition of a ``struct``, ``union`` or ``enum``.
    ``of``: what a ``list`` or ``map`` contains, and the types a value ``any`` may have.
    ``words``: the strings that a value ``words`` may be.
    """

    kind: Literal[
        "text",
        "boolean",
        "int32",
        "int64",
        "integer",
        "words",
        "datum",
        "list",
        "map",
        "struct",
        "union",
        "enum",
        "any",
    ]
    name: str = ""
    of: tuple[Type, ...] = ()
    words: tuple[str, ...] = ()


@dataclass(frozen=True)
class Field:
    """A field of a definition; one with ``default`` may be left out.

    ``nullable``: null is a value of the field, and its default.
    ``keys``: the enumeration that the keys of a map belong to.
    """

    owner: str
    name: str
    type: Type
    required: bool
    nullable: bool
    default: Any
    keys: str


@dataclass(frozen=True)
class Struct:
    """An object of the protocol. ``tag`` is what its tag field says, of one that belongs to a union."""

    name: str
    doc: str
    tag: str
    fields: tuple[Field, ...]


@dataclass(frozen=True)
class Union:
    """One of several objects; the field ``tag_field`` says which."""

    name: str
    tag_field: str
    alternatives: tuple[Struct, ...]

    @property
    def common(self) -> tuple[Field, ...]:
        """The fields that all alternatives have."""
        first, *others = ({f.name: f for f in one.fields} for one in self.alternatives)
        return tuple(f for name, f in first.items() if all(name in other for other in others))

    def members(self, name: Callable[[Field], str]) -> list[tuple[Field, list[str]]]:
        """The fields of all alternatives by ``name``: one that stands for it, if possible with a default, and the tags of
        the alternatives that have it.
        """
        found: dict[str, tuple[Field, list[str]]] = {}
        for one in self.alternatives:
            for field in one.fields:
                known, tags = found.get(name(field), (field, []))
                found[name(field)] = (field if known.default is None else known, [*tags, one.tag])
        return list(found.values())

    @property
    def cases(self) -> list[tuple[list[Struct], list[Field]]]:
        """The alternatives by the fields that they have beside the common ones."""
        common = {f.name for f in self.common}
        cases: dict[tuple[Any, ...], tuple[list[Struct], list[Field]]] = {}
        for one in self.alternatives:
            own = [f for f in one.fields if f.name not in common]
            key = tuple((f.name, f.type, f.required, f.nullable, str(f.default)) for f in own)
            cases.setdefault(key, ([], own))[0].append(one)
        return list(cases.values())


class Protocol:
    """The definitions of the schema. A ``run`` message and what is in it a host reads, the other definitions it writes."""

    def __init__(self, schema: dict[str, Any]) -> None:
        self._definitions = schema["$defs"]
        self.unions = {name: self._union(name) for name, d in self._definitions.items() if "discriminator" in d}
        self.enums = {name: d["enum"] for name, d in self._definitions.items() if "enum" in d}
        tagged = {one.name: union.name for union in self.unions.values() for one in union.alternatives}
        self.union_of = {name: union for name, union in tagged.items() if union not in ("to_host", "from_host")}
        self.structs = {name: self._struct(name) for name, d in self._definitions.items() if d.get("type") == "object"}

    def read_by_hosts(self, *without: str) -> list[str]:
        """Names of the definitions in messages to hosts, each after those that it contains."""
        found: list[str] = []
        self._collect("to_host", found, [])
        return [name for name in found if name not in without]

    def _collect(self, name: str, found: list[str], open_: list[str]) -> None:
        if name in found or name in open_ or not name:
            return
        open_.append(name)
        structs = (
            self.unions[name].alternatives
            if name in self.unions
            else [self.structs[name]]
            if name in self.structs
            else ()
        )
        for struct in structs:
            for field in struct.fields:
                for type_ in with_parts(field.type):
                    self._collect(self.union_of.get(type_.name, type_.name), found, open_)
                self._collect(field.keys, found, open_)
            if name == "to_host":
                self._collect(struct.name, found, open_)
        open_.pop()
        found.append(name)

    def _union(self, name: str) -> Union:
        tags = self._definitions[name]["discriminator"]
        structs = tuple(self._struct(_target(ref)) for ref in tags["mapping"].values())
        return Union(name, tags["propertyName"], structs)

    def _struct(self, name: str) -> Struct:
        definition = self._definitions[name]
        properties: dict[str, Any] = definition["properties"]
        tags = {n: p["enum"][0] for n, p in properties.items() if len(p.get("enum", ())) == 1}
        fields = tuple(
            self._field(name, n, p, n in definition["required"]) for n, p in properties.items() if n not in tags
        )
        return Struct(name, definition.get("description", ""), next(iter(tags.values()), ""), fields)

    def _field(self, owner: str, name: str, schema: dict[str, Any], required: bool) -> Field:
        choices = [one for one in schema.get("anyOf", [schema]) if one.get("type") != "null"]
        type_ = self._type(choices[0]) if len(choices) == 1 else Type("any", of=tuple(map(self._type, choices)))
        keys = _target(schema.get("propertyNames", {}).get("$ref", ""))
        return Field(
            owner, name, type_, required, len(choices) < len(schema.get("anyOf", [0])), schema.get("default"), keys
        )

    def _type(self, schema: dict[str, Any]) -> Type:
        if "$ref" in schema:
            return self._reference(_target(schema["$ref"]))
        if "enum" in schema:
            return Type("words", words=tuple(schema["enum"]))
        match schema["type"]:
            case "array":
                return Type("list", of=(self._type(schema["items"]),))
            case "object":
                return Type("map", of=(self._type(schema["additionalProperties"]),))
            case "string":
                return Type("text")
            case kind:
                return Type(kind)

    def _reference(self, name: str) -> Type:
        definition = self._definitions[name]
        if name in ("Int32", "Int64", "Datum"):
            return Type(name.lower())  # type: ignore[arg-type]
        kind: Any = "union" if "anyOf" in definition else "enum" if "enum" in definition else "struct"
        return Type(kind, name)


def _target(reference: str) -> str:
    return reference.rpartition("/")[2]


def with_parts(type_: Type) -> Iterator[Type]:
    """The type and those of what it contains."""
    yield type_
    for part in type_.of:
        yield from with_parts(part)
