"""Scenarios in which both connectors carry values of every type, in every direction (10.1.1).

Each type has a client and a server, or an emitter and a receiver, of its own. The parts of a value are carried before it, so
that a part that goes wrong everywhere is distinguished from one that goes wrong only inside other values.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import msgspec

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import SCALARS, kind_name, parts, spell
from ucm_cts.adapters.contract.scenario import Action, Declaration, Hook, Scenario, Step
from ucm_cts.harness.purposes.connections import PROVIDER, REQUIRER, provided_end, required_end
from ucm_cts.harness.purposes.data.catalogue import TypesUnderTest, load_types
from ucm_cts.harness.purposes.data.corner_values import UNDECLARED, Readings, corners
from ucm_cts.harness.purposes.data.typed_values import draw
from ucm_cts.harness.purposes.scripts import TestPurpose

CLAUSE = "10.1.1"

DRAWN = 4
"""So many values of each type are drawn for a run, beside its corner values."""

_MESSAGES = 6
"""So many values of a type that is made of others are pushed; services carry all."""

_PROVIDED, _REQUIRED = "in.api", "out.api"


@dataclass(frozen=True)
class Load:
    """Values of one type that a scenario is to have carried."""

    name: str
    of: d.AnyType
    values: tuple[d.Datum, ...]


def data_purposes(readings: Readings = UNDECLARED) -> list[TestPurpose]:
    """A purpose for each sort of types and one for attributes, within what the vendor declares of unclear places."""
    return [*(_purpose(types, readings) for types in load_types()), _attributes(readings)]


def _purpose(types: TypesUnderTest, readings: Readings) -> TestPurpose:
    return TestPurpose(
        f"data/{types.sort}",
        CLAUSE,
        f"Both connectors carry {types.sort}, in every direction.",
        (types.requirement,),
        _scenarios(types, None, readings),
        functools.partial(_scenarios, types),
    )


def _scenarios(
    types: TypesUnderTest, seed: int | None, readings: Readings = UNDECLARED
) -> tuple[tuple[str, Scenario], ...]:
    """The scenarios for these types; drawn values are added where there is a seed to draw them from."""
    loads = []
    for name, of in types.types.items():
        drawn = draw(of, DRAWN, f"{types.sort}/{name} of {seed}", readings) if seed is not None else []
        loads.append(Load(name, of, tuple(corners(of, readings) + drawn)))
    pushed = [Load(load.name, load.of, (*_some(load.of, load.values), _distinct(load, readings))) for load in loads]
    return (
        (f"data/{types.sort}/services", services(with_parts(loads))),
        (f"data/{types.sort}/messages", messages(with_parts(pushed))),
    )


def _distinct(load: Load, readings: Readings) -> d.Datum:
    """A value that is hardly like that of another type, even when it was altered."""
    return draw(load.of, 1, f"the message of {load.name}", readings)[0]


def _some(of: d.AnyType, values: tuple[d.Datum, ...]) -> tuple[d.Datum, ...]:
    """A selection of the values of a composed type, from the first to the last: each value takes many messages."""
    if isinstance(of, SCALARS) or len(values) <= _MESSAGES:
        return values
    return tuple(values[index * (len(values) - 1) // (_MESSAGES - 1)] for index in range(_MESSAGES))


def with_parts(loads: Iterable[Load]) -> list[Load]:
    """``loads``, preceded by the parts of their values, the smallest first."""
    wholes = list(loads)
    found: dict[bytes, tuple[d.AnyType, dict[bytes, d.Datum]]] = {}
    for load in wholes:
        for value in load.values:
            inner = list(parts(load.of, value))[1:]
            for of, part in reversed(inner):
                known = found.setdefault(msgspec.json.encode(of), (of, {}))
                known[1][msgspec.json.encode(part)] = part
    own = {msgspec.json.encode(load.of) for load in wholes}
    smaller = [
        Load(f"{kind_name(of)} {number}", of, tuple(values.values()))
        for number, (key, (of, values)) in enumerate(sorted(found.items(), key=lambda item: len(item[0])))
        if key not in own
    ]
    return [*smaller, *wholes]


def service_interface(of: d.AnyType) -> d.Interface:
    """Carries values of ``of`` as arguments and as results; ``carry`` is to give its three arguments back."""
    return d.Interface(
        {
            "take": d.Method((d.Parameter("value", "IN", of),)),
            "give": d.Method((d.Parameter("value", "OUT", of), d.Parameter("result", "RETURN", of))),
            "change": d.Method((d.Parameter("value", "INOUT", of),)),
            "carry": d.Method(
                (
                    d.Parameter("first", "IN", of),
                    d.Parameter("second", "IN", of),
                    d.Parameter("third", "INOUT", of),
                    d.Parameter("fourth", "OUT", of),
                    d.Parameter("result", "RETURN", of),
                )
            ),
        }
    )


def services(loads: Sequence[Load]) -> Scenario:
    """Clients that send all values, and servers that return values of their own and return what they received."""
    plans = [_client_and_server(load) for load in loads]
    return _scenario(
        s.SERVICE_CONNECTOR,
        [(load.name, service_interface(load.of), *plan, 0) for load, plan in zip(loads, plans, strict=True)],
    )


def _client_and_server(load: Load) -> tuple[tuple[Action, ...], tuple[Action, ...]]:
    around = itertools.cycle(load.values)
    own = [next(around) for _ in range(5)]
    calls = [
        s.CallMethod(_REQUIRED, "take", (own[0],)),
        s.CallMethod(_REQUIRED, "give"),
        s.CallMethod(_REQUIRED, "change", (own[1],)),
    ]
    for start in range(0, len(load.values), 3 if len(load.values) > 3 else 1):
        three = tuple(load.values[(start + place) % len(load.values)] for place in range(3))
        calls.append(s.CallMethod(_REQUIRED, "carry", three))
    answers = s.Answer("give", (own[2], own[3])), s.Answer("change", (own[4],)), s.Answer("carry")
    return tuple(calls), answers


def messages(loads: Sequence[Load], pause: int = 0) -> Scenario:
    """Emitters that push all values, each with a number so that no two messages are the same, and the last as it is.

    With ``pause``, milliseconds, the scenario waits so long for the messages of each, and not until they have arrived.
    """
    planned: list[_Planned] = []
    for load in loads:
        numbered = d.Structure("numbered", {"number": d.Integer("ULONG"), "value": load.of})
        values = [[number, value] for number, value in enumerate(load.values, 1000 * (len(planned) + 1))]
        planned.append(_emitter_and_receiver(load.name, numbered, values))
        planned.append(_emitter_and_receiver(f"{load.name} alone", load.of, load.values[-1:]))
    return _scenario(s.MESSAGE_CONNECTOR, [_hurried(one) for one in planned] if pause else planned, pause)


def _hurried(planned: _Planned) -> _Planned:
    name, interface, pushes, answers, _ = planned
    return name, interface, pushes, answers[1:], 0


def _emitter_and_receiver(name: str, of: d.AnyType, values: Sequence[d.Datum]) -> _Planned:
    pushes = tuple(s.CallMethod(_REQUIRED, s.PUSH, (value,)) for value in values)
    return (
        name,
        d.message_interface(of),
        pushes,
        (s.HoldAtGate(f"{name} arrived"), s.Answer(s.PUSH, ("ok",))),
        len(values),
    )


_Planned = tuple[str, d.Interface, tuple[Action, ...], tuple[Action, ...], int]
"""Name, interface, what the caller does, how the other end answers, and how many messages are to be waited for."""


def _scenario(connector: str, planned: Sequence[_Planned], pause: int = 0) -> Scenario:
    """A pair of components for each interface; all are linked and started, then each caller is sent off once."""
    sender, taker = REQUIRER[connector], PROVIDER[connector]
    components: dict[str, Declaration] = {}
    configure: list[Step] = []
    perform: list[Step] = []
    for name, _, calls, answers, awaited in planned:
        caller, other, link = f"{name} {sender}", f"{name} {taker}", f"{name} link"
        at_exchange: dict[Hook, tuple[Action, ...]] = {"exchange": calls}
        at_method: dict[Hook, tuple[Action, ...]] = {"method": answers}
        components[caller] = Declaration((_PROVIDED,), (_REQUIRED,), plan=at_exchange, ports={_REQUIRED: name})
        components[other] = Declaration((_PROVIDED,), plan=at_method, ports={_PROVIDED: name})
        configure += _linked(connector, name, caller, other, link)
        perform += [*_performed(name, awaited), *([s.Pause(pause)] if pause else [])]
    steps = (*configure, s.Start(), *perform, s.Stop())
    return Scenario(components, steps, interfaces={name: interface for name, interface, *_ in planned})


def _linked(connector: str, name: str, caller: str, other: str, link: str) -> Iterator[Step]:
    yield from (s.AddComponent(other), s.AddComponent(caller))
    yield s.Link(connector, name, link)  # type: ignore[arg-type]
    yield provided_end(connector, link, other, _PROVIDED)
    yield required_end(connector, link, caller, _REQUIRED)
    yield s.GetPortElement(caller, _PROVIDED, f"{name} stimulus")


def _performed(name: str, awaited: int) -> Iterator[Step]:
    if awaited:
        yield s.OpenGate(f"{name} arrived")
    yield s.Invoke(f"{name} stimulus", 0)
    if awaited:
        yield s.ReachGate(f"{name} arrived", total=awaited)


def _attributes(readings: Readings) -> TestPurpose:
    return TestPurpose(
        "data/attributes",
        CLAUSE,
        "Components have attributes of every type, with configured values.",
        ("R-10.1.1-06",),
        _attribute_scenarios(None, readings),
        _attribute_scenarios,
    )


def _attribute_scenarios(seed: int | None, readings: Readings = UNDECLARED) -> tuple[tuple[str, Scenario], ...]:
    """Several components of each type's corner values, and all types side by side."""
    given: dict[str, list[d.Datum]] = {}
    for sort in load_types():
        for name, of in sort.types.items():
            drawn = draw(of, DRAWN, f"attribute {sort.sort}/{name} of {seed}", readings) if seed is not None else []
            given[f"{sort.sort} {name}"] = corners(of, readings) + drawn
    rows = max(map(len, given.values()))
    components = {
        f"configured {row}": Declaration(
            attributes={name: spell(values[row % len(values)]) for name, values in given.items()}
        )
        for row in range(rows)
    }
    steps: list[Step] = [*map(s.AddComponent, components), s.Start(), s.Stop()]
    return (("data/attributes", Scenario(components, tuple(steps))),)
