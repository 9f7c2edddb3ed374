"""Message types in C++ and Java, generated from ``protocol.schema.json``.

``python -m ucm_cts.adapters.contract.generating`` writes the files anew; ``docs/decisions/0010-generated-wire-types.md``
says why they are made here.
"""

from __future__ import annotations

import json
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import jinja2

SCHEMA = Path(__file__).with_name("protocol.schema.json")
SDK = Path(__file__).parents[1] / "sdk"
CPP = SDK / "cpp" / "include" / "ucm_cts" / "generated"
JAVA = SDK / "java" / "src" / "generated" / "java" / "org" / "ucmcts"

FILES = {
    CPP / "messages.hpp": "messages.hpp.jinja",
    CPP / "messages_reading.hpp": "messages_reading.hpp.jinja",
    CPP / "events.hpp": "events.hpp.jinja",
    JAVA / "Messages.java": "Messages.java.jinja",
    JAVA / "Events.java": "Events.java.jinja",
}
"""The generated files, each with its template."""


@dataclass(frozen=True)
class Type:
    """The type of a field, or of what a list or map contains.

    ``name``: the definition of a ``struct``, ``union`` or ``enum``.
    ``of``: what a ``list`` or ``map`` contains, and the types a value ``any`` may have.
    ``words``: the strings that a value ``words`` may be.
    """

    kind: Literal[
        "text", "boolean", "int32", "int64", "integer", "words", "datum", "list", "map", "struct", "union", "enum", "any"
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
        structs = self.unions[name].alternatives if name in self.unions else [self.structs[name]] if name in self.structs else ()
        for struct in structs:
            for field in struct.fields:
                for type_ in _with_parts(field.type):
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
        return Field(owner, name, type_, required, len(choices) < len(schema.get("anyOf", [0])), schema.get("default"), keys)

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


def _with_parts(type_: Type) -> Iterator[Type]:
    yield type_
    for part in type_.of:
        yield from _with_parts(part)


# C++

_CPP_NAMES = {
    "AnyType": "DataType",
    "Reference": "Identity",
    "Integer.kind": "base",
    "Float.kind": "base",
    "Char.kind": "base",
    "Enumeration.index": "base",
    "Enumeration.values": "enumerators",
    "Union.selector": "of",
    "UnionCase.default": "is_default",
    "Declaration.provides": "provided",
    "Declaration.requires": "required",
    "Step.break": "break_link",
    "Step.mend": "mend_link",
    "Action.return": "return_value",
    "AnyType.float": "floating",
    "AnyType.char": "character",
    "AnyType.union": "union_type",
    "Direction.RETURN": "result",
}
"""Definitions, fields (of a definition) and words (of an enumeration) that have another name in C++: keywords, and fields of
the alternatives of a union that mean the same.
"""

_SHARED = {"AnyType": "SharedType", "Interface": "SharedInterface"}
_IN_ORDER = ("Scenario.components", "Structure.fields", "Enumeration.values")
_EMPTY_IS_NULL = ("Policy",)


def _cpp_name(name: str, owner: str = "") -> str:
    plain = name.lower() if name.isupper() else name
    return _CPP_NAMES.get(f"{owner}.{name}" if owner else name, plain)


class Cpp:
    """How the templates spell things in C++."""

    def __init__(self, protocol: Protocol) -> None:
        self._protocol = protocol
        self.name = _cpp_name

    def enumerators(self, words: Iterable[str], enumeration: str) -> str:
        """The enumerators that stand for ``words``."""
        return ", ".join(_cpp_name(word, enumeration) for word in words)

    def quoted(self, words: Iterable[str]) -> str:
        """``words`` as string literals."""
        return ", ".join(f'"{word}"' for word in words)

    def member(self, field: Field) -> str:
        """The member of the class that holds the field."""
        return _cpp_name(field.name, field.owner)

    def type(self, field: Field) -> str:
        """The type of a field's member."""
        if field.type.kind != "map":
            return self.value_type(field.type)
        where = f"{field.owner}.{field.name}"
        of = "Datum" if field.type.of[0].kind == "integer" else self.value_type(field.type.of[0])
        if where in _IN_ORDER:
            return f"std::vector<std::pair<std::string, {of}>>"
        return f"std::map<{field.keys or 'std::string'}, {of}>"

    def value_type(self, type_: Type) -> str:
        """The type of a value."""
        match type_.kind:
            case "text" | "words":
                return "std::string"
            case "boolean":
                return "bool"
            case "int32":
                return "std::int32_t"
            case "int64" | "integer":
                return "std::int64_t"
            case "datum":
                return "Datum"
            case "list":
                return f"std::vector<{self.value_type(type_.of[0])}>"
            case "map":
                return f"std::map<std::string, {self.value_type(type_.of[0])}>"
        name = self._protocol.union_of.get(type_.name, type_.name)
        return _SHARED.get(name, _cpp_name(name))

    def initial(self, field: Field) -> str:
        """The initializer of a field's member, with the blank before it; empty if its type needs none."""
        match field.type.kind, field.default:
            case "enum", _:
                return f" = {self.type(field)}()"
            case "boolean", value:
                return f" = {str(bool(value)).lower()}"
            case "int32" | "int64" | "integer", value:
                return f" = {value or 0}"
            case "text" | "words", str(value) if value:
                return f' = "{value}"'
        return ""

    def has_flag(self, field: Field) -> bool:
        """Does a member beside the field's tell that it is not null?"""
        return field.nullable and field.owner not in _EMPTY_IS_NULL

    def members(self, union: Union) -> list[tuple[Field, list[str]]]:
        """The members of the class of a union: a field that stands for it, and the tags of the alternatives that have it."""
        found: dict[str, tuple[Field, list[str]]] = {}
        for one in union.alternatives:
            for field in one.fields:
                known, tags = found.setdefault(self.member(field), (field, []))
                assert self.type(known) == self.type(field), f"{field.owner}.{field.name} has two types"
                if known.default is None and field.default is not None:
                    found[self.member(field)] = (field, tags)
                tags.append(one.tag)
        return list(found.values())

    def read(self, field: Field) -> str:
        """The statement that reads the field from ``fields`` into ``into``."""
        how = "required" if field.required else "nullable" if field.nullable else "optional"
        arguments = f'"{field.name}", into.{self.member(field)}'
        part = field.type.of[0] if field.type.kind == "list" else field.type
        if field.type.kind == "words":
            arguments += f", words_of_{field.owner}_{field.name}()"
        elif part.name in self._protocol.union_of:
            read = f"read_{part.name.lower()}"
            arguments += f", {read if part is field.type else f'json::read_each<SharedType, {read}>'}"
        elif field.type.kind == "map" and field.type.of[0].kind == "integer":
            arguments += ", json::read_integers"
        flag = f"into.has_{self.member(field)} = " if self.has_flag(field) else ""
        return f"{flag}fields.{how}({arguments});"

    def argument_types(self, field: Field) -> list[str]:
        """The types of what may be given for a field that is written."""
        if field.type.kind == "any":
            plain = [t for t in field.type.of if t.kind not in ("struct", "words")]
            return [*map(self._argument, plain), "const Reference&"]
        return [self._argument(field.type)]

    def _argument(self, type_: Type) -> str:
        if "Event" in {part.name or self._protocol.union_of.get(part.name, "") for part in _with_parts(type_)}:
            return "const json::Written&"
        spelled = {"MaybeReference": "Reference", "Dependency": "PortConnection"}
        of = type_.of[0] if type_.of else type_
        name = spelled.get(of.name) or self.value_type(of)
        if type_.kind == "list":
            name = f"std::vector<{name}>"
        elif type_.kind == "map":
            name = f"std::map<std::string, {name}>"
        return name if type_.kind in ("boolean", "int32", "int64") else "Hook" if type_.name == "Hook" else f"const {name}&"


# Java


def _camel(name: str) -> str:
    first, *others = name.split("_")
    return first + "".join(word.capitalize() for word in others)


_JAVA_KEYWORDS = ("default", "interface")


class Java:
    """How the templates spell things in Java."""

    def __init__(self, protocol: Protocol) -> None:
        self._protocol = protocol

    def name(self, field: Field) -> str:
        """The method that gives, or sets, the field."""
        return f"{_camel(field.name)}{'_' if field.name in _JAVA_KEYWORDS else ''}"

    def type(self, type_: Type, boxed: bool = False) -> str:
        """The type of a value."""
        match type_.kind:
            case "text" | "words" | "enum":
                return "String"
            case "boolean":
                return "Boolean" if boxed else "boolean"
            case "int32" | "int64":
                return "Long" if boxed else "long"
            case "datum" | "any" | "integer":
                return "Object"
            case "list":
                return f"List<{self.type(type_.of[0], True)}>"
            case "map":
                return f"Map<String, {self.type(type_.of[0], True)}>"
        return self._protocol.union_of.get(type_.name, type_.name)

    def shape(self, field: Field) -> str:
        """The shape of the field's value."""
        type_ = field.type
        if field.keys:
            return f"map({field.keys.upper()}, {self._shape(type_.of[0])})"
        shape = self._shape(type_)
        return f"orNull({shape})" if field.nullable else shape

    def _shape(self, type_: Type) -> str:
        match type_.kind:
            case "text" | "int32" | "int64" | "datum":
                return type_.kind.upper()
            case "boolean":
                return "FLAG"
            case "integer":
                return "ANY_INTEGER"
            case "words":
                return f"choice({', '.join(json.dumps(word) for word in type_.words)})"
            case "list":
                return f"list({self._shape(type_.of[0])})"
            case "map":
                return f"map(TEXT, {self._shape(type_.of[0])})"
        return f"Messages::read{type_.name}" if type_.kind != "enum" else type_.name.upper()

    def preset(self, field: Field) -> str:
        """What stands for a field that is left out."""
        match field.default:
            case int() as value if not isinstance(value, bool):
                return f"{value}L"
            case []:
                return "List.of()"
            case {}:
                return "new Node(Map.of())"
        return json.dumps(field.default)

    def getter(self, field: Field) -> str:
        """The expression that gives the field of a node."""
        match field.type.kind:
            case "text" | "words" | "enum":
                return f'text("{field.name}")'
            case "boolean":
                return f'flag("{field.name}")'
            case "int32" | "int64":
                return f'number("{field.name}")'
            case "datum" | "any" | "integer":
                return f'get("{field.name}")'
            case "map":
                return f'as(node("{field.name}").fields())'
        return f'as(get("{field.name}"))'


def comment(text: str, start: str, width: int = 120) -> str:
    """``text`` in lines that begin with ``start``."""
    paragraphs = [" ".join(paragraph.split()) for paragraph in text.replace("``", "`").split("\n\n")]
    lines = [line for one in paragraphs for line in (*textwrap.wrap(one, width - len(start)), "")][:-1]
    return "\n".join((start + line).rstrip() for line in lines)


def first_sentence(text: str) -> str:
    """The first sentence of ``text``, for Java's summaries."""
    return " ".join(text.replace("``", "").split("\n\n")[0].split()).partition(". ")[0].rstrip(".:") + "."


def rendered(template: str, folders: Sequence[Path] = ()) -> str:
    """The text that ``template`` gives for the committed schema; the template may stand in one of ``folders``."""
    loader = jinja2.FileSystemLoader([Path(__file__).parent / "templates", *folders])
    environment = jinja2.Environment(
        loader=loader, trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True, undefined=jinja2.StrictUndefined
    )
    environment.filters.update(comment=comment, first_sentence=first_sentence)
    protocol = Protocol(json.loads(SCHEMA.read_text()))
    return environment.get_template(template).render(
        made_by="made by python -m ucm_cts.adapters.contract.generating from protocol.schema.json: do not edit",
        protocol=protocol,
        cpp=Cpp(protocol),
        java=Java(protocol),
    )


def main() -> None:
    """Writes all generated files."""
    for path, template in FILES.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(rendered(template))


if __name__ == "__main__":
    main()
