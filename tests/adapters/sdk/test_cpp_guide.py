"""The guide to C++ adapters: what it shows is what is built and run."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from typing import Any

import msgspec
from cpp_builds import LIFE, PAIR, PROVIDER, Builds, concurrent_scenarios, events, run, talk
from fragment_framework import in_short, served

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.harness.execution.integrity import contradiction


def without_times(answers: Sequence[m.FromHost]) -> list[Any]:
    return [re.sub(rb'"t":\d+', b"", m.encode(answer)) for answer in answers]


def test_guide_for_a_framework_in_the_shape_of_12_10(builds: Builds) -> None:
    runs = [m.Run(n, scenario) for n, scenario in enumerate((s.Scenario(PAIR, LIFE), concurrent_scenarios()[3]))]
    expected, _, _ = talk(builds.reference, *runs)
    answers, _, status = talk(builds.vendor / "acme_adapter", *runs)
    assert status == 0
    assert without_times(answers) == without_times(expected)


def test_other_spellings_of_12_10(builds: Builds) -> None:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {"on_startup": (s.CallPort("r_e", 4), s.QuerySiblings())}
    fragment = s.Declaration(requires=("r_e",), attributes={"a": "1"}, connectable=True, fragment=True, plan=plan)
    scenario = s.Scenario({"P": PROVIDER, "C": fragment}, (*LIFE, s.AddComponent("nobody"), s.RemoveContainer("nil")))
    trace = events(builds.program("spellings"), scenario)
    returned = {e.step: e.value for e in trace if isinstance(e, t.Return)}
    ids = (returned[0], returned[1])
    assert ids == (2**40 + 1, 2**40 + 2), "ids come through as they are: the monitor checks their width"
    assert [e.ids for e in trace if isinstance(e, t.Siblings)] == [ids]
    assert [e.value for e in trace if isinstance(e, t.Reply)] == [~4]
    assert [e.attributes for e in trace if isinstance(e, t.Enter) and e.hook == "on_init"] == [{}, {"a": "1"}]
    assert [e.reference for e in trace if isinstance(e, t.Enter) and e.hook == "on_connect"] == [
        t.Reference("P", 1, "p_e")
    ]
    assert [e.error for e in trace if isinstance(e, t.Raise)] == ["UCM_ERROR", "NOT_FOUND"]


def test_structures_with_accessors(builds: Builds) -> None:
    called = s.Declaration(requires=("r_e",), attributes={"a": "1"}, plan={"on_startup": (s.CallPort("r_e", 4),)})
    scenario = s.Scenario({"P": PROVIDER, "C": called}, LIFE)
    hello, traced = talk(builds.program("accessors"), m.Hello(m.PROTOCOL), m.Run(1, scenario))[0]
    assert isinstance(hello, m.Welcome)
    assert hello.port_element_name == "{element} of {port}"
    assert isinstance(traced, m.Traced), traced
    trace = traced.events
    assert [e.value for e in trace if isinstance(e, t.Reply)] == [~4]
    assert [e.dependencies for e in trace if isinstance(e, t.Enter) and e.hook == "on_startup"] == [
        (),
        (t.Dependency("r_e", (t.Reference("P", 1, "p_e"),)),),
    ]
    assert [e.attributes for e in trace if isinstance(e, t.Enter) and e.hook == "on_init"] == [{}, {"a": "1"}]
    assert [e for e in trace if isinstance(e, t.Raise)] == []


def test_connectors_made_of_fragments(builds: Builds) -> None:
    steps = (
        s.GetComponents(),
        s.Attach("l", "server", "S", "in"),
        s.Detach("l", "C", "out"),
        s.Stop(),
        s.Detach("l", "C", "out"),
        s.Detach("l", "C", "out"),
        s.Link(s.SERVICE_CONNECTOR, "service", "m"),
        s.Attach("m", "client", "C", "out"),
        s.Attach("m", "client", "C", "none"),
        s.Start(),
        s.Invoke("go", 1),
        s.Link(s.MESSAGE_CONNECTOR, "service", "n"),
    )
    trace = events(builds.program("cells"), served(*steps))
    assert in_short(trace) == [((7,), False), 2, "UCM_ERROR", "UCM_ERROR", "NOT_FOUND", (None, True)]
    assert [e.variable for e in trace if isinstance(e, t.Skip)] == ["link"]


def test_policies_and_ids_of_other_frameworks(builds: Builds) -> None:
    asks = s.CallMethod("clock_api", "get_local_time")
    clock = s.Declaration(
        plan={"on_startup": (asks, s.QuerySiblings())}, policies=(s.Policy(s.CLOCK, element="clock_api"),)
    )
    fragment = msgspec.structs.replace(clock, fragment=True, attributes={"a": "1"})
    unknown = (s.RemoveComponent("unknown"), s.GetPortElement("F", "none", "x"), s.Connect("F", "out", "nil", "k"))
    trace = events(builds.program("cells"), s.Scenario({"F": fragment}, (s.AddComponent("F"), s.Start(), *unknown)))
    assert [e.results for e in trace if isinstance(e, t.Reply)] == [([1, 2],)]
    assert [e.ids for e in trace if isinstance(e, t.Siblings)] == [(1,)]
    assert [e.attributes for e in trace if isinstance(e, t.Enter) and e.hook == "on_init"] == [{"a": "1"}]
    assert [e.error for e in trace if isinstance(e, t.Raise)] == ["NOT_FOUND", "NOT_FOUND", "BAD_PARAMETER"]


def test_object_timers_of_other_frameworks(builds: Builds) -> None:
    def call(method: str, *arguments: Datum) -> s.CallMethod:
        return s.CallMethod("scheduler", method, arguments, handler="h")

    def ask(method: str, nth: int = 1, *arguments: Datum) -> s.CallMethod:
        return s.CallMethod("scheduler", method, arguments, on=s.TimerFrom(s.SCHEDULE_ONCE, nth))

    seven = [7, 8]
    given = (call(s.SCHEDULE_ONCE, [1, 2]), call(s.SCHEDULE_ONCE, seven), call(s.SCHEDULE_ONCE, [0, 0]))
    none = (call(s.SCHEDULE_REPEATED, seven, seven, 1), call(s.SCHEDULE_REPEATED, seven, seven, 0))
    refused = (call(s.CANCEL), call(s.SCHEDULE_ONCE))
    asked = (
        ask(s.TIMER_ID, 2),
        ask(s.TIMER_ROUNDS),
        ask(s.IS_CANCELLED),
        ask(s.CANCEL),
        ask(s.TIMER_ID, 1, 1),
        ask("x"),
    )
    actions = (*given, *none, *refused, *asked, ask(s.TIMER_ID, 3), s.CallMethod("scheduler", "x"))
    timed = s.Declaration(
        plan={"on_startup": actions, "method": (s.CallMethod("scheduler", s.TIMER_ID, on=s.TimerFrom(s.ON_TRIGGER)),)},
        policies=(s.Policy(s.OBJECT_TIMERS, element="scheduler"),),
        handlers=("h",),
    )
    scenario = s.Scenario({"T": timed}, (s.AddComponent("T"), s.Start()))
    trace = events(builds.program("cells"), scenario)
    assert contradiction(scenario, trace) is None
    entered = [e for e in trace if isinstance(e, t.Enter) and e.hook == "method"]
    assert [(e.port, e.method) for e in entered] == [("h", s.ON_TRIGGER)] * 3
    assert [(e.arguments, e.timer, e.wrong) for e in entered] == [
        (([1, 2], 2), 1, ""),
        ((seven, 8), 3, ""),
        ((), None, "null as the timer"),
    ]
    requests = [e for e in trace if isinstance(e, t.Request)]
    assert [e.handler for e in requests if e.method == s.SCHEDULE_ONCE] == ["h"] * 4
    assert [(e.method, e.timer) for e in requests if e.timer] == [
        (s.TIMER_ID, 1),
        (s.TIMER_ID, 3),
        *((action.method, 4 if action is asked[0] else 2) for action in asked),
    ]
    replies = [e for e in trace if isinstance(e, t.Reply)]
    assert [(e.results, e.timer, e.exception, e.wrong) for e in replies if not e.raised] == [
        (("other",), None, None, ""),
        ((), 2, None, ""),
        (("same",), None, None, ""),
        ((), 4, None, ""),
        ((), None, None, "null as the timer"),
        ((), None, None, ""),
        ((), None, "no rounds", ""),
        (("same",), None, None, ""),
        ((2**63 - 1,), None, None, ""),
        ((False,), None, None, ""),
    ]
    assert len([e for e in replies if e.raised]) == len((*refused, *asked[3:], "x"))


def test_guide_module(builds: Builds) -> None:
    lines = [m.encode(m.Hello(m.PROTOCOL)), m.encode(m.Run(1, s.Scenario(PAIR, LIFE), stream=True))]
    script = f"""
