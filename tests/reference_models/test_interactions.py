"""A delivery belongs to one push, also where several are possible (10.1.6)."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from types import SimpleNamespace
from typing import cast

import pytest
from performing import answer

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.contract.scenario import Declaration, Scenario
from ucm_cts.adapters.contract.trace import Call, Enter, Exit, Reply, Request, Return
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.connectors import Link
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.purposes.payloads import Payloads
from ucm_cts.harness.purposes.selection import load_purposes, select
from ucm_cts.harness.selftest.generated.python_programs import HOME
from ucm_cts.harness.statement.files import read_statement
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.executions import BusinessCall
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.interactions import Interactions
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import Container, Member, Runtime
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.properties.clause_10_1_6 import message_order
from ucm_cts.reference_models.properties.declaration import PROPERTIES

EMITTER = Declaration(("in.api",), ("out.api",), ports={"out.api": "numbers"})
RECEIVER = Declaration(("in.api", "aux.api"), ports={"in.api": "numbers", "aux.api": "numbers"})


class Story:
    """Two connections; events are added step by step."""

    def __init__(self) -> None:
        self.runtime = Runtime(Scenario({}, ()))
        self.reported = Interactions(self.runtime)
        self._numbers: Iterator[int] = itertools.count(1)
        for link in ("left", "right"):
            self._link(s.Link("simple_message_connector", "numbers", link))
            self._member(f"{link} emitter", EMITTER)
            self._link(s.Attach(link, "emitter", f"{link} emitter", "out.api"))
            self._member(f"{link} receiver", RECEIVER)
            self._link(s.Attach(link, "receiver", f"{link} receiver", "in.api"))

    def _member(self, name: str, declaration: Declaration) -> None:
        member = Member(name, name, declaration, Container(s.MANAGER, True), len(self.runtime.members), 1, True)
        self.runtime.members[name] = self.runtime.bodies[name, 1] = member

    def _link(self, step: s.ConnectorCall) -> None:
        begin, end = Call(next(self._numbers), 0, 0, 0), Return(next(self._numbers), 0, 0, 0)
        self.reported.linked(step, begin, end)

    def attach(self, link: str, receiver: str, port: str) -> None:
        self._link(s.Attach(link, "receiver", receiver, port))

    def start_again(self, receiver: str) -> None:
        self.runtime.startups[receiver, 1] = next(self._numbers), 0

    def push(self, link: str, value: int, code: str = "ok", answered: bool = True) -> MethodCall:
        number = next(self._numbers)
        event = Request(number, number, number, f"{link} emitter", 1, "out.api", 0, s.PUSH, (value,))
        self.reported.request(event, BusinessCall(0, number, event))
        if answered:
            self.answer(self.reported.calls[-1], code)
        return self.reported.calls[-1]

    def answer(self, call: MethodCall, code: str = "ok") -> None:
        event = call.request
        self.reported.reply(
            Reply(next(self._numbers), 0, event.thread, event.component, 1, event.port, results=(code,)),
        )

    def deliver(self, link: str, value: int, port: str = "in.api") -> Delivery:
        number, name = next(self._numbers), f"{link} receiver"
        delivery = self.reported.enter(Enter(number, 0, 0, name, 1, "method", port, method=s.PUSH, arguments=(value,)))
        self.reported.exit(Exit(next(self._numbers), 0, 0, name, 1, "method", results=("ok",)))
        return delivery


@pytest.fixture
def story() -> Story:
    return Story()


def test_equal_messages_are_two(story: Story) -> None:
    first, second = story.push("left", 1), story.push("left", 1)
    assert [story.deliver("left", 1).call for _ in range(2)] == [first, second]
    assert story.deliver("left", 1).fit == "repeated"


def test_a_message_of_this_phase_comes_first(story: Story) -> None:
    early = story.push("left", 1)
    story.start_again("left receiver")
    late = story.push("left", 1)
    assert [story.deliver("left", 1).call for _ in range(2)] == [late, early]


@pytest.mark.parametrize("values", [(1, 1), (1, 2)])
def test_the_order_of_equal_messages_is_open(story: Story, values: tuple[int, int]) -> None:
    """A message that was kept until the next start, and one of that phase: an equal one may be either."""
    early, late = values
    story.push("left", early)
    story.start_again("left receiver")
    story.push("left", late)
    runtime = cast(ObservedRuntime, SimpleNamespace(interactions=story.reported, ics=Ics({"message-order": "fifo"})))
    second_first = [story.deliver("left", value) for value in (late, early)]
    concluded = [c for d in second_first for c in message_order(PROPERTIES["message_order"], runtime, d)]
    assert any(isinstance(one, Finding) for one in concluded) == (early != late)


def test_refused_push_comes_last(story: Story) -> None:
    refused, taken = story.push("left", 1, "comm_error"), story.push("left", 1)
    assert [story.deliver("left", 1).call for _ in range(2)] == [taken, refused]


def test_message_of_another_connection_is_stray(story: Story) -> None:
    own = story.push("left", 1)
    story.push("right", 2)
    strange = story.deliver("left", 2)
    assert (strange.call, strange.fit) == (None, "stray")
    assert story.deliver("left", 1).call is own


def test_apparently_altered_message_was_invented(story: Story) -> None:
    own = story.push("left", 1)
    strange = story.deliver("left", 7)
    assert (strange.call, strange.fit) == (own, "altered")
    true = story.deliver("left", 1)
    assert (true.call, true.fit) == (own, "same")
    assert (strange.call, strange.fit) == (None, "stray")
    assert own.deliveries == [true]


def test_apparently_first_altered_message_was_the_second(story: Story) -> None:
    first, second = story.push("left", 1), story.push("left", 2)
    altered = story.deliver("left", 7)
    story.deliver("left", 1)
    assert (altered.call, altered.fit) == (second, "altered")
    assert [d.fit for d in first.deliveries] == ["same"]


def test_a_receiver_at_two_ports_gets_it_twice(story: Story) -> None:
    story.attach("left", "left receiver", "aux.api")
    call = story.push("left", 1)
    assert [story.deliver("left", 1, port).fit for port in ("in.api", "aux.api")] == ["same", "same"]
    assert len(call.deliveries) == 2


def test_single_push_is_not_crowded(story: Story) -> None:
    assert not story.push("left", 1).crowded
    assert story.push("left", 2).crowded  # the first one has not arrived
    story.deliver("left", 1)
    story.deliver("left", 2)
    assert not story.push("left", 3).crowded


def test_pushes_at_once_are_crowded(story: Story) -> None:
    one, other = story.push("left", 1, answered=False), story.push("right", 2, answered=False)
    assert one.crowded
    assert other.crowded


class CannotBreak(ReferenceAdapter):
    """Its hook that breaks a connection raises."""

    def break_link(self, link: Link, where: str) -> None:
        raise UcmError("it cannot")


def test_mending_without_a_break_is_no_failure() -> None:
    (purpose,) = select(load_purposes("core"), "transport-breaks")
    statement = read_statement(HOME / "ics.toml")
    for _, asked in purpose.scenarios:
        reported = answer(Payloads(1).deal(asked), CannotBreak)
        assert isinstance(reported, Traced)
        verdicts = Monitor(load_life_cycle(), statement.ics).judge(asked, reported.events)
        assert not [finding for finding in verdicts.findings if finding.rule == "ok_after_mending"]
