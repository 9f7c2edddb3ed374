"""Which calls that never came back a framework has lost."""

from __future__ import annotations

import pytest
from made_up_run import COMPONENTS, STEPS, Tape, begin

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.harness.results.unanswered_calls import finding_of_lost_call, is_left_open
from ucm_cts.harness.results.values import Execution, Incident
from ucm_cts.reference_models.findings import Finding

REMOVED = (s.Stop(), s.Disconnect("link"), s.RemoveComponent("provider"), s.Start())


def removed(tape: Tape, first: int) -> None:
    """What ``REMOVED`` does, the steps from ``first`` on."""
    for step, hooks in enumerate(
        ((("client", "on_shutdown"), ("provider", "on_shutdown")), (), (("provider", "on_remove"),)), first
    ):
        tape.put(t.Call, step=step)
        for component, hook in hooks:
            tape.hook(component, hook)
        tape.put(t.Return, step=step)
    tape.put(t.Call, step=first + 3)
    tape.hook("client", "on_startup", dependencies=())
    tape.put(t.Return, step=first + 3)


def hang(steps: tuple[s.Step, ...], tape: Tape) -> Finding | None:
    """The finding about the last call, which never ends."""
    incident = Incident("hang", "no answer within 5 s")
    return finding_of_lost_call(Execution("hang", s.Scenario(COMPONENTS, steps), tape.trace(), incident))


@pytest.mark.parametrize("value", [None, "opaque", t.Reference("provider", 1, "in_api")], ids=str)
@pytest.mark.parametrize("is_removed", [False, True])
def test_what_a_reference_to_something_removed_does_is_open(is_removed: bool, value: object) -> None:
    """A framework's proxies do not show where they lead to."""
    before = (*STEPS[:5], s.GetPortElement("provider", "in_api", "later"))
    tape = Tape()
    begin(tape)
    tape.step(5, value)
    if is_removed:
        removed(tape, len(before))
    steps = (*before, *(REMOVED if is_removed else ()), s.Invoke("later", 1))
    tape.put(t.Call, step=len(steps) - 1)
    finding = hang(steps, tape)
    assert (finding is None) == is_removed
    assert finding is None or finding.requirement == "R-11.2.3-03"


@pytest.mark.parametrize("is_removed", [False, True])
def test_a_call_of_what_is_still_there_is_lost_though_others_are_removed(is_removed: bool) -> None:
    before = (*STEPS[:5], s.GetPortElement("client", "in_go", "go"))
    tape = Tape()
    begin(tape)
    tape.step(5, "opaque")
    if is_removed:
        removed(tape, len(before))
    steps = (*before, *(REMOVED if is_removed else ()), s.Invoke("go", 1))
    tape.put(t.Call, step=len(steps) - 1)
    finding = hang(steps, tape)
    assert finding is not None
    assert finding.requirement == "R-11.2.3-03"


def test_a_call_through_a_new_connection_is_lost_though_the_old_provider_is_removed() -> None:
    anew = (s.AddComponent("provider", bind="new"), s.GetPortElement("new", "in_api", "to new"))
    before = (*STEPS[:5], s.GetPortElement("client", "in_go", "go"), *REMOVED[:3], *anew)
    steps = (*before, s.Connect("client", "out_api", "to new", "new link"), s.Start(), s.Invoke("go", 1))
    tape = Tape()
    begin(tape)
    tape.step(5, "opaque")
    removed(tape, 6)
    del tape.events[-4:]  # the start comes later
    tape.put(t.Call, step=9)
    tape.put(t.Create, component="provider", instance=2)
    tape.put(t.Return, step=9, value=9)
    tape.step(10, "opaque")
    tape.step(11, 10)
    tape.put(t.Call, step=12)
    for body in (("client", 1), ("provider", 2)):
        tape.put(t.Enter, component=body[0], instance=body[1], hook="on_startup")
        tape.put(t.Exit, component=body[0], instance=body[1], hook="on_startup")
    tape.put(t.Return, step=12)
    tape.put(t.Call, step=13)
    tape.put(t.Enter, component="client", instance=1, hook="exchange", port="in_go", value=1)
    tape.put(t.Request, component="client", instance=1, port="out_api", value=1)
    assert hang(steps, tape) is not None


@pytest.mark.parametrize("is_removed", [False, True])
def test_a_call_between_components_whose_provider_was_removed_is_open(is_removed: bool) -> None:
    steps = (*STEPS[:5], s.GetPortElement("client", "in_go", "go"), *(REMOVED if is_removed else ()), s.Invoke("go", 1))
    tape = Tape()
    begin(tape)
    tape.step(5, "opaque")
    if is_removed:
        removed(tape, 6)
    tape.put(t.Call, step=len(steps) - 1)
    tape.put(t.Enter, component="client", instance=1, hook="exchange", port="in_go", value=1)
    tape.put(t.Request, component="client", instance=1, port="out_api", value=1)
    assert (hang(steps, tape) is None) == is_removed


@pytest.mark.parametrize(
    ("further", "is_open"), [((s.Break("line"),), True), ((s.Break("line"), s.Mend("line")), False)]
)
def test_a_call_while_something_is_broken_may_wait(further: tuple[s.Step, ...], is_open: bool) -> None:
    steps = (*STEPS[:5], s.GetPortElement("client", "in_go", "go"), *further, s.Invoke("go", 1))
    tape = Tape()
    begin(tape)
    tape.step(5, "opaque")
    for step in range(6, len(steps) - 1):
        tape.step(step, None)
    tape.put(t.Call, step=len(steps) - 1)
    tape.put(t.Enter, component="client", instance=1, hook="exchange", port="in_go", value=1)
    tape.put(t.Request, component="client", instance=1, port="out_api", value=1)
    assert (hang(steps, tape) is None) == is_open
    assert is_left_open(Execution("hang", s.Scenario(COMPONENTS, steps), tape.trace())) == is_open
