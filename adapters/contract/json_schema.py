"""JSON Schema of our types, the same with msgspec 0.22 and 0.23."""

from __future__ import annotations

import inspect
from collections.abc import Sequence
from typing import Any

import msgspec


def schema_of(kind: Any) -> dict[str, Any]:
    """JSON Schema of one type, with the definitions that it needs."""
    return dict(_alike(msgspec.json.schema(kind)))


def schemas_of(kinds: Sequence[Any]) -> tuple[list[Any], dict[str, Any]]:
    """JSON Schema of each type, and the definitions that they share, which they refer to as ``#/$defs/NAME``."""
    schemas, definitions = msgspec.json.schema_components(kinds, ref_template="#/$defs/{name}")
    return [_alike(schema) for schema in schemas], {name: _alike(one) for name, one in definitions.items()}


def _alike(schema: Any) -> Any:
    """``schema`` with docstrings without indentation, and without the names of keys, both of which depend on the version of msgspec."""
    if isinstance(schema, list):
        return [_alike(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    text = schema.get("description")
    cleaned = {"description": inspect.cleandoc(text)} if isinstance(text, str) else {}
    is_map = isinstance(schema.get("propertyNames"), dict) and "additionalProperties" in schema
    return {
        key: _alike(value) for key, value in {**schema, **cleaned}.items() if not (is_map and key == "propertyNames")
    }