import acme_adapter
events = []
for line in {lines!r}:
    print(acme_adapter.answer(line, events.append).decode())
runtime = acme_adapter.Runtime([("Clock", ["time_api"], []), ("Display", [], ["time_api"])])
clock, display = runtime.add_component("Clock"), runtime.add_component("Display")
reference = runtime.get_port_element(clock, "time_api")
connection = runtime.connect(display, "time_api", reference)
runtime.start()
assert runtime.exchange(reference, 5) == -6
assert runtime.get_components() == [clock, display]
runtime.stop()
for wrong, error in ((lambda: runtime.remove_component(99), acme_adapter.NotFound),
                     (lambda: runtime.connect(display, "time_api", None), acme_adapter.BadParameter),
                     (lambda: runtime.add_component("Nobody"), acme_adapter.UcmError)):
    try:
        wrong()
    except error:
        continue
    raise AssertionError(error)
runtime.disconnect(connection)
runtime.destroy()
assert acme_adapter.life_cycles(100) > 0
print(len(events))
"""
    done = run([sys.executable, "-c", script], cwd=builds.vendor)
    welcome, traced, streamed = done.stdout.splitlines()
    assert isinstance(m.from_host_decoder().decode(welcome), m.Welcome)
    decoded = m.from_host_decoder().decode(traced)
    assert isinstance(decoded, m.Traced)
    assert len(decoded.events) == int(streamed)


def test_guide_for_any_other_framework(builds: Builds) -> None:
    components = {"P": PROVIDER, "C": s.Declaration(requires=("r_e",), plan={"on_startup": (s.CallPort("r_e", 4),)})}
    trace = events(builds.program("beans"), s.Scenario(components, (*LIFE, s.GetComponents())))
    assert [e.value for e in trace if isinstance(e, t.Reply)] == [~4]
    assert [e.dependencies for e in trace if isinstance(e, t.Enter) and e.component == "C" and e.dependencies] == [
        (t.Dependency("r_e", ("opaque",)),)
    ]
    assert [e.error for e in trace if isinstance(e, t.Raise)] == ["UCM_ERROR"], "only get_components is missing"


def test_guide_for_profile_core(builds: Builds) -> None:
    service = d.Interface({"ask": d.Method()})
    asks = (s.CallMethod("out", "ask", (2**64 - 1, ["ä"])), s.CallMethod("out", "fail"))
    answers = (s.Answer("ask"), s.Answer("fail", ("why",), "problem"))
    components = {
        "C": s.Declaration(("go",), ("out",), plan={"exchange": asks}, ports={"out": "service"}),
        "S": s.Declaration(("in",), plan={"method": answers}, ports={"in": "service"}),
    }
    steps = (
        s.AddComponent("S"),
        s.AddComponent("C"),
        s.GetPortElement("C", "go", "go"),
        s.Link("simple_service_connector", "service", "l"),
        s.Link("simple_message_connector", "service", "nolink"),
        s.Attach("l", "server", "S", "in"),
        s.Attach("l", "server", "S", "in"),
        s.Attach("l", "client", "C", "out"),
        s.Start(),
        s.Invoke("go", 1),
        s.Break("l"),
        s.Invoke("go", 1),
        s.Mend("l"),
        s.Invoke("go", 1),
        s.Stop(),
        s.Detach("l", "C", "out"),
        s.Detach("l", "S", "in"),
        s.ReadLog(),
    )
    trace = events(builds.program("beans"), s.Scenario(components, steps, interfaces={"service": service}))
    reported = [(e.results, e.exception, e.raised) for e in trace if isinstance(e, t.Reply)]
    served = [((2**64 - 1, ["ä"]), None, False), (("why",), "problem", False)]
    assert reported == [*served, (None, None, True), (None, None, True), *served]
    assert [e.variable for e in trace if isinstance(e, t.Skip)] == ["link", "read_log"]
    assert [(e.step, e.error) for e in trace if isinstance(e, t.Raise)] == [(6, "UCM_ERROR")]
