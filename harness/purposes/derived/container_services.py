"""Scenarios of the trace (10.1.4.2): texts and severities of messages, and port traces on every side of a call.

A client calls its server when the test calls it; what was traced is read back afterwards. Records that come later than those
waited for are looked for again after a pause.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Integer, Interface, Method, message_interface
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.connections import MESSAGE, SERVICE, provided_end, required_end
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
_NUMBERS = message_interface(Integer("ULONG"))


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
    through_connectors: bool = False

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
            steps += [s.AddComponent(server, place), *self._connected(port, server, place)]
        containers = [*self.places.values(), s.MANAGER]
        steps += [s.GetPortElement("client", "in.api", "api"), *map(s.Start, containers), s.Invoke("api", 1), *reading]
        return Scenario(components, (*steps, *map(s.Stop, reversed(containers))), interfaces={"calls": _CALLS})

    def _connected(self, port: str, server: str, place: str) -> list[Step]:
        if self.through_connectors:
            link = f"link of {port}"
            return [
                s.Link(SERVICE, "calls", link),
                provided_end(SERVICE, link, server, container=place),
                required_end(SERVICE, link, "client", port),
            ]
        goal = f"goal of {port}"
        to_goal = s.Connect("client", port, goal, f"connection of {port}")
        return [s.GetPortElement(server, "in.api", goal, place), to_goal]


_ONE = {"out.api": "server"}
_THREE_CALLS = (("out.api", "beta"), ("out.api", "alpha"), ("out.api", "alpha"))
_RECORDED = ("R-10.1.4.2-04", "R-10.1.4.2-32", "R-10.1.4.2-33", "R-10.1.4.2-35")
_ON_PORTS = ("port-trace-parameters=both", "port-trace-applicability=onPort|onBoth")
_ON_COMPONENTS = ("port-trace-parameters=both", "port-trace-applicability=onComponent|onBoth")


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
        _purpose(
            "port trace/all of it",
            "Who reads the log waits for more records than there will be.",
            _RECORDED,
            _both_ends().scenario(s.ReadLog(4 * 2 + 1)),
            under=_ON_PORTS,
        ),
        _purpose(
            "port trace/other ports",
            "One of two servers is traced, and the other one is called, too.",
            ("R-10.1.4.2-33", "R-10.1.4.2-32"),
            _other_ports(),
            under=_ON_PORTS,
        ),
        _purpose(
            "port trace/nothing to trace",
            "After what is traced has been read, only a method is called that is not.",
            ("R-10.1.4.2-33",),
            _nothing_to_trace(),
            under=_ON_PORTS,
        ),
        _purpose(
            "port trace/after a restart",
            "A method is traced, and traced again when all have been stopped and started again.",
            _RECORDED,
            _restarted(),
            under=_ON_PORTS,
        ),
        _purpose(
            "port trace/through a connector",
            "A method that is called through a connector is traced at both ends.",
            _RECORDED,
            replace(_both_ends(), through_connectors=True).scenario(*_read(4)),
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
        _purpose(
            "port trace/several methods",
            "Two of three methods are traced.",
            _RECORDED,
            _Configuration(
                [("out.api", method) for method in ("alpha", "beta", "gamma", "alpha")],
                _ONE,
                {"server": (_trace("in.api", "alpha,gamma", "info"),)},
            ).scenario(*_read(3)),
            under=(*_ON_PORTS, "methods-to-trace=list"),
        ),
        _purpose(
            "port trace/of a component",
            "All ports of a component are traced by one policy.",
            _RECORDED,
            _Configuration(_THREE_CALLS, _ONE, {"server": (_trace(None, "alpha", "error"),)}).scenario(*_read(2)),
            under=_ON_COMPONENTS,
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
            "port trace/messages",
            "Messages are traced where they are pushed and where they arrive.",
            ("R-10.1.4.2-04", "R-10.1.4.2-32"),
            _messages(),
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


def _restarted() -> Scenario:
    first = _both_ends().scenario(*_read(4))
    again: tuple[Step, ...] = (s.Start(), s.Invoke("api", 2), *_read(8), s.Stop())
    return msgspec.structs.replace(first, steps=(*first.steps, *again))


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


def _other_ports() -> Scenario:
    calls = [("out.api", "alpha"), *[("aux.api", "alpha")] * 3]
    servers = {"out.api": "server", "aux.api": "other"}
    return _Configuration(calls, servers, {"server": (_trace("in.api", "alpha", "info"),)}).scenario(*_read(1))


def _nothing_to_trace() -> Scenario:
    """The client is called once for what is traced, and a second client for what is not."""
    whole = _Configuration([("out.api", "alpha")], _ONE, {"server": (_trace("in.api", "alpha", "info"),)}).scenario()
    calls = (s.CallMethod("out.api", "beta"), s.CallMethod("out.api", "beta"))
    other = Declaration(
        ("in.api",), ("out.api",), plan={"exchange": calls}, policies=(_UNPROTECTED,), ports={"out.api": "calls"}
    )
    first = next(index for index, step in enumerate(whole.steps) if isinstance(step, s.Start))
    added: tuple[Step, ...] = (
        s.AddComponent("other"),
        s.Connect("other", "out.api", "goal of out.api", "connection of other"),
        s.GetPortElement("other", "in.api", "other api"),
    )
    called: tuple[Step, ...] = (*_read(1), s.Invoke("other api", 2), s.Pause(_LATER), s.ReadLog(1))
    steps = (*whole.steps[:first], *added, *whole.steps[first:-1], *called, whole.steps[-1])
    return Scenario(whole.components | {"other": other}, steps, interfaces=whole.interfaces)


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


def _messages() -> Scenario:
    push = _trace("out.api", s.PUSH, "info"), _trace("in.api", s.PUSH, "info")
    calls = tuple(s.CallMethod("out.api", s.PUSH, (number,)) for number in (7, 8))
    components = {
        "emitter": Declaration(
            ("go.api",),
            ("out.api",),
            plan={"exchange": calls},
            policies=(_UNPROTECTED, push[0]),
            ports={"out.api": "n"},
        ),
        "receiver": Declaration(("in.api",), policies=(_UNPROTECTED, push[1]), ports={"in.api": "n"}),
    }
    steps = (
        s.AddComponent("emitter"),
        s.AddComponent("receiver"),
        s.Link(MESSAGE, "n", "link"),
        required_end(MESSAGE, "link", "emitter"),
        provided_end(MESSAGE, "link", "receiver"),
        s.GetPortElement("emitter", "go.api", "api"),
        s.Start(),
        s.Invoke("api", 1),
        *_read(4),
        s.Stop(),
    )
    return Scenario(components, steps, interfaces={"n": _NUMBERS})


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
