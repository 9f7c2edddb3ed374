"""Properties about values: every core data type is carried by both connectors, in every direction and at any depth (10.1.1).

They are checked when the trace is over: only then it is known which values were carried well alone, and which message was which.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType, Datum, Float
from ucm_cts.adapters.contract.data_values import kind_name, misfit, printed
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Taken
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model import services
from ucm_cts.reference_models.model import value_transport as transport
from ucm_cts.reference_models.model.designation import designation, error_name
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.service_call import ServiceCall
from ucm_cts.reference_models.model.values_carried import Carried, method_of, values_carried
from ucm_cts.reference_models.properties.declaration import Property, property_at

_LONGEST = 70


@property_at("closed", *transport.REQUIREMENTS)
def exact_values(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A connector carries values unchanged, bit by bit, in both directions."""
    wrong: list[tuple[Carried, transport.Difference]] = []
    well: list[Carried] = []
    for carried in values_carried(runtime):
        if any(d.is_nan for d in carried.differences):
            yield Taken("nan", "any")
        different = [d for d in carried.differences if not (d.is_nan and runtime.ics.permits("nan", "any"))]
        if different:
            wrong.append((carried, different[0]))
            continue
        well.append(carried)
        for requirement in transport.requirements_of(carried.of, carried.sent):
            yield check.kept(requirement)
    evidence = transport.Evidence()
    for carried in well if wrong else ():
        evidence.add(carried.of, carried.sent)
    for carried, difference in wrong:
        yield _altered(check, carried, difference, evidence.broken_by(difference.part))


def _altered(check: Property, carried: Carried, difference: transport.Difference, requirement: str) -> Finding:
    part = difference.part
    kind = kind_name(part.of)
    return check.fail(
        f"{_sort_of(part.of, part.value)}{kind} as {carried.way}",
        expected=f"{kind} {shown(part.of, part.value)}{_place(part)} arrives as sent",
        observed=f"it arrived as {shown(part.of, difference.got)}",
        at=carried.events,
        requirement=requirement,
    )


def _place(part: transport.Part) -> str:
    named = [one.place for one in (*part.around, part) if one.place]
    where = "".join(place if place.startswith("[") else f".{place}" for place in named)
    return f" at {where} of a {kind_name(part.around[0].of)}" if where else ""


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


def shown(of: AnyType, value: object) -> str:
    """``value`` for people, not too long."""
    if isinstance(of, Float) and isinstance(value, str) and not misfit(of, value):
        return f"{value} ({_number(of, value)!r})"
    return printed(value, _LONGEST)


@property_at("closed", *transport.REQUIREMENTS)
def values_accepted(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A service call is not refused for its values, while others are served."""
    interactions = runtime.interactions
    if not any(call.reply is not None and call.reply.raised for call in interactions.calls):
        return
    judged = [
        one
        for one in services.service_calls(runtime)
        if one.call.reply is not None and not services.is_disturbed(runtime, one)
    ]
    troubles = [(one, services.trouble_with(runtime, one)) for one in judged]
    served = [one for one, trouble in troubles if not trouble]
    known = [value for one in served for value in _values_of(runtime, one)]
    refused = [
        (one, values)
        for one, trouble in troubles
        if not services.what_sets_apart(runtime, one, served) and (values := _refused(runtime, one, trouble))
        if not _may_be_carried(one, values, known)
    ]
    if not refused or all(trouble in ("failed", "not served") for _, trouble in troubles):
        return
    alone = [of for _, values in refused for of, _ in values[:1]]
    for one, values in refused:
        yield _refusal(check, one, *values[0], alone)


def _may_be_carried(
    one: ServiceCall, values: Sequence[tuple[AnyType, Datum]], known: Sequence[tuple[AnyType, Datum]]
) -> bool:
    """Are its values like those of calls that are carried out? Of a call that is made while its client is called itself, or
    gets a message, that may be the reason, so that values of the same types are enough.
    """
    if services.is_nested(one):
        types = [of for of, _ in known]
        return all(of in types for of, _ in values)
    return all(value in known for value in values)


def _values_of(runtime: ObservedRuntime, one: ServiceCall) -> Iterator[tuple[AnyType, Datum]]:
    """The arguments that its server got, and the results that came back."""
    method = method_of(runtime, one.call)
    if method is not None:
        yield from _typed([p.of for p in method.arguments], one.call.request.arguments)
    if method is not None and one.exit is not None and one.exit.exception is None:
        yield from _typed([p.of for p in method.results], one.exit.results)


def _refused(runtime: ObservedRuntime, one: ServiceCall, trouble: str) -> list[tuple[AnyType, Datum]]:
    """The values that kept a call from being carried out: its arguments if they did not arrive, or else its results."""
    method, reply, left = method_of(runtime, one.call), one.call.reply, one.exit
    if method is None or reply is None or not reply.raised or one.server.member.declaration.policies:
        return []
    if trouble == "not served":
        return list(_typed([p.of for p in method.arguments], one.call.request.arguments))
    if trouble == "failed" and left is not None and left.n < reply.n:
        return list(_typed([p.of for p in method.results], left.results))
    return []


def _typed(types: Sequence[AnyType], given: Sequence[Datum] | None) -> Iterator[tuple[AnyType, Datum]]:
    if given is not None and len(given) == len(types) and not any(map(misfit, types, given)):
        yield from zip(types, given, strict=True)


def _refusal(check: Property, one: ServiceCall, of: AnyType, value: Datum, alone: Sequence[AnyType]) -> Finding:
    """The innermost part whose type was refused by itself as well is the reason."""
    suspects = [part for part in transport.inside(transport.Part(of, value)) if not part.around or part.of in alone]
    suspect = max(suspects, key=lambda part: len(part.around))
    reply = one.call.reply
    return check.fail(
        f"{kind_name(suspect.of)} refused",
        expected=f"a call with {kind_name(of)} {shown(of, value)} is carried out, as others are",
        observed="it ended with an exception that the server did not raise",
        at=(one.call.request.n, reply.n if reply is not None else one.call.request.n),
        requirement=transport.requirement_of(suspect.of),
    )


@property_at("linked", *transport.REQUIREMENTS)
def types_accepted(
    check: Property, runtime: ObservedRuntime, link: LinkState | None, step: s.ConnectorCall, end: Return | Raise
) -> Concluded:
    """A connector that can be bound to one interface can be bound to another one with other data types."""
    interactions = runtime.interactions
    if not isinstance(step, s.Link) or isinstance(end, Return):
        return ()
    if not any(other.connector == step.connector for other in interactions.links.values()):
        return ()
    if any(container.started is not False for container in runtime.containers.values()):
        return ()
    types = services.new_types(runtime, step)
    if not types:
        return ()
    return check.fail(
        f"{kind_name(types[0])} refused by {step.connector}",
        expected=f"{step.connector} can be bound to an interface with {kind_name(types[0])}, as it is to another one",
        observed=f"{designation(step)} raised {error_name(end.error)} {end.detail}".rstrip(),
        event=end,
        requirement=transport.requirement_of(types[0]),
    )
