"""Properties about the trace service: references, log, and what is in the log when it is read back (10.1.4)."""

from __future__ import annotations

from collections.abc import Generator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Taken, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model import log_contents as logs
from ucm_cts.reference_models.model.callback_history import Callback
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.runtime import has_meaningless_values, lane
from ucm_cts.reference_models.model.service_policies import (
    TRACES,
    has_several_clocks,
    only_service,
    policies_of,
    policy_elements,
)
from ucm_cts.reference_models.properties.declaration import Property, property_at

_WRITTEN, _LONG_TEXTS, _TEXTS = "R-10.1.4.2-26", "R-10.1.4.2-47", "R-10.1.4.2-53"
_PORT_TRACE, _NAMED_METHODS = "R-10.1.4.2-04", "R-10.1.4.2-32"

_REFERENCES = {
    s.CLOCK: "R-10.1.4.1-06",
    s.COMPONENT_TRACE: "R-10.1.4.2-03",
    s.INDEX_TIMERS: "R-10.3.2-23",
    s.OBJECT_TIMERS: "R-10.3.1-17",
}
_SEVERAL = "R-10.1.4.2-02"
_SEVERAL_TIMERS = {s.INDEX_TIMERS: "R-10.3-09", s.OBJECT_TIMERS: "R-10.3-10"}
_TOO_MANY = "too many"
_SHOWN = 60


@property_at(
    "entered", *_REFERENCES.values(), _SEVERAL, *_SEVERAL_TIMERS.values(), at=("on_startup",), feature="policies"
)
def policy_references(check: Property, runtime: ObservedRuntime, callback: Callback) -> Conclusions:
    """on_startup hands over a reference for each port element that a component requires by its policies, at every start."""
    event, member, ongoing, _ = callback
    if member is None or has_several_clocks(member.declaration) or member.operational:
        return
    elements = policy_elements(member.declaration, *_REFERENCES)
    given = {d.port for d in event.dependencies or () if any(r is not None for r in d.references)}
    for element, definition in elements.items():
        if element in given:
            if definition == s.COMPONENT_TRACE:
                yield check.kept(_REFERENCES[definition])
            continue
        others = [e for e, d in elements.items() if d == definition and e in given]
        named = any(dependency.port == element for dependency in event.dependencies or ())
        of_several = _SEVERAL_TIMERS.get(definition, _SEVERAL)
        yield check.fail(
            f"{definition} {'null' if named else 'missing'}",
            expected=f"on_startup of '{member.lane}' hands over a reference for {element}, which its {definition} provides",
            observed=f"it handed over {'a null reference' if named else 'none of that name'}",
            during=(ongoing, event),
            requirement=of_several if others else _REFERENCES[definition],
        )


