"""Messages of the protocol: a value of each kind, made from the schema, and messages with one error each."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator, Sequence
from typing import Any

import msgspec

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
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
            case "map":
                return dict(zip("mnopqrstuvw", self._several(type_.of[0]), strict=False))
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


def mutations(value: Any) -> Iterator[Any]:
    """``value`` with one thing changed, in every place."""
    wrong: list[Any] = [None, True, 3, 1.5, "other", [], {}, [None]]
    yield from (w for w in wrong if type(w) is not type(value))
    if isinstance(value, dict):
        yield {**value, "surprise": 1}
        for name, member in value.items():
            yield {k: v for k, v in value.items() if k != name}
            yield {("other" if k == name else k): v for k, v in value.items()}
            yield from ({**value, name: changed} for changed in mutations(member))
    if isinstance(value, list):
        for n, element in enumerate(value):
            yield from ([*value[:n], changed, *value[n + 1 :]] for changed in mutations(element))


def mutated_lines() -> list[bytes]:
    """Messages of every kind, each with one thing changed."""
    plan: dict[s.Hook, tuple[s.Action, ...]] = {
        "exchange": (s.ReturnValue(1), s.CallPort("r_e", 2), s.HoldAtGate("g"), s.QuerySiblings(), s.RaiseError()),
        "run": (s.RaiseError(),),
        "method": (
            s.CallMethod("r_e", "m", ([1, ["x"]], True)),
            s.Answer("m", (1,), "wrong", overwrite=True),
            s.Burst("r_e", 1, 2),
            s.CountMessages(),
        ),
    }
    policies = (s.Policy(s.ACTIVE, "p_e", {"period": "2"}), s.Policy(s.CLOCK, element="c.clock_api"))
    declared = s.Declaration(("p_e",), ("r_e",), {"a": "b"}, True, True, plan, policies, {"p_e": "i"})
    steps = (
        s.AddComponent("A", bind="x"),
        s.RemoveComponent("nobody"),
        s.GetPortElement("nobody", "p_e", "ref"),
        s.Connect("nobody", "r_e", "nil", "k"),
        s.Disconnect("nobody"),
        s.Start(container="nowhere"),
        s.CreateContainer("sub"),
        s.RemoveContainer("sub"),
        s.Invoke("nil", 5),
        s.OpenGate("g"),
        s.Settle("w", thread="u"),
        s.Join("w", thread="v"),
        s.Link("simple_service_connector", "i", "l"),
        s.Attach("l", "client", "nobody", "r_e", container="nowhere"),
        s.Detach("l", "nobody", "r_e", container="nowhere"),
        s.Break("l", "inside"),
        s.Mend("l"),
        s.ReadLog(),
        s.Pause(0),
        s.AwaitMessages("A", 0, 2),
        s.Stress(("nobody",), 1),
        s.Destroy(),
    )
    every_type = d.Structure(
        "s",
        {
            "e": d.Enumeration("colour", "BYTE", {"red": 1}),
            "u": d.Union(
                "u",
                d.Enumeration("colour", "LONG", {"red": 1}),
                (d.UnionCase("c", d.Boolean(), ("red",)), d.UnionCase("o", d.Char("CHAR8"), default=True)),
            ),
            "a": d.Array(d.Alias("name", d.String("CHAR32", 4)), (2, 3)),
            "q": d.Sequence(d.Float("FLOAT"), 4),
            "n": d.Integer("ULONG"),
        },
    )
    method = d.Method((d.Parameter("p", "INOUT", every_type),), (d.Structure("wrong", {}),))
    interfaces = {"i": d.Interface({"m": method}, ("j",))}
    bound: dict[str, d.AnyType] = {"request_t": d.Integer("LONG"), "result_t": d.String("CHAR8")}
    asked = s.Scenario({"A": declared}, steps, 500, interfaces, ("w",), {"types": bound})
    message = json.loads(m.encode(m.Run(1, asked, stream=False)))
    message["scenario"]["patience"] = 500
    reach = json.loads(m.encode(m.Run(1, s.Scenario({}, (s.ReachGate("g", 1, 2),), patience=0))))
    changed = (*mutations(copy.deepcopy(message)), *(r for r in mutations(reach) if "patience" in str(r)))
    lines = [json.dumps(one).encode() for one in changed]
    lines += [
        b"x",
        b"{}",
        b"[]",
        b'{"type":"hello","protocol":2}x',
        b'{"type":"hello","protocol":"2"}',
        b'{"type":"run"',
    ]
    lines += [b'\xff{"type":"hello","protocol":2}', b'{"type":"hello","protocol":3}', b"[" * 100_000]
    lines = [line for line in lines if b'"stream": true' not in line]
    assert len(lines) > 500
    return lines


def check_refusals(lines: Sequence[bytes], answers: Sequence[m.FromHost]) -> None:
    """``answers`` refuse those of ``lines`` that are no messages, and no others."""
    assert len(answers) == len(lines)
    decoder = m.to_host_decoder()
    for line, answer in zip(lines, answers, strict=True):
        try:
            meant = decoder.decode(line)
        except (msgspec.MsgspecError, RecursionError):
            assert isinstance(answer, m.Refused), line
        else:
            wrong_version = isinstance(meant, m.Hello) and meant.protocol != m.PROTOCOL
            nowhere = isinstance(answer, m.Refused) and "there is no interface" in answer.reason
            assert isinstance(answer, m.Refused) == wrong_version or nowhere, (line, answer)
