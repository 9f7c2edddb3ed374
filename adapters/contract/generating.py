"""Message types in C++ and Java, generated from ``protocol.schema.json``.

``python -m ucm_cts.adapters.contract.generating`` writes the files anew; ``docs/decisions/0010-generated-wire-types.md``
says why they are made here.
"""

from __future__ import annotations

import inspect
import json
import re
import textwrap
from collections.abc import Iterable, Sequence
from pathlib import Path

import jinja2

from ucm_cts.adapters.contract.schema_types import Field, Protocol, Type, Union, with_parts

SCHEMA = Path(__file__).with_name("protocol.schema.json")
SDK = Path(__file__).parents[1] / "sdk"
CPP = SDK / "cpp" / "include" / "ucm_cts" / "generated"
JAVA = SDK / "java" / "src" / "generated" / "java" / "org" / "ucmcts"

FILES = {
    CPP / "messages.hpp": "messages.hpp.jinja",
    CPP / "messages_reading.hpp": "messages_reading.hpp.jinja",
    CPP / "events.hpp": "events.hpp.jinja",
    JAVA / "Messages.java": "Messages.java.jinja",
}
"""The generated files, each with its template."""


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
        """As ``Union.members``, by the names in C++, where a member has one type."""
        found = union.members(self.member)
        types = {self.member(field): self.type(field) for field, _ in found}
        for field in (f for one in union.alternatives for f in one.fields):
            assert self.type(field) == types[self.member(field)], f"{field.owner}.{field.name} has another type"
        return found

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
        if "Event" in {part.name or self._protocol.union_of.get(part.name, "") for part in with_parts(type_)}:
            return "const json::Written&"
        spelled = {"MaybeReference": "Reference", "Dependency": "PortConnection"}
        of = type_.of[0] if type_.of else type_
        name = spelled.get(of.name) or self.value_type(of)
        if type_.kind == "list":
            name = f"std::vector<{name}>"
        elif type_.kind == "map":
            name = f"std::map<std::string, {name}>"
        return (
            name
            if type_.kind in ("boolean", "int32", "int64")
            else "Hook"
            if type_.name == "Hook"
            else f"const {name}&"
        )


# Java


def _camel(name: str) -> str:
    first, *others = name.split("_")
    return first + "".join(word.capitalize() for word in others)


_TAKEN_IN_JAVA = ("default", "interface", "fields")
"""Keywords, and a method of ``Node``."""


class Java:
    """How the templates spell things in Java."""

    def __init__(self, protocol: Protocol) -> None:
        self._protocol = protocol

    def name(self, field: Field) -> str:
        """The method that gives, or sets, the field."""
        return f"{_camel(field.name)}{'_' if field.name in _TAKEN_IN_JAVA else ''}"

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

    def members(self, union: Union) -> list[tuple[Field, list[str]]]:
        """As ``Union.members``, by the names of the schema."""
        return union.members(lambda field: field.name)

    def summary(self, tags: Iterable[str]) -> str:
        """The comment that says which kinds of objects have a field."""
        line = f"        /** Of {', '.join(tags)}. */"
        return (
            line
            if len(line) <= 120
            else comment(line[4:-4].strip(" *"), "         * ").join(("        /**\n", "\n         */"))
        )

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
                words = comment(", ".join(map(json.dumps, type_.words)), " " * 28)
                return f"choice({words.strip() if len(words) < 80 else chr(10) + words})"
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
                return f'{"numberOrNull" if field.nullable else "number"}("{field.name}")'
            case "datum" | "any" | "integer":
                return f'get("{field.name}")'
            case "map":
                return f'as(node("{field.name}").fields())'
        return f'as(get("{field.name}"))'


def comment(text: str, start: str, width: int = 120) -> str:
    """``text`` in lines that begin with ``start``."""
    joined = re.sub(
        r"(?<!\n)\n(?!\n|``\w+``: )", " ", inspect.cleandoc(text)
    )  # lines of one paragraph, or of one field
    paragraphs = joined.replace("``", "`").split("\n")
    lines = [line for one in paragraphs for line in textwrap.wrap(one, width - len(start)) or [""]]
    return "\n".join((start + line).rstrip() for line in lines)


def rendered(template: str, folders: Sequence[Path] = ()) -> str:
    """The text that ``template`` gives for the committed schema; the template may stand in one of ``folders``."""
    loader = jinja2.FileSystemLoader([Path(__file__).parent / "templates", *folders])
    environment = jinja2.Environment(
        loader=loader,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters["comment"] = comment
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
