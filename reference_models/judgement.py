"""The judge: every rule watches every trace. Pure and offline: the same trace gives the same findings, anywhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import (
    Call,
    Counted,
    Create,
    Enter,
    Exit,
    Held,
    Opened,
    Paused,
    Pushed,
    Raise,
    Reply,
    Request,
    Return,
    Settled,
    Siblings,
    Skip,
    Stressed,
    Timeout,
    Trace,
)
from ucm_cts.reference_models import (
    rules_bursts,
    rules_callbacks,
    rules_claims,
    rules_clock,
    rules_dependencies,
    rules_execution,
    rules_interactions,
    rules_message_phases,
    rules_messages,
    rules_operations,
    rules_policies,
    rules_return_codes,
    rules_services,
    rules_stress,
    rules_trace,
    rules_values,
)
from ucm_cts.reference_models.adoption import adopt
from ucm_cts.reference_models.claims import Claims
from ucm_cts.reference_models.duties import Duties
from ucm_cts.reference_models.executions import BusinessCall, Executions
from ucm_cts.reference_models.interactions import Interactions
from ucm_cts.reference_models.ledger import Ledger, checks
from ucm_cts.reference_models.life_cycle import LifeCycleTable
from ucm_cts.reference_models.runtime import Member, Runtime, Window
from ucm_cts.reference_models.situations import Situations

RULE_MODULES = (
    rules_operations,
    rules_dependencies,
    rules_interactions,
    rules_callbacks,
    rules_claims,
    rules_execution,
    rules_policies,
    rules_stress,
    rules_messages,
    rules_message_phases,
    rules_return_codes,
    rules_services,
    rules_clock,
    rules_trace,
    rules_bursts,
    rules_values,
)
"""Importing these registers all rules; rules of one moment look in this order."""


class Judge:
    """Judges traces against one life-cycle table and what the vendor claims. Holds no state between traces."""

    def __init__(self, table: LifeCycleTable, claims: Claims | None = None) -> None:
        self.claims = claims or Claims()
        self.situations = Situations(table)
        self.duties = Duties(table)
        self.ended = {op: checks("ended", op) for op in rules_operations.DECLARED}
        self.entered = {hook: checks("entered", hook) for hook in get_args(s.Hook)}
        self.called = checks("called", "exchange")
        self.answered = checks("answered", "exchange")
        self.replied = checks("replied", "exchange")
        self.noted = checks("noted", "siblings")
        self.began = checks("began", "")
        self.over = checks("over", "")
        self.served = checks("served", "")
        self.waited = checks("waited", "")
        self.linked = checks("linked", "")
        self.delivered = checks("delivered", "")
        self.completed = checks("completed", "")
        self.told = checks("told", "")
        self.closed = checks("closed", "")

    def judge(self, scenario: s.Scenario, trace: Trace) -> Ledger:
        """Everything the rules say about ``trace``, which may break off anywhere.

        Where two operations overlap, because one of them took too long, reading ends: who did what cannot be told.
        """
        reading = _Reading(self, scenario)
        for event in trace:
            if reading.window is not None and isinstance(event, Call) and reading.overlaps(event):
                break
            take = _TAKE.get(type(event))
            if take is not None:
                take(reading, event)
            if reading.interactions is not None and not isinstance(event, Timeout | Settled):
                reading.interactions.latest = event.t
        reading.close()
        return reading.ledger


class _Reading:
    """One trace being read: the model, the operation in progress, and who is inside whom on each thread."""

    def __init__(self, judge: Judge, scenario: s.Scenario) -> None:
        self.judge = judge
        self.ledger = Ledger(scenario, judge.duties, claims=judge.claims)
        self.runtime = Runtime(scenario)
        self.window: Window | None = None
        self.heard: dict[tuple[str, int], list[s.Hook]] = {}
        self.calls: dict[int, list[BusinessCall]] = {}
        self.hooks: dict[int, list[s.Hook]] = {}
        self.served: dict[int, list[BusinessCall | None]] = {}
        policies = any(declaration.policies for declaration in scenario.components.values())
        self.executions = Executions(self.runtime) if policies or scenario.interfaces else None
        self.interactions = Interactions(self.runtime) if policies or scenario.interfaces else None
        self.runtime.interactions = self.interactions
        self.runtime.executions = self.executions
        self.connecting: dict[int, Call] = {}

    def close(self) -> None:
        """The trace is over."""
        for check in self.judge.closed if self.interactions is not None else ():
            check(self.ledger, self.runtime)
        self.ledger.close()

    def overlaps(self, event: Call) -> bool:
        """Does another operation begin with ``event``, while one is in progress?"""
        return isinstance(self.ledger.scenario.steps[event.step], s.ContainerCall)

    def call(self, event: Call) -> None:
        step = self.ledger.scenario.steps[event.step]
        if self.interactions is not None:
            self.interactions.operate(step, event)
        if isinstance(step, s.Invoke):
            self.begin(event.thread, BusinessCall(step.value, event.n, step=step))
        elif isinstance(step, s.ContainerCall):
            self.window = self.judge.situations.open(self.runtime, event.step, step)
            self.window.call = event.n
        else:
            self.connecting[event.step] = event

    def end(self, event: Return | Raise) -> None:
        window, ledger, runtime = self.window, self.ledger, self.runtime
        if self.interactions is not None:
            self.interactions.operated(event)
        if window is not None and window.step_number == event.step:
            for check in self.judge.ended[window.operation]:
                check(ledger, runtime, window, event)
            adopt(runtime, window, event)
            runtime.starting.clear()
            self.window = None
            return
        step = ledger.scenario.steps[event.step]
        begin = self.connecting.pop(event.step, None)
        if begin is not None:
            self.end_connecting(step, begin, event)
            return
        calls = self.calls.get(event.thread)
        if calls and isinstance(step, s.Invoke):
            call = calls.pop()
            for check in self.judge.answered:
                check(ledger, runtime, call, event)
            self.come_back(call, event.n)

    def end_connecting(self, step: s.Step, begin: Call, event: Return | Raise) -> None:
        if self.interactions is None:
            return
        if isinstance(step, s.ConnectorCall):
            link = self.interactions.linked(step, begin, event)
            for check in self.judge.linked:
                check(self.ledger, self.runtime, link, step, event)
        elif isinstance(event, Return):
            self.tell(event)

    def skip(self, event: Skip) -> None:
        if self.connecting.pop(event.step, None) is not None:
            self.runtime.not_offered.append(event)

    def tell(self, event: Return | Pushed | Counted | Paused | Stressed) -> None:
        if isinstance(event, Pushed) and self.interactions is not None:
            self.interactions.push(event)
        for check in self.judge.told if self.interactions is not None else ():
            check(self.ledger, self.runtime, event)

    def paused(self, event: Paused) -> None:
        if self.interactions is not None:
            self.interactions.pauses.append(event)
        self.tell(event)

    def create(self, event: Create) -> None:
        if self.window is not None:
            self.window.created.append((event.component, event.instance))

    def enter(self, event: Enter) -> None:
        self.hooks.setdefault(event.thread, []).append(event.hook)
        if event.hook in ("exchange", "run", "method"):
            self.enter_business(event)
            return
        body = (event.component, event.instance)
        heard = self.heard.get(body)
        if heard is None:
            heard = self.heard[body] = []
        window, ledger, runtime = self.window, self.ledger, self.runtime
        for check in self.judge.entered[event.hook]:
            check(ledger, runtime, window, event, heard)
        heard.append(event.hook)
        if event.hook == "on_startup":
            runtime.startups[body] = event.n, event.thread
        member = runtime.member_of(event.component, event.instance)
        if member is not None:
            self.changes(member, event.hook)
        if window is not None:
            window.hear(event)

    def changes(self, member: Member, hook: s.Hook) -> None:
        """What is so from now on, although the operation has not ended."""
        if hook == "on_startup":
            member.closing = False
            known = self.window is None or self.window.operation != "connect"
            member.handed_over = tuple(c for c in member.connections if c.live is not False) if known else None
        elif hook == "on_shutdown":
            member.closing = True

    def enter_business(self, event: Enter) -> None:
        delivery = None
        if event.hook == "method" and self.interactions is not None:
            delivery = self.interactions.enter(event)
            call = delivery.call.business if delivery.call is not None else None
        else:
            call = self.call_behind(event) if event.hook == "exchange" else None
        self.served.setdefault(event.thread, []).append(call)
        self.runtime.inside.setdefault(event.thread, []).append((event.component, event.instance))
        if self.executions is not None:
            execution, met = self.executions.begin(event, call)
            for check in self.judge.began:
                check(self.ledger, self.runtime, execution, met)
        if event.hook == "run":
            self.runtime.last_run[event.component, event.instance] = event.n
            return
        if call is not None:
            call.entries.append((event, None))
        if delivery is not None:
            for check in self.judge.delivered:
                check(self.ledger, self.runtime, delivery)
        else:
            for check in self.judge.called:
                check(self.ledger, self.runtime, self.window, event, call)
        member = self.runtime.member_of(event.component, event.instance)
        if member is not None and member.operational:
            member.served = True

    def exit(self, event: Exit) -> None:
        hooks = self.hooks.get(event.thread)
        if hooks:
            hooks.pop()
        if event.hook == "on_startup":
            self.runtime.starting.add((event.component, event.instance))
        served = self.served.get(event.thread)
        if event.hook not in ("exchange", "run", "method") or not served:
            return
        self.runtime.inside[event.thread].pop()
        if event.hook == "method" and self.interactions is not None:
            self.interactions.exit(event)
        call = served.pop()
        if call is not None:
            call.close(event)
        execution = self.executions.end(event) if self.executions is not None else None
        if execution is not None:
            for check in self.judge.over:
                check(self.ledger, self.runtime, execution, event.n)

    def call_behind(self, event: Enter) -> BusinessCall | None:
        calls = self.calls.get(event.thread)
        own = calls[-1] if calls else None
        if own is not None and own.value == event.value:
            return own
        waiting = [c[-1] for c in self.calls.values() if c and c[-1].value == event.value]
        return waiting[-1] if waiting else own

    def request(self, event: Request) -> None:
        inside = self.hooks.get(event.thread)
        hook = inside[-1] if inside else ""
        call = BusinessCall(event.value, event.n, event, caller_hook=hook)
        if self.executions is not None:
            call.caller = self.executions.innermost(event.thread)
        self.begin(event.thread, call)
        if event.method is not None and self.interactions is not None:
            self.interactions.request(event, call)

    def begin(self, thread: int, call: BusinessCall) -> None:
        call.look(self.runtime)
        self.calls.setdefault(thread, []).append(call)
        if self.executions is not None:
            self.executions.made(call)

    def reply(self, event: Reply) -> None:
        calls = self.calls.get(event.thread)
        if calls:
            call = calls.pop()
            is_method = call.request is not None and call.request.method is not None
            completed = self.interactions.reply(event) if is_method and self.interactions is not None else None
            if completed is not None:
                for check in self.judge.completed:
                    check(self.ledger, self.runtime, completed)
            for check in self.judge.replied if not is_method else ():
                check(self.ledger, self.runtime, call, event)
            self.come_back(call, event.n)

    def come_back(self, call: BusinessCall, end: int) -> None:
        waited = self.executions.answered(call) if self.executions is not None else None
        for check in self.judge.served if waited is not None else ():
            check(self.ledger, self.runtime, call, waited, end)

    def held(self, event: Held) -> None:
        if self.executions is not None:
            self.executions.hold(event)
        if self.interactions is not None:
            self.interactions.hold(event)

    def opened(self, event: Opened) -> None:
        if self.executions is not None:
            self.executions.open(event)
        if self.interactions is not None:
            self.interactions.open(event)

    def settled(self, event: Settled) -> None:
        if self.executions is not None:
            self.executions.settle(event)
        if self.interactions is not None:
            self.interactions.settled.append(event)

    def timeout(self, event: Timeout) -> None:
        if self.executions is None and self.interactions is None:
            return
        if self.interactions is not None:
            self.interactions.wait(event)
        for check in self.judge.waited:
            check(self.ledger, self.runtime, event)
        if self.executions is not None and isinstance(self.ledger.scenario.steps[event.step], s.Join):
            for call, waited in self.executions.lost():
                for check in self.judge.served:
                    check(self.ledger, self.runtime, call, waited, 0)

    def siblings(self, event: Siblings) -> None:
        for check in self.judge.noted:
            check(self.ledger, self.runtime, self.window, event)


_TAKE: dict[type[Any], Callable[[_Reading, Any], None]] = {
    Call: _Reading.call,
    Return: _Reading.end,
    Raise: _Reading.end,
    Skip: _Reading.skip,
    Create: _Reading.create,
    Enter: _Reading.enter,
    Exit: _Reading.exit,
    Request: _Reading.request,
    Reply: _Reading.reply,
    Siblings: _Reading.siblings,
    Held: _Reading.held,
    Opened: _Reading.opened,
    Settled: _Reading.settled,
    Timeout: _Reading.timeout,
    Pushed: _Reading.tell,
    Counted: _Reading.tell,
    Paused: _Reading.paused,
    Stressed: _Reading.tell,
}
"""What to do with each kind of event; the other kinds say nothing to the rules."""