@property_at("completed", "R-10.1.4.2-25")
def log_returns(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """A call of log comes back, whichever severity it has, from on_startup to on_shutdown."""
    request, reply, caller = call.request, call.reply, call.caller
    if reply is None or caller is None or caller.suspended or request.method != "log":
        return ()
    if request.port not in policy_elements(caller.declaration, s.COMPONENT_TRACE) or not request.arguments:
        return ()
    severity, text = str(request.arguments[0]), str(request.arguments[-1])
    if not logs.Threshold.declared(runtime.ics).knows(severity) or not _is_sendable(runtime, text):
        return ()
    if not reply.failed:
        return check.kept()
    return check.fail(
        "raises",
        expected=f"log({severity}, {_shown(text)}) of '{caller.lane}' returns",
        observed="it raised" if reply.raised else f"it raised {reply.exception}",
        at=(request.n, reply.n),
    )


@property_at("ended", _SEVERAL, at=("add_component",), feature="policies")
def traces_supported(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """A component may have any number of trace policies."""
    step = ongoing.step
    if not isinstance(step, s.AddComponent) or not isinstance(ongoing.end, Raise):
        return ()
    declaration = runtime.scenario.components.get(step.component)
    if declaration is None or ongoing.container.started is not False:
        return ()
    if only_service(declaration, *TRACES) and not has_meaningless_values(declaration, step):
        names = ", ".join(policy.definition for policy in policies_of(declaration, *TRACES))
        return check.refused("add_component", ongoing.end, expected=f"a component with the policies {names} is added")
    return ()


@property_at("read", _WRITTEN, _LONG_TEXTS, _SEVERAL, timed=True)
def log_recorded(check: Property, runtime: ObservedRuntime, contents: logs.Contents) -> Conclusions:
    """Each call of log leaves one record, from the declared threshold on and none below it."""
    for message in contents.missing:
        requirement = _WRITTEN if message.is_narrow else _LONG_TEXTS
        expected = f"a record of log({message.severity}, {_shown(message.text)})"
        yield _violated(check, runtime, contents, message, requirement, "none", expected, "there was none")
    for message, record in contents.surplus:
        observed = f"there was another one: {record.severity} {_shown(record.message)}"
        expected = f"one record of log({message.severity}, {_shown(message.text)})"
        yield _violated(check, runtime, contents, message, _WRITTEN, "more than one", expected, observed)
    for message in (m for m in contents.messages if m.barred and m.record is not None):
        yield check.fail(
            "threshold",
            expected=f"no record below the threshold {runtime.ics.reading('log-threshold')}",
            observed=f"there was one of log({message.severity}, {_shown(message.text)})",
            at=contents.events_of(message),
            step=contents.step,
        )
    if any(m.due and m.record for m in contents.messages) and not (contents.missing or contents.surplus):
        yield check.kept()


@property_at("read", _LONG_TEXTS, _TEXTS)
def log_text(check: Property, runtime: ObservedRuntime, contents: logs.Contents) -> Conclusions:
    """A record has the text that log was called with."""
    for message in (m for m in contents.messages if m.due):
        requirement = _TEXTS if message.is_narrow else _LONG_TEXTS
        if message.record is not None:
            yield check.kept(requirement)
        elif message.altered is not None:
            yield check.fail(
                "altered",
                expected=f"a record with the text {_shown(message.text)}, {len(message.text)} characters",
                observed=f"its text is {_shown(message.altered.message)}, {len(message.altered.message)} characters",
                at=contents.events_of(message),
                step=contents.step,
                requirement=requirement,
            )


@property_at("read", "R-10.1.4.2-51")
def log_severity_kept(check: Property, runtime: ObservedRuntime, contents: logs.Contents) -> Conclusions:
    """A record has the severity that log was called with."""
    for message in (m for m in contents.messages if m.due):
        record = message.record or message.altered
        if record is None:
            continue
        if record.severity == message.severity:
            yield check.kept()
            continue
        yield check.fail(
            message.severity,
            expected=f"the record of log({message.severity}, {_shown(message.text)}) has this severity",
            observed=f"it has severity {record.severity}",
            at=contents.events_of(message),
            step=contents.step,
        )


@property_at("read", _PORT_TRACE, _NAMED_METHODS, timed=True)
def port_trace_recorded(check: Property, runtime: ObservedRuntime, contents: logs.Contents) -> Conclusions:
    """Each call of a method that methods_to_trace names has one record with the method's name, or one for each way."""
    for tracing in contents.tracings.values():
        if not tracing.is_traced:
            continue
        problem = yield from _number_problem(runtime, contents, tracing)
        if problem == _TOO_MANY and _may_be_of_others(tracing):
            continue  # another property's matter
        if problem:
            yield _wrong_number(check, contents, tracing, problem)
        elif tracing.due and len(tracing.records) >= tracing.due:
            yield check.kept()
            if tracing.severities:
                yield check.kept(_NAMED_METHODS)


def _number_problem(
    runtime: ObservedRuntime, contents: logs.Contents, tracing: logs.Tracing
) -> Generator[Taken, None, str]:
    """What is wrong with the number of records; empty if nothing is, or more may come."""
    found, due, possible = len(tracing.records), tracing.due, tracing.due + tracing.possible
    in_vain = contents.reading.in_vain
    if in_vain and found < due:
        return "too few" if found else "none"
    if _has_too_many(runtime, contents, tracing):
        return _TOO_MANY
    if found > 2 * possible:
        return "threshold"
    if found > possible or (in_vain and found == possible > 0):
        for reading in _readings_of_number(found, possible, in_vain):
            if not (yield from takes(runtime, "port-trace-records", reading)):
                return f"{reading}, which is not what is declared"
    return ""


def _readings_of_number(found: int, calls: int, in_vain: bool) -> list[str]:
    """The readings that explain ``found`` records of ``calls``: one port may have one record a call, and another one two."""
    if found <= calls:
        return ["call"]
    return ["call-and-return", "call"] if in_vain and found < 2 * calls else ["call-and-return"]


def _has_too_many(runtime: ObservedRuntime, contents: logs.Contents, tracing: logs.Tracing) -> bool:
    """Are there more records with the method's name than one, or two, for each call that is traced at a port?"""
    found, most = len(tracing.records), tracing.most
    no_more_to_come = contents.reading.in_vain and not tracing.possible
    between = most < found < 2 * most and found - tracing.due not in tracing.pairs
    one_a_call = runtime.ics.reading("port-trace-records") == "call"
    return found > 2 * most or (between and no_more_to_come) or (one_a_call and most < found < 2 * most)


def _may_be_of_others(tracing: logs.Tracing) -> bool:
    """Can records that are too many be of calls that are not traced?"""
    most = 2 * (tracing.most + tracing.others)
    return tracing.others > 0 and (not tracing.is_traced or len(tracing.records) <= most)


def _wrong_number(check: Property, contents: logs.Contents, tracing: logs.Tracing, problem: str) -> Finding:
    beside = [t for t in contents.tracings.values() if t.ports.keys() & tracing.ports.keys()]
    nothing = problem == "none" and not any(t.records for t in beside)
    return check.fail(
        problem,
        expected=f"one record for each of {tracing.due} traced calls of {tracing.method}, or two",
        observed=f"{len(tracing.records)} records contain its name",
        at=contents.events,
        step=contents.step,
        requirement=_PORT_TRACE if nothing or not tracing.severities else _NAMED_METHODS,
    )


@property_at("read", "R-10.1.4.2-33")
def port_trace_selective(check: Property, runtime: ObservedRuntime, contents: logs.Contents) -> Conclusions:
    """Methods that are not named, and ports without port_trace, leave no record."""
    works = any(t.is_traced and t.records for t in contents.tracings.values())
    for tracing in (t for t in contents.tracings.values() if _may_be_of_others(t)):
        if not _has_too_many(runtime, contents, tracing):
            others_show = tracing.others > tracing.due  # with theirs, there would be more than two records a call
            if works and len(tracing.records) <= tracing.due * (1 + others_show):
                yield check.kept()
            continue
        yield check.fail(
            "port" if tracing.is_traced else "method",
            expected=f"records of the {tracing.most} traced calls of {tracing.method}, and of none of the {tracing.others} others",
            observed=f"{len(tracing.records)} records contain its name",
            at=contents.events,
            step=contents.step,
        )
    unexplained = _unexplained(runtime, contents)
    if unexplained:
        yield check.fail(
            "unexplained",
            expected="no record, as only methods were called that are not traced",
            observed=f"{unexplained} new records",
            at=contents.events,
            step=contents.step,
        )


def _unexplained(runtime: ObservedRuntime, contents: logs.Contents) -> int:
    """The number of unexplained records that came while only calls were made that are not traced."""
    interactions = runtime.interactions
    readings = logs.log_readings(runtime)
    if len(readings) < 2:
        return 0
    before, now = readings[-2:]
    between = runtime.scenario.steps[before.end.step + 1 : now.begin.step]
    calls = [c for c in interactions.calls if before.begin.n < c.request.n < now.end.n]
    components = runtime.scenario.components
    written = [c for c in calls if c.request.port in policy_elements(components.get(c.request.component), *TRACES)]
    if not calls or written or any(isinstance(step, s.ContainerCall) for step in between):
        return 0
    earlier = logs.contents_of(before, runtime)
    if sum(t.most for t in contents.tracings.values()) > sum(t.most for t in earlier.tracings.values()):
        return 0
    return max(len(contents.strays) - len(earlier.strays), 0)


@property_at("read", "R-10.1.4.2-35")
def port_trace_severity(check: Property, runtime: ObservedRuntime, contents: logs.Contents) -> Conclusions:
    """Records of a port trace have the severity of its log_severity."""
    for tracing in contents.tracings.values():
        if not tracing.severities or not tracing.records:
            continue
        if _has_too_many(runtime, contents, tracing):
            continue  # it is not known which of them are of traced calls
        if {record.severity for record in tracing.records} <= tracing.severities:
            yield check.kept()
            continue
        yield check.fail(
            " or ".join(sorted(tracing.severities)),
            expected=f"records of calls of {tracing.method} with severity {' or '.join(sorted(tracing.severities))}",
            observed=f"records: {logs.severities_shown(tracing.records)}",
            at=contents.events,
            step=contents.step,
        )


@property_at("read", _SEVERAL)
def several_traces(check: Property, runtime: ObservedRuntime, contents: logs.Contents) -> Concluded:
    """Counts components of which more than one trace policy has been seen to work."""
    if contents.surplus:
        return ()
    working: dict[str, set[str]] = {}
    for message in (m for m in contents.messages if m.due and m.record is not None):
        working.setdefault(message.call.request.component, set()).add(message.call.request.port)
    for tracing in (t for t in contents.tracings.values() if t.due and len(t.records) >= t.due):
        for component, port in tracing.ports:
            working.setdefault(component, set()).add(port)
    if any(len(ways) > 1 for ways in working.values()):
        return check.kept()
    return ()


def _violated(
    check: Property,
    runtime: ObservedRuntime,
    contents: logs.Contents,
    message: logs.Message,
    requirement: str,
    cause: str,
    expected: str,
    observed: str,
) -> Finding:
    """A message has another number of records than one; of a component with several traces this is their matter."""
    request = message.call.request
    declaration = runtime.scenario.components.get(request.component)
    several = len(policies_of(declaration, s.COMPONENT_TRACE)) > 1
    return check.fail(
        f"{cause}, several traces" if several else cause,
        expected=f"{expected} of '{lane(*request.body)}'",
        observed=observed,
        at=(request.n, *contents.events),
        step=contents.step,
        requirement=_SEVERAL if several else requirement,
    )


def _is_sendable(runtime: ObservedRuntime, text: str) -> bool:
    """Is it a message under the declared reading of what a message is?"""
    narrow = text.isascii() and len(text) <= 255
    return narrow or runtime.ics.reading("log-message") != "narrow-255"


def _shown(text: str) -> str:
    shown = text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"
    return f'"{shown}"'
