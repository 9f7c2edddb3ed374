"""Properties about types: what a framework hands to bodies, and brings back from them, is of the type of the interface.

Whether a value of the right type is the right value is the matter of other properties, which leave these alone.
"""

from __future__ import annotations

from ucm_cts.adapters.contract.trace import Enter, Reply, Return, Siblings
from ucm_cts.reference_models.conclusions import Concluded
from ucm_cts.reference_models.model.callback_history import Callback
from ucm_cts.reference_models.model.executions import BusinessCall, behind_call
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import Ongoing, Result
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.properties.declaration import Property, property_at

_METHODS, _COMPONENTS, _FRAGMENTS = "R-11.2.1.1-02", "R-11.1.3-01", "R-11.1.2-02"
_CONNECTED, _DISCONNECTED, _DEPENDENCIES = "R-11.2.1.3-04", "R-11.2.1.3-06", "R-11.2.1.2-09"
_CODES, _PUSHED = "R-10.1.2-02", "R-10.1.6.1-06"
_RESULTS = "R-10.1.5.1-08"

_OF_CALLBACKS = {"on_connect": _CONNECTED, "on_disconnect": _DISCONNECTED, "on_startup": _DEPENDENCIES}
_DUE = {
    "on_connect": "the name of a port element",
    "on_disconnect": "the name of a port element",
    "on_startup": "a list of names, each with a list of references",
}


@property_at("entered", *_OF_CALLBACKS.values(), at=tuple(_OF_CALLBACKS))
def typed_callbacks(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """Callbacks are given arguments of the types that 12.10 declares."""
    event = callback.event
    if not event.wrong:
        return ()
    return check.fail(
        f"{event.hook} with another type",
        expected=f"{event.hook} of {lane(*event.body)} is given {_DUE[event.hook]}",
        observed=f"it was given {event.wrong}",
        during=(callback.ongoing, event),
        requirement=_OF_CALLBACKS[event.hook],
    )


@property_at("called", _METHODS, _COMPONENTS, _FRAGMENTS)
def typed_calls(
    check: Property, runtime: ObservedRuntime, ongoing: Ongoing, event: Enter, call: BusinessCall | None
) -> Concluded:
    """A business method is called with values of its types."""
    if not event.wrong:
        return ()
    by_test = call is None or call.request is None
    return check.fail(
        "argument of another type",
        expected=f"{lane(*event.body)} is called at {event.port} with the integer that was sent",
        observed=f"it was called with {event.wrong}",
        during=(ongoing, event),
        requirement=_METHODS if by_test else _between(runtime, call),
    )


@property_at("delivered", _PUSHED, _RESULTS, _METHODS)
def typed_deliveries(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Concluded:
    """A method is called with values of the types of its parameters."""
    enter, link = delivery.enter, delivery.link
    if not enter.wrong:
        return ()
    is_message = delivery.call.is_message if delivery.call is not None else enter.method == "push"
    return check.fail(
        "arguments of another type",
        expected=f"{enter.method} of {lane(*enter.body)} is called at {enter.port} with values of its parameters",
        observed=f"it was called with {enter.wrong}",
        at=(enter.n,),
        requirement=_METHODS if link is None else _PUSHED if is_message else _RESULTS,
    )


@property_at("replied", _COMPONENTS, _FRAGMENTS)
def typed_replies(check: Property, runtime: ObservedRuntime, call: BusinessCall, reply: Reply) -> Concluded:
    """A call between components brings an integer back."""
    if not reply.wrong:
        return ()
    return check.fail(
        "result of another type",
        expected=f"the call of {lane(*reply.body)} through {reply.port} brings back an integer",
        observed=f"it brought back {reply.wrong}",
        at=(call.n, reply.n),
        requirement=_between(runtime, call),
    )


@property_at("completed", _CODES, _RESULTS, _METHODS)
def typed_results(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """The call of a method brings back values of its types."""
    request, reply = call.request, call.reply
    if reply is None or not reply.wrong:
        return ()
    return check.fail(
        "results of another type",
        expected=f"{request.method} of {lane(*request.body)} through {request.port} brings back a list of values",
        observed=f"it brought back {reply.wrong}",
        at=(request.n, reply.n),
        requirement=_CODES if call.is_message else _RESULTS if call.link is not None else _METHODS,
    )


@property_at("answered", _METHODS)
def typed_answers(check: Property, runtime: ObservedRuntime, call: BusinessCall, end: Result) -> Concluded:
    """A call through a reference gives an integer."""
    if not isinstance(end, Return) or not end.wrong:
        return ()
    who = call.callee.lane if call.callee is not None else "a body"
    return check.fail(
        "result of another type",
        expected=f"exchange({call.value}) through the reference to {who} gives an integer",
        observed=f"it gave {end.wrong}",
        at=(call.n, end.n),
        step=end.step,
    )


@property_at("noted", "R-11.2.1.4-03")
def typed_listing(check: Property, runtime: ObservedRuntime, ongoing: Ongoing, event: Siblings) -> Concluded:
    """A fragment that asks for the members gets a list of integers."""
    if not event.wrong:
        return ()
    return check.fail(
        "listing of another type",
        expected=f"get_components gives {lane(*event.body)} a list of identifiers",
        observed=f"it gave {event.wrong}",
        at=(event.n,),
    )


def _between(runtime: ObservedRuntime, call: BusinessCall | None) -> str:
    """The requirement about the call of a component: to other components, or to fragments only."""
    request = call.request if call is not None else None
    is_of_fragments = call is not None and request is not None and behind_call(runtime, call, request).fragments
    return _FRAGMENTS if is_of_fragments else _COMPONENTS
