"""Scenarios of the trace (10.1.4.2): texts and severities of messages, and port traces on every side of a call.

A client calls its server when the test calls it; what was traced is read back afterwards. Records that come later than those
waited for are looked for again after a pause.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Interface, Method
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.scripts import TestPurpose

_CLAUSE = "10.1.4.2"
_TRACE = "trace.trace_api"
_COMMON = ("debug", "info", "warning", "error")
_UNPROTECTED = Policy(s.UNPROTECTED_PASSIVE)
_LATER = 30
"""Milliseconds. So much later the log is read again."""

_NARROW = (
    "x",
    "simple",
    "sentence with several words, a comma; and (brackets).",
    "percents %s %d %n %% {0} {name} $HOME \\n \\0 \\",
    "markup <b>&amp;</b> 'single' \"double\" `back` #5 ~tilde ^ | @",
    "spaces   between  ",
    "manywords" + " 0123456789abcdef" * 14 + " 56789ab",
)
"""ASCII, the last one of 255 characters."""

_WIDE = (
    "",
    "latinones äöüß éèê ñ ÿ",
    "otherones λόγος журнал 日志 سجل ログ",
    "beyondbmp \U0001d11e \U0001f600 \U00020000 \U0010fffd",
    "oneoveredge" + "." * 245,
    "halfamillionbits" + " lorem ipsum" * 5460,
)
"""Empty; beyond ASCII; beyond the BMP; of 256 and of 65,536 characters."""

_MANY = 250
_NARROW_LIMIT, _LONG = 255, 65_536
assert len(_NARROW[-1]) == _NARROW_LIMIT
assert len(_WIDE[-1]) == _LONG

_CALLS = Interface({"alpha": Method(), "beta": Method(), "gamma": Method(), "alphabet": Method()})


def container_service_purposes() -> list[TestPurpose]:
    """All scenarios; some are only for vendors with certain readings."""
    return [*_message_purposes(), *_port_purposes()]


# messages


def _message_purposes() -> list[TestPurpose]:
    texts = ("R-10.1.4.2-53", "R-10.1.4.2-26", "R-10.1.4.2-25", "R-10.1.4.2-51")
    own = ("R-10.1.4.2-25", "R-10.1.4.2-26", "R-10.1.4.2-51")
    return [
        _purpose("log/narrow texts", "Messages of ASCII characters are written.", texts, _written("info", _NARROW)),
        _purpose(
            "log/wide texts",
            "Messages are written that are empty, long, not ASCII or beyond the Basic Multilingual Plane.",
            ("R-10.1.4.2-47", "R-10.1.4.2-26"),
            _written("warning", _WIDE, more=1),
            under=("log-message=wide-unbounded",),
        ),
        _purpose(
            "log/many records",
            "So many messages are written that a seldom loss shows.",
            ("R-10.1.4.2-26", "R-10.1.4.2-25", "R-10.1.4.2-51"),
            _writing([(_COMMON[number % 4], f"record {number}") for number in range(_MANY)], 0),
        ),
        _purpose(
            "log/severities of the model",
            "Messages are written with the severities that only the model has.",
            own,
            _with_severities("trace", "critical"),
            under=("log-severity-set=model-6",),
        ),
        _purpose(
            "log/severities of IDL",
            "A message is written with the severity that only IDL has.",
            own,
            _with_severities("fatal"),
            under=("log-severity-set=idl-5",),
        ),
    ]


def _written(severity: str, texts: Sequence[str], more: int = 0) -> Scenario:
    """``more`` records are waited for than will come: all have time to show, and nothing else may."""
    return _writing([(severity, text) for text in texts], more)


def _with_severities(*severities: str) -> Scenario:
    return _writing([(severity, f"message of {severity}") for severity in (*severities, *_COMMON)], 0)


def _writing(messages: Sequence[tuple[str, str]], more: int) -> Scenario:
    calls = tuple(s.CallMethod(_TRACE, "log", message) for message in messages)
    policies = (_UNPROTECTED, Policy(s.COMPONENT_TRACE, element=_TRACE))
    writer = Declaration(("in.api",), plan={"exchange": calls}, policies=policies)
    steps = (
        s.AddComponent("writer"),
        s.GetPortElement("writer", "in.api", "api"),
        s.Start(),
        s.Invoke("api", 1),
        *(_read(len(messages)) if not more else (s.ReadLog(len(messages) + more),)),
        s.Stop(),
    )
    return Scenario({"writer": writer}, steps)


# port traces


def _trace(port: str | None, methods: str, severity: str) -> Policy:
    return Policy(s.PORT_TRACE, port, {s.METHODS_TO_TRACE: methods, s.LOG_SEVERITY: severity})


@dataclass
class _Configuration:
    """A client that calls its servers through port elements of their own; ``traces`` are the policies of each component."""

    calls: Sequence[tuple[str, str]]
    servers: Mapping[str, str]
    traces: Mapping[str, tuple[Policy, ...]]
    execution: Policy = _UNPROTECTED
    places: Mapping[str, str] = field(default_factory=dict)

    def scenario(self, *reading: Step) -> Scenario:
        """The client is called; then comes ``reading``."""
        calls = tuple(s.CallMethod(port, method) for port, method in self.calls)
        components = {
            "client": Declaration(
                ("in.api",),
                tuple(self.servers),
                plan={"exchange": calls},
                policies=(_UNPROTECTED, *self.traces.get("client", ())),
                ports=dict.fromkeys(self.servers, "calls"),
            )
        }
        steps: list[Step] = [s.CreateContainer(place) for place in self.places.values()]
        steps.append(s.AddComponent("client"))
        for port, server in self.servers.items():
            place = self.places.get(server, s.MANAGER)
            components[server] = Declaration(
                ("in.api",), ports={"in.api": "calls"}, policies=(self.execution, *self.traces.get(server, ()))
            )
            goal = f"goal of {port}"
            steps += [
                s.AddComponent(server, place),
                s.GetPortElement(server, "in.api", goal, place),
                s.Connect("client", port, goal, f"connection of {port}"),
            ]
        containers = [*self.places.values(), s.MANAGER]
        steps += [s.GetPortElement("client", "in.api", "api"), *map(s.Start, containers), s.Invoke("api", 1), *reading]
        return Scenario(components, (*steps, *map(s.Stop, reversed(containers))), interfaces={"calls": _CALLS})


_ONE = {"out.api": "server"}
_THREE_CALLS = (("out.api", "beta"), ("out.api", "alpha"), ("out.api", "alpha"))
_RECORDED = ("R-10.1.4.2-04", "R-10.1.4.2-32", "R-10.1.4.2-33", "R-10.1.4.2-35")
_ON_PORTS = ("port-trace-parameters=both", "port-trace-applicability=onPort|onBoth")


def _port_purposes() -> list[TestPurpose]:
    return [
        TestPurpose(
            "port trace/sides",
            _CLAUSE,
            "A method is called that is traced where it is called, where it comes in, or at both ends; another one is not.",
            _RECORDED,
            tuple(_sides()),
            under=_ON_PORTS,
        ),
        TestPurpose(
            "port trace/policies",
            _CLAUSE,
            "A method is traced of components that are executed in different ways, and across containers.",
            _RECORDED,
            tuple(_ways_of_execution()),
            under=_ON_PORTS,
        ),
        TestPurpose(
            "port trace/names in names",
            _CLAUSE,
            "The name of a method that is traced begins like that of one that is not, or the other way round.",
            _RECORDED,
            tuple(_names_in_names()),
            under=_ON_PORTS,
        ),
        TestPurpose(
            "several traces",
            _CLAUSE,
            "A component has several trace policies, of both kinds or on several ports.",
            ("R-10.1.4.2-02", "R-10.1.4.2-32"),
            (("several traces/both kinds", _both_kinds()), ("several traces/two ports", _two_ports())),
            under=_ON_PORTS,
        ),
        _purpose(
            "port trace/of the probes' own method",
            "Calls of exchange are traced at both ends, and come back with what was answered.",
            ("R-11.1.3-01", "R-10.1.3.2-21"),
            _own_method(),
            under=_ON_PORTS,
        ),
    ]


def _sides() -> list[tuple[str, Scenario]]:
    scenarios = []
    for severity in _COMMON:
        for side, policies in (
            ("where it comes in", {"server": (_trace("in.api", "alpha", severity),)}),
            ("where it is called", {"client": (_trace("out.api", "alpha", severity),)}),
        ):
            configuration = _Configuration(_THREE_CALLS, _ONE, policies)
            scenarios.append((f"port trace/{severity} {side}", configuration.scenario(*_read(2))))
    return [*scenarios, ("port trace/both ends", _both_ends().scenario(*_read(4)))]


def _both_ends() -> _Configuration:
    both = {"client": (_trace("out.api", "alpha", "info"),), "server": (_trace("in.api", "alpha", "info"),)}
    return _Configuration(_THREE_CALLS, _ONE, both)


def _names_in_names() -> Iterator[tuple[str, Scenario]]:
    calls = [("out.api", method) for method in ("alpha", "alphabet", "alpha", "alphabet")]
    for traced in ("alpha", "alphabet"):
        configuration = _Configuration(calls, _ONE, {"server": (_trace("in.api", traced, "info"),)})
        yield f"port trace/{traced} of alpha and alphabet", configuration.scenario(*_read(2))


def _ways_of_execution() -> list[tuple[str, Scenario]]:
    traces = {"server": (_trace("in.api", "alpha", "warning"),)}
    scenarios = [
        (f"port trace/{name}", _Configuration(_THREE_CALLS, _ONE, traces, execution).scenario(*_read(2)))
        for name, execution in (
            ("protected passive", Policy(s.PROTECTED_PASSIVE)),
            ("active", Policy(s.ACTIVE, "in.api")),
            ("self-executing", Policy(s.SELF_EXECUTING)),
        )
    ]
    elsewhere = _Configuration(_THREE_CALLS, _ONE, traces, places={"server": "elsewhere"})
    return [*scenarios, ("port trace/elsewhere", elsewhere.scenario(*_read(2)))]


def _both_kinds() -> Scenario:
    """The client writes to the trace itself, too."""
    traces = (Policy(s.COMPONENT_TRACE, element=_TRACE), _trace("out.api", "alpha", "warning"))
    whole = _Configuration(_THREE_CALLS, _ONE, {"client": traces}).scenario(*_read(3))
    client = whole.components["client"]
    written = s.CallMethod(_TRACE, "log", ("info", "calling"))
    own = msgspec.structs.replace(client, plan={"exchange": (written, *client.plan["exchange"])})
    return Scenario(whole.components | {"client": own}, whole.steps, interfaces=whole.interfaces)


def _two_ports() -> Scenario:
    calls = [("out.api", "alpha"), *[("aux.api", "beta")] * 2, *[("aux.api", "alpha")] * 2, *[("out.api", "beta")] * 3]
    traces = (_trace("out.api", "alpha", "info"), _trace("aux.api", "beta", "error"))
    return _Configuration(calls, {"out.api": "server", "aux.api": "other"}, {"client": traces}).scenario(*_read(3))


def _own_method() -> Scenario:
    """The log entries about it are not compared: adapters need not know its name."""
    client = Declaration(
        ("in.api",),
        ("out.api",),
        plan={"exchange": (s.CallPort("out.api", 5),)},
        policies=(_UNPROTECTED, _trace("out.api", "exchange", "info")),
    )
    server = Declaration(("in.api",), policies=(_UNPROTECTED, _trace("in.api", "exchange", "info")))
    steps = (
        s.AddComponent("client"),
        s.AddComponent("server"),
        s.GetPortElement("server", "in.api", "goal"),
        s.Connect("client", "out.api", "goal", "connection"),
        s.GetPortElement("client", "in.api", "api"),
        s.Start(),
        s.Invoke("api", 1),
        s.Invoke("goal", 2),
        s.Stop(),
    )
    return Scenario({"client": client, "server": server}, steps)


def _read(records: int) -> tuple[Step, ...]:
    return s.ReadLog(records), s.Pause(_LATER), s.ReadLog(records)


def _purpose(
    name: str, text: str, requirements: tuple[str, ...], scenario: Scenario, under: tuple[str, ...] = ()
) -> TestPurpose:
    return TestPurpose(name, _CLAUSE, text, requirements, ((name, scenario),), under=under)
