"""Properties about business calls: through references, between components, and in which phase (11.1.3, 11.2.1.1, 11.2.3)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.trace import Enter, Raise, Reply
from ucm_cts.reference_models.conclusions import Concluded, Conclusions
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.designation import error_name
from ucm_cts.reference_models.model.execution_policies import call_guarantees, extended_policy, protection_of
from ucm_cts.reference_models.model.executions import BusinessCall, behind_call, connections_behind
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import Ongoing, OperationInProgress, Result
from ucm_cts.reference_models.model.runtime import Member, lane
from ucm_cts.reference_models.properties.declaration import Property, property_at

_METHODS, _OPERATIONAL, _OWN_ELEMENT = "R-11.2.1.1-02", "R-11.2.1.2-07", "R-11.2.2.1-06"
_DISABLED, _NOT_RUN, _DESTROYED = "R-11.2.3-02", "R-11.2.3-17", "R-11.2.2.2-06"


def is_mistyped(call: BusinessCall, end: Result | Reply) -> bool:
    """Did it come to a body, or back, with something of another type?"""
    return (not isinstance(end, Raise) and bool(end.wrong)) or any(enter.wrong for enter, _ in call.entries)


@property_at("answered", _METHODS, _OPERATIONAL, _OWN_ELEMENT)
def stimulus(check: Property, runtime: ObservedRuntime, call: BusinessCall, end: Result) -> Conclusions:
    """A call through a reference enters an operational body once, with the value sent, and returns its result."""
    member, port = call.callee, call.port
    if is_mistyped(call, end):
        return
    if member is None or not call.possible or not member.serving or member.raises("exchange"):
        return
    if port is not None and call_guarantees(member.declaration, port):
        return  # its execution policy's matter
    if isinstance(end, Raise) and extended_policy(member.declaration) is not None:
        return  # so it is where calls may be refused that come early
    component, instance = member.body
    own = call.entries
    if len(own) != 1 or own[0][0].instance != instance or own[0][0].component != component:
        own = [(e, x) for e, x in own if e.instance == instance and e.component == component]
    if not own and isinstance(end, Raise) and runtime.is_being_ended(member):
        return  # a component that is being stopped serves no call
    if not own or isinstance(end, Raise):
        expected = f"exchange({call.value}) runs {member.lane}'s body and returns its result"
        observed = (
            f"it raised {error_name(end.error)} {end.detail}".rstrip()
            if isinstance(end, Raise)
            else "the body was not entered"
        )
        yield _violate(check, _OPERATIONAL, "not served", expected, observed, call.n, end.n, member)
        return
    enter, exit_ = own[0]
    result = exit_.value if exit_ is not None else None
    if enter.port == port and enter.value == call.value and exit_ and end.value == result and len(own) == 1:
        yield check.kept(_OPERATIONAL)
        yield check.kept()
        yield check.kept(_OWN_ELEMENT)
        return
    yield check.kept(_OPERATIONAL)
    if enter.port != port:
        observed = f"it ran {member.lane}'s {enter.port}"
        expected = f"the reference that get_port_element gave for {port} runs {member.lane}'s {port}"
        yield _violate(check, _OWN_ELEMENT, "another port", expected, observed, call.n, end.n, member)
        return
    observed = (
        f"the body received {printed(enter.value)}, returned {printed(result)}, the caller got {printed(end.value)}"
    )
    if exit_ is None:
        observed = f"the caller got {printed(end.value)} before the body had returned"
    if len(own) > 1:
        observed = f"the body was entered {len(own)} times"
    expected = f"exchange({call.value}) runs {member.lane}'s body and returns its result"
    yield _violate(check, _METHODS, "wrong value", expected, observed, call.n, end.n, member)


@property_at("replied", "R-11.1.3-01", "R-11.1.2-02")
def peer_calls(check: Property, runtime: ObservedRuntime, call: BusinessCall, reply: Reply) -> Concluded:
    """A call through a connection enters a connected body with the value sent; its result comes back."""
    request = call.request
    if request is None or reply.raised or is_mistyped(call, reply):
        return ()
    providers, fragments, targets = behind_call(runtime, call, request)
    if not providers:
        return ()
    of_components, of_fragments = check.stands_for
    requirement = of_fragments if fragments else of_components
    wanted = call.value
    if len(call.entries) == 1:  # the common case: it reached one body, the right one
        enter, exit_ = call.entries[0]
        came_to = enter.component, enter.instance, enter.port
        if enter.value == wanted and came_to in targets and exit_ is not None and exit_.value == reply.value:
            return check.kept(requirement)
    reached = [(e, x) for e, x in call.entries if e.value == wanted and (e.component, e.instance, e.port) in targets]
    came_back = [x for _, x in reached if x is not None and x.value == reply.value]
    if len(reached) == 1 and came_back:
        return check.kept(requirement)
    if len(reached) == 1 and reached[0][1] is None and not all(provider.serving for provider in providers):
        return ()  # what becomes of a call in progress at stop is open (stop-inflight)
    names = " or ".join(sorted(p.lane for p in providers))
    expected = f"{reply.component}'s call of {reply.port} with {call.value} reaches {names} and brings back its result"
    if not reached:
        where = ", ".join(f"{lane(*e.body)} with {e.value}" for e, _ in call.entries) or "no body"
        observed = f"it reached {where}"
    elif not came_back:
        left = reached[0][1]
        got, gave = printed(reply.value), printed(left.value if left is not None else None)
        observed = f"the body returned {gave}, the caller got {got}"
        if left is None:
            observed = f"the caller got {got} before the body had returned"
    else:
        observed = f"it was carried out {len(reached)} times"
    cause = "target" if not reached else "result"
    return _violate(check, requirement, cause, expected, observed, call.n, reply.n, providers[0])


@property_at("replied", "R-11.2.3-03")
def interactions(check: Property, runtime: ObservedRuntime, call: BusinessCall, reply: Reply) -> Concluded:
    """In the operational phase a call between two components comes back."""
    request = call.request
    if not call.possible or request is None or reply.wrong:
        return ()
    caller = runtime.bodies.get(reply.body)
    if caller is None or not caller.serving:
        return ()
    providers = behind_call(runtime, call, request).providers
    if not providers:
        return ()
    for provider in providers:
        if not provider.serving or (provider.declaration.plan and provider.raises("exchange")):
            return ()
        if extended_policy(provider.declaration) is not None:
            return ()
    if not reply.raised:
        return check.kept()
    if any(_is_in_a_circle(call, caller, provider) for provider in providers):
        return ()  # what becomes of calls that come back to a component that may be protected is open (protected-recursion)
    handed_over = [c for c in connections_behind(caller, request.port) if c in (caller.handed_over or ())]
    if not handed_over or any(connection.live is not True for connection in handed_over):
        return ()  # the body calls through what it got at its start, and that connection has been undone
    expected = f"{caller.lane} and {providers[0].lane} are ready, so the call comes back"
    return _violate(check, check.stands_for[0], "refused", expected, "the call raised", call.n, reply.n, providers[0])


def _is_in_a_circle(call: BusinessCall, caller: Member, provider: Member) -> bool:
    """Does the call come back to a component that waits for it, or may it, where it is not known who waits?"""
    if protection_of(provider.declaration) == "unprotected":
        return False
    return call.leads_back_to(provider) if call.caller is not None else _reaches(provider, caller)


def _reaches(client: Member, goal: Member) -> bool:
    """Do calls that bodies make when they are called lead from ``client`` to ``goal``?"""
    known, waiting = {id(client)}, [client]
    while waiting:
        member = waiting.pop()
        if member is goal:
            return True
        called = {a.port for a in member.declaration.plan.get("exchange", ()) if isinstance(a, s.CallPort)}
        for connection in member.connections:
            provider = connection.provider
            if provider is None or connection.live is False or connection.port not in called:
                continue
            if id(provider) not in known:
                known.add(id(provider))
                waiting.append(provider)
    return False


@property_at("called", _DISABLED, at=("body", "framework"))
def disabled_ports(
    check: Property, runtime: ObservedRuntime, ongoing: Ongoing, event: Enter, call: BusinessCall | None
) -> Concluded:
    """Before start was called on its container, no component is called by another one or by the framework."""
    member = runtime.bodies.get(event.body)
    if member is None:
        return _called_while_added(check, ongoing, event, call)
    if member.startups and not member.operational:
        return ()
    container = member.container
    starting = ongoing is not None and ongoing.operation == "start"
    if container.started is not False or starting:
        if call is not None and call.caller_hook == "on_startup":
            return check.kept()
        return ()
    if member.suspended and not (call is not None and call.request is not None):
        return ()
    caller = call.request.component if call is not None and call.request is not None else "the framework"
    if call is not None and call.request is not None:
        other = runtime.bodies.get(call.request.body)
        if other is not None and other.container is not container and other.container.started is not False:
            return ()
        if call.request.body in runtime.startups and ongoing is None:
            return ()  # it has kept the reference that a failed start gave it
    return check.fail(
        "called before start",
        expected=f"{member.lane} is not called before its container {container.name} is started",
        observed=f"{caller} called {member.lane}'s {event.port} during configuration",
        during=(ongoing, event),
        instead=(Arrow("test", container.name, "start"), Arrow(caller, member.lane, "exchange")),
    )


@property_at("replied", _DISABLED)
def refused_ports(check: Property, runtime: ObservedRuntime, call: BusinessCall, reply: Reply) -> Concluded:
    """A call that a component makes in on_startup may be refused: ports were closed until then, too."""
    if call.caller_hook == "on_startup" and reply.raised and not call.entries:
        return check.kept()
    return ()


def _called_while_added(check: Property, ongoing: Ongoing, event: Enter, call: BusinessCall | None) -> Concluded:
    """The body is one that add_component is just making, in a container that is not started."""
    step = ongoing.step if ongoing is not None else None
    if ongoing is None or not isinstance(step, s.AddComponent) or step.component != event.component:
        return ()
    if ongoing.container.started is not False:
        return ()
    who = lane(*event.body)
    caller = call.request.component if call is not None and call.request is not None else "the framework"
    return check.fail(
        "called while added",
        expected=f"{who} is not called before its container {ongoing.container.name} is started",
        observed=f"{caller} called {who}'s {event.port} during add_component",
        during=(ongoing, event),
        instead=(Arrow("test", ongoing.container.name, "start"), Arrow(caller, who, "exchange")),
    )


@property_at("called", _NOT_RUN, _DESTROYED, at=("framework",))
def nothing_after_stop(
    check: Property, runtime: ObservedRuntime, ongoing: Ongoing, event: Enter, call: BusinessCall | None
) -> Concluded:
    """After stop or destroy returned, no business method begins but those that are called."""
    member = runtime.bodies.get(event.body)
    if member is None or member.suspended or member.operational or not member.startups:
        return ()
    if ongoing is not None and ongoing.operation in ("start", "stop", "add_component"):
        return ()
    ended = "removed with its runtime" if runtime.destroyed else "stopped"
    return check.fail(
        "called after destroy" if runtime.destroyed else "called after stop",
        expected=f"{member.lane} was {ended}, so nothing is run on it",
        observed=f"the framework called {member.lane}'s {event.port} with {event.value}",
        during=(ongoing, event),
        requirement=_DESTROYED if runtime.destroyed else _NOT_RUN,
    )


@property_at("ended", _NOT_RUN, at=("get_components", "get_port_element"))
def quiet_after_stop(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """Counts what nothing_after_stop watched: queries of a container stopped after it had served calls."""
    if ongoing.container.started is not False:
        return ()
    if any(not member.suspended for member in ongoing.container.served):
        return check.kept()
    return ()


def _violate(
    check: Property, requirement: str, cause: str, expected: str, observed: str, begin: int, end: int, member: Member
) -> Finding:
    return check.fail(
        cause,
        expected=expected,
        observed=observed,
        at=(begin, end),
        instead=(Arrow("caller", member.lane, "exchange"), Arrow(member.lane, "caller", "result")),
        requirement=requirement,
    )
