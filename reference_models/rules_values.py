"""Rules about values: every core data type is carried by both connectors, in every direction and at any depth (10.1.1).

They look when the trace is over: a value is known to be carried well alone only then, and which message was which.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType, Datum, Float, Interface, Method
from ucm_cts.adapters.contract.data_values import kind_name, misfit
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.reference_models.carriage import (
    REQUIREMENTS,
    Difference,
    Evidence,
    Part,
    differences,
    inside,
    requirement_of,
    requirements_of,
)
from ucm_cts.reference_models.interactions import Delivery, Interactions, LinkState, MethodCall
from ucm_cts.reference_models.ledger import Ledger, rule
from ucm_cts.reference_models.runtime import Runtime

_LONGEST = 70


@dataclass(frozen=True)
class _Carried:
    """A value that was sent in a call and arrived, as ``got``, whatever it is by now; ``events`` are both ends."""

    of: AnyType
    sent: Datum
    got: object
    role: str
    events: tuple[int, ...]


@rule("closed", *REQUIREMENTS)
def exact_values(ledger: Ledger, runtime: Runtime) -> None:
    """What a connector carries arrives as it was sent, bit by bit, and back again."""
    interactions = runtime.interactions
    if interactions is None or not interactions.links:
        return
    wrong: list[tuple[_Carried, list[Difference]]] = []
    well: list[_Carried] = []
    for call in interactions.calls:
        for carried in _carried_by(interactions, runtime, call):
            found = [
                d for d in differences(Part(carried.of, carried.sent), carried.got) if not _is_permitted(ledger, d)
            ]
            if found:
                wrong.append((carried, found))
                continue
            well.append(carried)
            for requirement in requirements_of(carried.of, carried.sent):
                ledger.exercised(requirement)
    evidence = Evidence()
    for carried in well if wrong else ():
        evidence.add(carried.of, carried.sent)
    for carried, found in wrong:
        _accuse(ledger, carried, found[0], evidence.to_blame(found[0].part))


def _is_permitted(ledger: Ledger, difference: Difference) -> bool:
    """Another NaN may arrive, unless exactness is declared."""
    return difference.is_nan and ledger.observed("nan", "any")


def _accuse(ledger: Ledger, carried: _Carried, difference: Difference, requirement: str) -> None:
    part = difference.part
    kind, place = kind_name(part.of), _place(part)
    sort = _sort_of(part.of, part.value)
    ledger.violated(
        requirement,
        "exact_values",
        f"{sort}{kind} as {carried.role}",
        f"{kind} {told(part.of, part.value)}{place} arrives as sent",
        f"it arrived as {told(part.of, difference.got)}",
        carried.events,
    )


def _place(part: Part) -> str:
    where = "".join(one.place if one.place.startswith("[") else f".{one.place}" for one in _named(part))
    whole = part.around[0].of if part.around else None
    return f" at {where} of a {kind_name(whole)}" if whole is not None and where else ""


def _named(part: Part) -> Iterator[Part]:
    return (one for one in (*part.around, part) if one.place)


def _sort_of(of: AnyType, value: Datum) -> str:
    """What sort of floating-point number it is, because each sort is lost in its own way."""
    if not isinstance(of, Float) or not isinstance(value, str):
        return ""
    number = _number(of, value)
    if math.isnan(number):
        return "NaN of "
    if math.isinf(number):
        return "infinity of "
    if number == 0:
        return "zero of "
    return "subnormal " if abs(number) < (2**-126 if of.kind == "FLOAT" else 2**-1022) else ""


def _number(of: Float, value: str) -> float:
    return float(struct.unpack(">f" if of.kind == "FLOAT" else ">d", bytes.fromhex(value))[0])


def told(of: AnyType, value: object) -> str:
    """``value`` for people, not too long."""
    if isinstance(of, Float) and isinstance(value, str) and not misfit(of, value):
        return f"{value} ({_number(of, value)!r})"
    text = repr(value)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 20]}… ({len(text)} characters)"


def _carried_by(interactions: Interactions, runtime: Runtime, call: MethodCall) -> Iterator[_Carried]:
    """The values that ``call`` had carried, as far as they arrived."""
    method = _method_of(runtime, call)
    if method is None:
        return
    for delivery in call.deliveries:
        if delivery.fit in ("same", "altered") and not _is_of_another(interactions, call, delivery):
            types = [parameter.of for parameter in method.arguments]
            events = (call.request.n, delivery.enter.n)
            yield from _pairs(types, call.request.arguments, delivery.enter.arguments, "argument", events)
    if not call.is_message and len(call.deliveries) == 1:
        yield from _results_of(interactions, method, call, call.deliveries[0])


def _method_of(runtime: Runtime, call: MethodCall) -> Method | None:
    interface = _interface_of(runtime, call.link) if call.link is not None else None
    return interface.methods.get(call.request.method or "") if interface is not None else None


def _interface_of(runtime: Runtime, link: LinkState) -> Interface | None:
    return runtime.scenario.interfaces.get(link.interface)


def _results_of(interactions: Interactions, method: Method, call: MethodCall, delivery: Delivery) -> Iterator[_Carried]:
    """What the server gave back and the client got: results, or the fields of a declared exception."""
    gave, got = delivery.exit, call.reply
    if gave is None or got is None or gave.raised or got.raised or gave.exception != got.exception:
        return
    if _is_result_of_another(interactions, call, delivery):
        return
    events = (gave.n, got.n)
    if gave.exception is None:
        yield from _pairs([p.of for p in method.results], gave.results, got.results, "result", events)
    for exception in method.raises:
        if exception.name == gave.exception:
            yield from _pairs(
                list(exception.fields.values()), gave.results, got.results, "field of an exception", events
            )


def _pairs(
    types: list[AnyType],
    sent: Sequence[Datum] | None,
    got: Sequence[Datum] | None,
    role: str,
    events: tuple[int, ...],
) -> Iterator[_Carried]:
    """Value by value; another number of values is not a matter of their types."""
    if sent is None or got is None or not len(types) == len(sent) == len(got):
        return
    for of, value, arrived in zip(types, sent, got, strict=True):
        if not misfit(of, value):
            yield _Carried(of, value, arrived, role, events)


def _is_of_another(interactions: Interactions, call: MethodCall, delivery: Delivery) -> bool:
    """Did the values of another client's call arrive in place of this one's? That is not a matter of their types."""
    if delivery.fit == "same":
        return False
    return any(
        other.request.arguments == delivery.enter.arguments and other.request.method == call.request.method
        for other in interactions.calls
        if other.caller is not call.caller
    )


def _is_result_of_another(interactions: Interactions, call: MethodCall, delivery: Delivery) -> bool:
    """Did the client get what was meant for another client?"""
    assert call.reply is not None
    if delivery.exit is not None and delivery.exit.results == call.reply.results:
        return False
    return any(
        other.exit is not None and other.exit.results == call.reply.results and other.link is call.link
        for other in interactions.deliveries
        if other.call is not None and other.call.caller is not call.caller
    )


@rule("completed", *REQUIREMENTS)
def values_accepted(ledger: Ledger, runtime: Runtime, call: MethodCall) -> None:
    """A service call is not refused for its values: nothing else can explain that this one ends with an exception."""
    interactions = runtime.interactions
    refused = _refused_by(runtime, call)
    if not refused or interactions is None or not _is_quiet(ledger.scenario):
        return
    others = [c for c in interactions.calls if c.link is not None and not c.is_message and c.reply is not None]
    if all(_is_raised(other) for other in others):
        return
    assert call.reply is not None
    of, value = refused[0]
    alone = [values[0][0] for other in others if other is not call and (values := _refused_by(runtime, other))]
    smallest = max(
        (part for part in inside(Part(of, value)) if not part.around or part.of in alone),
        key=lambda part: len(part.around),
    )
    ledger.violated(
        requirement_of(smallest.of),
        "values_accepted",
        f"{kind_name(smallest.of)} refused",
        f"a call with {kind_name(of)} {told(of, value)} comes back",
        "it ended with an exception that the server did not raise",
        (call.request.n, call.reply.n),
    )


def _is_raised(call: MethodCall) -> bool:
    return call.reply is not None and call.reply.raised


def _is_quiet(scenario: s.Scenario) -> bool:
    """Does nothing in it break, overlap, wait or fail, so that each call between operational components comes back?"""
    if any(declaration.policies for declaration in scenario.components.values()):
        return False
    if any(isinstance(step, s.Break) or step.thread is not None for step in scenario.steps):
        return False
    plans = (plan.get("method", ()) for plan in (d.plan for d in scenario.components.values()))
    return not any(isinstance(action, s.HoldAtGate | s.RaiseError) for plan in plans for action in plan)


def _refused_by(runtime: Runtime, call: MethodCall) -> list[tuple[AnyType, Datum]]:
    """The values that kept ``call`` from coming back: its arguments if they did not arrive, or else the results."""
    method = _method_of(runtime, call)
    possible = call.caller is not None and call.caller.serving and [ready for _, ready in call.targets] == [True]
    if method is None or call.is_message or not possible or not _is_raised(call) or len(call.deliveries) > 1:
        return []
    if not call.deliveries:
        return _typed([parameter.of for parameter in method.arguments], call.request.arguments)
    gave = call.deliveries[0].exit
    if call.deliveries[0].fit != "same" or gave is None or gave.raised or gave.exception is not None:
        return []
    return _typed([parameter.of for parameter in method.results], gave.results)


def _typed(types: list[AnyType], given: Sequence[Datum] | None) -> list[tuple[AnyType, Datum]]:
    if given is None or len(given) != len(types) or any(map(misfit, types, given)):
        return []
    return list(zip(types, given, strict=True))


@rule("linked", *REQUIREMENTS)
def types_accepted(
    ledger: Ledger, runtime: Runtime, link: LinkState | None, step: s.ConnectorCall, end: Return | Raise
) -> None:
    """A connector that can be bound to one interface can be bound to another one with other data types."""
    interactions = runtime.interactions
    if not isinstance(step, s.Link) or isinstance(end, Return) or interactions is None:
        return
    if not any(other.connector == step.connector for other in interactions.links.values()):
        return
    if any(container.started is not False for container in runtime.containers.values()):
        return
    interface = runtime.scenario.interfaces[step.interface]
    types = [parameter.of for method in interface.methods.values() for parameter in method.parameters]
    if not types:
        return
    ledger.violated(
        requirement_of(types[0]),
        "types_accepted",
        f"{kind_name(types[0])} refused by {step.connector}",
        f"{step.connector} can be bound to an interface with {kind_name(types[0])}",
        f"it ended with {end.error} {end.detail}" if isinstance(end, Raise) else "",
        (end.n,),
        end.step,
    )
