"""Values that connectors carried in one trace, as sent and as arrived, and their differences (10.1.1).

Values can also go wrong for reasons that are not in them: another client's, or a direction that does not work at all. Those
belong to the connectors' own clauses, and are separated here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from ucm_cts.adapters.contract.data_types import AnyType, Datum, Method, Parameter
from ucm_cts.adapters.contract.data_values import misfit
from ucm_cts.reference_models.model.interactions import Interactions
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.value_transport import Difference, Part, differences

MESSAGE = "message"
EXCEPTION = "field of an exception"
_OVERWRITTEN_BY = 3
"""So many owners of one buffer may have overwritten it."""


class Carried(msgspec.Struct, frozen=True):
    """A value of a call that arrived.

    ``got``: the value that arrived, of any type.
    ``way``: its direction; ``events``: both ends.
    ``differences``: where it differs; none if it was carried well.
    ``doubtful``: what went wrong is like others of its values, or others were on their way as well.
    """

    call: MethodCall
    of: AnyType
    sent: Datum
    got: object
    way: str
    events: tuple[int, ...]
    differences: tuple[Difference, ...]
    doubtful: bool = False


def values_carried(runtime: ObservedRuntime) -> list[Carried]:
    """All values that were carried, as far as what became of them is a matter of their types."""
    interactions = runtime.interactions
    if not interactions.links:
        return []
    carried = [one for call in interactions.calls for one in _carried_by(runtime, call)]
    lost, altered = _lost_ways(carried), _altered_types(carried)
    return [
        one
        for one in carried
        if one.way not in lost
        and not _is_lost_in_exceptions(one, carried)
        and (not one.doubtful or any(d.part.of in altered for d in one.differences))
    ]


def altered_calls(runtime: ObservedRuntime) -> frozenset[MethodCall]:
    """The calls with values that arrived as others, because of their types. No other property is concerned."""
    return frozenset(one.call for one in values_carried(runtime) if one.differences)


def method_of(runtime: ObservedRuntime, call: MethodCall) -> Method | None:
    """The method that was called through a link; None if there is no link, or no such method."""
    interface = runtime.scenario.interfaces.get(call.link.interface) if call.link is not None else None
    return interface.methods.get(call.request.method or "") if interface is not None else None


def _altered_types(carried: Sequence[Carried]) -> list[AnyType]:
    """Types whose values are altered for certain: one of them that is like another value may be so by chance."""
    found: list[AnyType] = []
    for difference in (d for one in carried if not one.doubtful for d in one.differences):
        if difference.part.of not in found:
            found.append(difference.part.of)
    return found


def _lost_ways(carried: Sequence[Carried]) -> set[str]:
    """Ways on which no value arrives, although values arrive on others."""
    well = {one.way for one in carried if not one.differences}
    wrong = {one.way for one in carried if one.differences and one.way != MESSAGE}
    return wrong - well if well else set()


def _is_lost_in_exceptions(one: Carried, carried: Sequence[Carried]) -> bool:
    """Does its type arrive well on other ways, always, and never in an exception?"""
    if one.way != EXCEPTION or not one.differences or any(d.is_nan for d in one.differences):
        return False
    same = [other for other in carried if other.of == one.of]
    well = {other.way == EXCEPTION for other in same if not other.differences}
    wrong = {other.way == EXCEPTION for other in same if other.differences}
    return well == {False} and wrong == {True}


def _carried_by(runtime: ObservedRuntime, call: MethodCall) -> Iterator[Carried]:
    interactions = runtime.interactions
    method = method_of(runtime, call)
    if method is None:
        return
    for delivery in call.deliveries:
        if delivery.fit in ("same", "altered") and not _is_of_another(interactions, call, delivery):
            ways = [MESSAGE if call.is_message else f"{p.direction} argument" for p in method.arguments]
            sent, got, events = call.request.arguments, delivery.enter.arguments, (call.request.n, delivery.enter.n)
            yield from _paired(interactions, call, method.arguments, ways, sent, got, events)
    if not call.is_message and len(call.deliveries) == 1:
        yield from _brought_back(interactions, method, call, call.deliveries[0])


def _brought_back(
    interactions: Interactions, method: Method, call: MethodCall, delivery: Delivery
) -> Iterator[Carried]:
    """What the server gave and the client got: results, or the fields of a declared exception."""
    gave, got = delivery.exit, call.reply
    if gave is None or got is None or gave.n > got.n or gave.raised or got.raised or gave.exception != got.exception:
        return
    if _is_result_of_another(interactions, call, delivery):
        return
    events = (gave.n, got.n)
    if gave.exception is None:
        ways = [f"{p.direction} result" for p in method.results]
        yield from _paired(interactions, call, method.results, ways, gave.results, got.results, events)
    for exception in method.raises:
        if exception.name == gave.exception:
            fields = [Parameter(name, "OUT", of) for name, of in exception.fields.items()]
            yield from _paired(interactions, call, fields, [EXCEPTION] * len(fields), gave.results, got.results, events)


def _paired(
    interactions: Interactions,
    call: MethodCall,
    parameters: Sequence[Parameter],
    ways: Sequence[str],
    sent: Sequence[Datum] | None,
    got: Sequence[Datum] | None,
    events: tuple[int, ...],
) -> Iterator[Carried]:
    """Value by value; that they are another number of values is not a matter of their types."""
    if sent is None or got is None or not len(parameters) == len(sent) == len(got):
        return
    doubtful = list(sent) != list(got) and (_are_displaced(call, sent, got) or _meets_others(interactions, call))
    for parameter, way, value, arrived in zip(parameters, ways, sent, got, strict=True):
        if not misfit(parameter.of, value):
            is_same = type(arrived) is type(value) is not list and arrived == value  # most are
            different = () if is_same else tuple(differences(Part(parameter.of, value), arrived))
            yield Carried(call, parameter.of, value, arrived, way, events, different, doubtful)


def _meets_others(interactions: Interactions, call: MethodCall) -> bool:
    """Was a service called again before this call came back, or held?"""
    if call.is_message:
        return False
    return any(delivery.was_held for delivery in call.deliveries) or any(
        other is not call and other.link is call.link and other.request.n < call.over and other.over > call.request.n
        for other in interactions.calls
    )


def _are_displaced(call: MethodCall, sent: Sequence[Datum], got: Sequence[Datum]) -> bool:
    """Does every value that is not the one sent stand elsewhere among those of this call?"""
    known = [*sent, *(call.request.arguments or ())]
    wrong = [arrived for value, arrived in zip(sent, got, strict=True) if arrived != value]
    return bool(wrong) and all(arrived and arrived in known for arrived in wrong)


def _is_of_another(interactions: Interactions, call: MethodCall, delivery: Delivery) -> bool:
    """Did the values of another client's call arrive in place of this one's, or what their owner wrote over them?"""
    if delivery.fit == "same":
        return False
    if call.is_message and _is_overwritten(interactions, delivery):
        return True
    return any(
        other.request.arguments == delivery.enter.arguments and other.request.method == call.request.method
        for other in interactions.calls
        if other.link is call.link and other.caller is not call.caller
    )


def _is_overwritten(interactions: Interactions, delivery: Delivery) -> bool:
    """Is it what the owner of a message on this link may have made of it?"""
    got = list(delivery.enter.arguments or ())
    return any(got in overwritten(c.request.arguments or ()) for c in interactions.calls if c.link is delivery.link)


def overwritten(values: Sequence[Datum]) -> list[list[Datum]]:
    """The contents that a buffer may have after its owners have overwritten it."""
    found: list[list[Datum]] = []
    now = list(values)
    for _ in range(_OVERWRITTEN_BY):
        now = [_other(value) for value in now]
        found.append(now)
    return found


def _other(value: Datum) -> Datum:
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return int(value == 0)
    return f"{value}?" if isinstance(value, str) else [*map(_other, value), 0]


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
