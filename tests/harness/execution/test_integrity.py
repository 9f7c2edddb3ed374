"""The integrity check accepts truthful traces and finds each small edit that no truthful host can produce."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
import pytest

from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.scenario import Hook, Scenario
from ucm_cts.adapters.contract.trace import Call, Enter, Event, Exit, Held, Opened, Reference, Return, Skip, Timeout
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.execution.integrity import believable, contradiction

CALL = {"do": "call", "port": "out", "value": 5}
RICH = msgspec.convert(
    {
        "components": {
            "server": {"provides": ["in"], "plan": {"exchange": [{"do": "hold", "gate": "g"}]}},
            "client": {"provides": ["in"], "requires": ["out"], "connectable": True, "plan": {"exchange": [CALL]}},
            "member": {"fragment": True, "plan": {"on_startup": [{"do": "siblings"}]}},
            "faulty": {"plan": {"on_shutdown": [{"do": "raise"}]}},
            "steady": {"provides": ["in"], "plan": {"exchange": [{"do": "return", "value": 9}]}},
        },
        "steps": [
            *({"op": "add_component", "component": c} for c in ("server", "client", "member", "faulty", "steady")),
            {"op": "get_port_element", "id": "server", "port": "in", "bind": "api"},
            {"op": "get_port_element", "id": "client", "port": "in", "bind": "entry"},
            {"op": "get_port_element", "id": "steady", "port": "in", "bind": "nine"},
            {"op": "connect", "id": "client", "port": "out", "to": "api", "bind": "link"},
            {"op": "start"},
            {"op": "invoke", "ref": "entry", "value": 3, "thread": "w"},
            {"op": "reach", "gate": "g"},
            {"op": "get_components"},
            {"op": "open", "gate": "g"},
            {"op": "join", "worker": "w"},
            {"op": "invoke", "ref": "nine", "value": 1, "thread": "w"},
            {"op": "join", "worker": "w"},
            {"op": "invoke", "ref": "nine", "value": 1},
            {"op": "add_component", "component": "unheard-of"},
            {"op": "remove_component", "id": "unheard-of"},
            {"op": "stop"},
        ],
    },
    Scenario,
)
ADD, GET, CONNECT, START, ENTRY, REACH, LIST, NINE, SKIPPED, STOP = 0, 5, 8, 9, 10, 11, 12, 15, 19, 20

Events = list[Any]
Edit = Callable[[Events], object]


def truth() -> tuple[Event, ...]:
    answer = from_host_decoder().decode(Engine(ReferenceAdapter).answer(encode(Run(0, RICH))))
    assert isinstance(answer, Traced)
    assert not answer.stuck
    return answer.events


TRUTH = truth()


def where(kind: str, **fields: object) -> int:
    """The place of the first event of ``kind`` with these ``fields``."""
    for index, event in enumerate(TRUTH):
        tag = type(event).__struct_config__.tag
        if tag == kind and all(getattr(event, name) == value for name, value in fields.items()):
            return index
    raise LookupError(kind, fields)


def change(kind: str, new: dict[str, object], **fields: object) -> Edit:
    """An edit: that event says something else."""
    index = where(kind, **fields)

    def edit(events: Events) -> None:
        events[index] = msgspec.structs.replace(events[index], **new)

    return edit


def drop(*places: int) -> Edit:
    """An edit: these events did not happen."""

    def edit(events: Events) -> None:
        for index in sorted(places, reverse=True):
            del events[index]

    return edit


def swap(one: int, other: int) -> Edit:
    """An edit: these events happened the other way round."""

    def edit(events: Events) -> None:
        events[one], events[other] = events[other], events[one]

    return edit


def insert(index: int, event: Event) -> Edit:
    """An edit: this happened too."""
    return lambda events: events.insert(index, event)


def renumbered(events: Events) -> tuple[Event, ...]:
    return tuple(msgspec.structs.replace(e, n=n, t=n) for n, e in enumerate(events, 1))


def entered(component: str, hook: Hook) -> Edit:
    """An edit: that body was entered there as well, at the end."""
    more = (Enter(0, 0, 0, component, 1, hook), Exit(0, 0, 0, component, 1, hook))
    return lambda events: events.extend(more)


def skip_list(events: Events) -> None:
    index = where("call", step=LIST)
    events[index : index + 2] = [Skip(0, 0, 0, LIST, "manager")]


def carry_out_what_cannot_be(events: Events) -> None:
    events[where("skip")] = Call(0, 0, 0, SKIPPED)
    events.insert(where("skip") + 1, Return(0, 0, 0, SKIPPED))


def on_thread(thread: int, *steps: int) -> Edit:
    """An edit: these steps ran on another thread, with all that happened in them."""

    def edit(events: Events) -> None:
        for step in steps:
            first, last = where("call", step=step), where("return", step=step)
            own = events[first].thread
            for index in range(first, last + 1):
                if events[index].thread == own:
                    events[index] = msgspec.structs.replace(events[index], thread=thread)

    return edit


def move(index: int, to: int) -> Edit:
    """An edit: it happened at another time."""
    return lambda events: events.insert(to, events.pop(index))


STRANGER = Reference("server", 2, "in")
LIES: dict[str, tuple[Edit, str]] = {
    "a step that is missing": (drop(where("call", step=ADD), where("return", step=ADD)), ""),
    "a step that never ends": (drop(where("raise", step=STOP)), "ended"),
    "a step that was not requested": (change("call", {"step": 99}, step=LIST), "no step 99"),
    "a worker's step on the scenario's thread": (on_thread(0, ENTRY, NINE), "which is another one's"),
    "a step of the scenario on another thread": (on_thread(7, LIST), "not on the scenario's own"),
    "a worker on two threads": (on_thread(7, NINE), "others of 'w' on thread 1"),
    "a step inside another one": (move(where("return", step=LIST), where("call", step=SKIPPED - 1) + 1), "is open on"),
    "a gate that was not opened": (drop(where("opened")), "goes on although gate 'g' is closed"),
    "a gate opened too late": (move(where("opened"), where("return", step=ENTRY)), "goes on although gate"),
    "a gate opened twice": (lambda events: events.insert(0, events[where("opened")]), "no step opens it"),
    "another gate opened": (change("opened", {"gate": "h"}), "no step opens it"),
    "a wait without a body": (move(where("held"), where("call", step=LIST)), "not seen a body at gate 'g'"),
    "a join that did not wait": (move(where("return", step=NINE), where("call", step=NINE + 2)), "'w' is not done"),
    "patience that was not had": (insert(where("call", step=LIST), Timeout(0, 0, 0, REACH)), "too early"),
    "a step carried out twice": (change("call", {"step": ADD}, step=LIST), "twice"),
    "steps in another order": (
        lambda events: events.insert(0, events.pop(where("call", step=LIST))), "comes after"
    ),
    "an end without its step": (drop(where("call", step=LIST)), "without being open"),
    "an end on another thread": (change("return", {"thread": 7}, step=LIST), "without being open"),
    "a wait that ends like an operation": (insert(0, Return(0, 0, 0, REACH)), "no operation"),
    "an operation that runs out of patience": (insert(0, Timeout(0, 0, 0, LIST)), "not a wait"),
    "an id that is none": (change("return", {"value": "opaque"}, step=ADD), "cannot return"),
    "a list that is none": (change("return", {"value": 3}, step=LIST), "cannot return"),
    "a reference that is none": (change("return", {"value": 3}, step=GET), "cannot return"),
    "a value from start": (change("return", {"value": 0}, step=START), "cannot return"),
    "a connection id that is none": (change("return", {"value": None}, step=CONNECT), "cannot return"),
    "a reference without a body": (change("return", {"value": STRANGER}, step=GET), "never made"),
    "an undeclared component": (change("create", {"component": "nobody"}, component="server"), "no component"),
    "an instance left out": (change("create", {"instance": 2}, component="server"), "made after 0"),
    "a body that was never made": (drop(where("create", component="server")), "never made"),
    "a call of nothing": (change("enter", {"value": None}, hook="exchange", component="server"), "exchange on"),
    "a call at no port": (change("enter", {"port": "out"}, hook="exchange", component="server"), "exchange on"),
    "a request at no port": (change("request", {"port": "in"}), "a request through"),
    "a reply at another port": (change("reply", {"port": "in"}), "without its request"),
    "a reply without request": (drop(where("request")), ""),
    "a body that leaves first": (swap(where("enter", hook="on_init"), where("exit", hook="on_init")), "entered"),
    "a body left elsewhere": (change("exit", {"hook": "on_remove"}, hook="on_init"), "is left where"),
    "a body that never leaves": (drop(where("exit", hook="on_init")), ""),
    "another body acts": (change("held", {"component": "steady"}), "without having been entered"),
    "another thread acts": (change("siblings", {"thread": 9}), "without having been entered"),
    "an unplanned gate": (change("held", {"gate": "h"}), "plan"),
    "a planned failure that did not come": (
        change("exit", {"raised": False}, hook="on_shutdown", component="faulty"), "against its plan"
    ),
    "an unplanned failure": (change("exit", {"raised": True}, hook="on_init", component="steady"), "against its plan"),
    "another result than planned": (change("exit", {"value": 8}, value=9), "its plan says 9"),
    "another result than computed": (change("exit", {"value": 0}, hook="exchange", component="server"), "its plan says"),
    "a step skipped for nothing": (skip_list, "although manager is bound"),
    "a step done without what it needs": (carry_out_what_cannot_be, "not bound"),
    "a callback the body does not have": (entered("steady", "on_connect"), "not Connectable"),
    "an interface the body does not have": (entered("steady", "set_container_interface"), "no fragment"),
    "a start without dependencies": (change("enter", {"dependencies": None}, hook="on_startup"), "without dependencies"),
    "dependencies out of place": (change("enter", {"dependencies": ()}, hook="on_init"), "with dependencies"),
    "a hold that was left out": (drop(where("held")), "not seen a body"),
    "a question that was left out": (drop(where("siblings")), "did not act"),
    "another payload than planned": (change("request", {"value": 6}), "did not act"),
}  # fmt: skip


@pytest.mark.parametrize(("edit", "problem"), LIES.values(), ids=LIES.keys())
def test_contradiction_is_found(edit: Edit, problem: str) -> None:
    events = list(TRUTH)
    edit(events)
    found = contradiction(RICH, renumbered(events))
    assert found is not None
    assert problem in found


def test_truthful_traces_have_no_contradiction() -> None:
    assert contradiction(RICH, TRUTH) is None
    kinds = {type(event) for event in TRUTH}
    assert {Held, Opened, Skip} <= kinds, "the scenario has a bit of everything"
    assert {event.thread for event in TRUTH} == {0, 1}


@pytest.mark.parametrize(("n", "t", "problem"), [(9, 0, "event number 9"), (0, -1, "earlier")])
def test_numbers_without_gap_and_clocks_that_go_on(n: int, t: int, problem: str) -> None:
    events = list(renumbered(list(TRUTH)))
    events[3] = msgspec.structs.replace(events[3], n=n or events[3].n, t=t or events[3].t)
    assert problem in (contradiction(RICH, events) or "")


def test_a_trace_must_not_break_off() -> None:
    for length in range(len(TRUTH)):
        assert believable(RICH, TRUTH[:length]) == TRUTH[:length]
        assert contradiction(RICH, TRUTH[:length]) is not None


def test_only_the_steps_of_stuck_workers_may_stay_open() -> None:
    workers = sorted({step.thread for step in RICH.steps if step.thread})
    assert contradiction(RICH, TRUTH, workers) is None
    assert "no such worker" in str(contradiction(RICH, TRUTH, ["nobody"]))
    assert contradiction(RICH, TRUTH[:-1], workers) is not None  # the last step is the scenario's own


WAITING = msgspec.convert(
    {
        "components": {"slow": {"provides": ["in"], "plan": {"exchange": [{"do": "hold", "gate": "g"}]}}},
        "steps": [
            {"op": "add_component", "component": "slow"},
            {"op": "get_port_element", "id": "slow", "port": "in", "bind": "api"},
            {"op": "start"},
            {"op": "reach", "gate": "g"},
            {"op": "invoke", "ref": "api", "value": 1},
            {"op": "open", "gate": "g"},
        ],
        "patience": 30,
    },
    Scenario,
)


def test_waits_end_when_patience_has_run_out() -> None:
    answer = from_host_decoder().decode(Engine(ReferenceAdapter).answer(encode(Run(0, WAITING))))
    assert isinstance(answer, Traced)
    assert contradiction(WAITING, answer.events) is None
    kinds = [type(event) for event in answer.events]
    assert {Timeout, Held, Opened} <= set(kinds)
    for kind, problem in (Timeout, "runs out of patience too early"), (Held, "goes on although gate 'g' is closed"):
        index = kinds.index(kind)
        hurried = [
            msgspec.structs.replace(e, t=e.t - 25_000_000 if n >= index + (kind is Held) else e.t)
            for n, e in enumerate(answer.events)
        ]
        assert problem in (contradiction(WAITING, hurried) or "")


def test_plans_are_checked_against_received_references() -> None:
    """A client that was given no reference at on_startup has no reference to call."""
    client = {"provides": ["in"], "requires": ["out"], "plan": {"exchange": [CALL]}}
    steps = [
        {"op": "add_component", "component": "client"},
        {"op": "get_port_element", "id": "client", "port": "in", "bind": "entry"},
        {"op": "invoke", "ref": "entry", "value": 1},
    ]
    scenario = msgspec.convert({"components": {"client": client}, "steps": steps}, Scenario)
    answer = from_host_decoder().decode(Engine(ReferenceAdapter).answer(encode(Run(0, scenario))))
    assert isinstance(answer, Traced)
    assert contradiction(scenario, answer.events) is None


def test_a_body_may_have_had_its_references_for_a_part_of_a_call() -> None:
    """A call that begins before the start and ends after the end of a client goes through the reference that it had meanwhile."""
    hold = {"do": "hold", "gate": "before"}
    client = {"provides": ["in"], "requires": ["out"], "plan": {"exchange": [hold, CALL]}}
    server = {"provides": ["in"], "plan": {"exchange": [hold | {"gate": "inside"}]}}
    components = {"server": server, "client": client}
    steps = [
        {"op": "add_component", "component": "server"},
        {"op": "add_component", "component": "client"},
        {"op": "get_port_element", "id": "server", "port": "in", "bind": "server"},
        {"op": "connect", "id": "client", "port": "out", "to": "server", "bind": "link"},
        {"op": "get_port_element", "id": "client", "port": "in", "bind": "entry"},
        {"op": "invoke", "ref": "entry", "value": 1, "thread": "caller"},
        {"op": "reach", "gate": "before"},
        {"op": "start"},
        {"op": "open", "gate": "before"},
        {"op": "reach", "gate": "inside"},
        {"op": "destroy", "thread": "ender"},
        {"op": "settle", "worker": "ender"},
        {"op": "open", "gate": "inside"},
        {"op": "join", "worker": "caller"},
        {"op": "join", "worker": "ender"},
    ]
    scenario = msgspec.convert({"components": components, "steps": steps}, Scenario)
    answer = from_host_decoder().decode(Engine(ReferenceAdapter).answer(encode(Run(0, scenario))))
    assert isinstance(answer, Traced)
    ended = [e.n for e in answer.events if isinstance(e, Exit) and (e.component, e.hook) == ("client", "on_shutdown")]
    (called,) = [e.n for e in answer.events if isinstance(e, Exit) and (e.component, e.hook) == ("client", "exchange")]
    assert ended[0] < called
    assert contradiction(scenario, answer.events) is None
    other = msgspec.convert(
        {"components": components | {"client": client | {"plan": {"exchange": [hold, CALL, hold]}}}, "steps": steps},
        Scenario,
    )
    assert "client did not act in exchange" in (contradiction(other, answer.events) or "")
