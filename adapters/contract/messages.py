"""The wire protocol: one JSON message a line, versioned; the types here are its schema.

The harness sends ``hello`` once and then any number of ``run`` without waiting for answers; the host answers each in
order. One message carries a whole scenario, and one its whole trace. With ``stream`` the host also sends each event as it
happens, before the trace; the harness asks for that when it runs a scenario again after a crash.
``protocol.schema.json`` beside this file is generated from these types (``python -m ucm_cts.adapters.contract.messages``).
"""

from __future__ import annotations

import functools
from typing import Annotated, Any, get_args

import msgspec

from ucm_cts.adapters.contract.data_types import AnyType, Datum, Direction
from ucm_cts.adapters.contract.json_schema import schemas_of
from ucm_cts.adapters.contract.scenario import Action, Hook, Scenario, Step
from ucm_cts.adapters.contract.trace import Event, MaybeReference
from ucm_cts.adapters.contract.value import Int32, Int64, Value

PROTOCOL = 2


class Message(Value, frozen=True, tag_field="type"):
    """Base of all messages."""


class Hello(Message, frozen=True, tag="hello"):
    """Harness to host, first.

    ``protocol``: the version of the protocol that the harness speaks.
    """

    protocol: Int64


class Welcome(Message, frozen=True, tag="welcome"):
    """Host to harness, the answer to ``hello``.

    ``protocol``: the version of the protocol that the host speaks.
    ``product``: the framework's name.
    ``version``: the framework's version.
    ``port_element_name``: how the framework spells port element names, from ``{port}`` and ``{element}``.
    """

    protocol: Int64
    product: Annotated[str, msgspec.Meta(min_length=1)]
    version: str
    port_element_name: str = "{port}_{element}"


class Run(Message, frozen=True, tag="run"):
    """Harness to host: run a scenario on a new runtime.

    ``id``: number of the run; the answer has it too.
    ``scenario``: what to run.
    ``stream``: send each event as it happens.
    """

    id: Int64
    scenario: Scenario
    stream: bool = False


class Traced(Message, frozen=True, tag="trace"):
    """Host to harness, the answer to ``run``: the trace.

    ``id``: number of the run.
    ``events``: all events, in order.
    ``stuck``: the threads that did not return.
    """

    id: Int64
    events: tuple[Event, ...]
    stuck: tuple[str, ...] = ()


class Happened(Message, frozen=True, tag="event"):
    """Host to harness, in a streamed run: one event, as soon as it happens.

    ``id``: number of the run.
    ``event``: the event.
    """

    id: Int64
    event: Event


class Refused(Message, frozen=True, tag="refused"):
    """Host to harness: the last message breaks the protocol, or the adapter could not set up its framework.

    ``reason``: what is wrong, for people.
    ``id``: number of the run, if the message had one.
    """

    reason: str
    id: Int64 | None = None


ToHost = Hello | Run
FromHost = Welcome | Traced | Happened | Refused

encode = msgspec.json.Encoder().encode
"""Any message as one line of JSON, without the newline."""


@functools.cache
def to_host_decoder() -> msgspec.json.Decoder[ToHost]:
    """Strict decoder of what a host receives; raises ``msgspec.ValidationError`` naming the offending field."""
    return msgspec.json.Decoder(ToHost)


@functools.cache
def from_host_decoder() -> msgspec.json.Decoder[FromHost]:
    """Strict decoder of what a host sends; raises ``msgspec.ValidationError`` naming the offending field."""
    return msgspec.json.Decoder(FromHost)


class _Numbered(msgspec.Struct, frozen=True, tag_field="type", tag="run"):
    """The part of a ``run`` message that an answer needs."""

    id: Int64


def refusal(line: bytes, reason: str) -> Refused:
    """The answer to a ``line`` that is no message, with the number of the run if the line has one."""
    try:
        return Refused(reason, msgspec.json.decode(line, type=_Numbered).id)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        return Refused(reason)


_NAMED: dict[str, Any] = {
    "to_host": ToHost,
    "from_host": FromHost,
    "Step": Step,
    "Action": Action,
    "Event": Event,
    "AnyType": AnyType,
    "Datum": Datum,
    "MaybeReference": MaybeReference,
    "Hook": Hook,
    "Direction": Direction,
    "Int32": Int32,
    "Int64": Int64,
}
"""Types that are no classes and have a definition of their own in the schema."""


def protocol_schema() -> dict[str, Any]:
    """JSON Schema of both directions, for adapters in other languages."""
    schemas, definitions = schemas_of(list(_NAMED.values()))
    named = dict(zip(_NAMED, schemas, strict=True))
    definitions = {name: _with_names(schema, named, True) for name, schema in (named | definitions).items()}
    for name in ("Hook", "Direction"):
        definitions[name]["enum"] = list(get_args(_NAMED[name]))  # in the order of declaration
    definitions["Declaration"]["properties"]["plan"]["propertyNames"] = {"$ref": "#/$defs/Hook"}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"urn:ucm-cts:schema:protocol:{PROTOCOL}",
        "schema_version": PROTOCOL,
        "title": f"UCM-CTS wire protocol, version {PROTOCOL}",
        "description": "One message a line. A host reads to_host and writes from_host.",
        "anyOf": [{"$ref": "#/$defs/to_host"}, {"$ref": "#/$defs/from_host"}],
        "$defs": definitions,
    }


def _with_names(schema: Any, named: dict[str, Any], is_definition: bool = False) -> Any:
    """``schema`` with a reference wherever it repeats one of the ``named`` schemas."""
    if isinstance(schema, list):
        return [_with_names(one, named) for one in schema]
    if not isinstance(schema, dict):
        return schema
    default = {"default": schema["default"]} if "default" in schema else {}
    bare = {name: value for name, value in schema.items() if name != "default"}
    for name, repeated in named.items():
        if bare == repeated and not is_definition:
            return {"$ref": f"#/$defs/{name}", **default}
    return {name: _with_names(value, named) for name, value in schema.items()}


if __name__ == "__main__":
    import sys

    sys.stdout.buffer.write(msgspec.json.format(msgspec.json.encode(protocol_schema()), indent=2) + b"\n")
