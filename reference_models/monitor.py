"""The judge: every rule watches every trace. Pure and offline: the same trace gives the same findings, anywhere."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import (
    Call,
    Counted,
    Create,
    Enter,
    Event,
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
)
from ucm_cts.reference_models.model.application import adopt
from ucm_cts.reference_models.model.callback_history import Heard
from ucm_cts.reference_models.model.executions import BusinessCall, Executions
from ucm_cts.reference_models.model.expected_callbacks import Duties
from ucm_cts.reference_models.model.ics import Claims
from ucm_cts.reference_models.model.interactions import Interactions
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable
from ucm_cts.reference_models.model.row_selection import Situations
from ucm_cts.reference_models.model.runtime import Member, Runtime, Window
from ucm_cts.reference_models.properties.selection import Watch, followed_in
from ucm_cts.reference_models.verdicts import Ledger, Where

_BUSINESS = frozenset(("exchange", "run", "method"))
"""Where bodies are entered that is no callback."""

_NOTHING_HAPPENS = frozenset((Timeout, Settled))
_CONTAINER_CALLS = frozenset(get_args(s.ContainerCall))
_CONNECTOR_CALLS = frozenset(get_args(s.ConnectorCall))


class Judge:
    """Judges traces against one life-cycle table and what the vendor claims. Holds no state between traces."""

    def __init__(self, table: LifeCycleTable, claims: Claims | None = None) -> None:
        self.claims = claims or Claims()
        self.situations = Situations(table)
        self.duties = Duties(table)
        self._watches: dict[frozenset[Where], Watch] = {}

    def judge(self, scenario: s.Scenario, trace: Iterable[Event]) -> Ledger:
        """Everything the rules say about ``trace``, which may break off anywhere, and is read once, event by event.

        Where two operations overlap, because one of them took too long, reading ends: who did what cannot be told.
        """
        followed = followed_in(scenario)
        watch = self._watches.get(followed)
        if watch is None:
            watch = self._watches[followed] = Watch(followed)
        reading = _Reading(self, watch, scenario, followed)
        interactions = reading.interactions
        for event in trace:
            if _TAKE[type(event)](reading, event):
                break
            if interactions is not None and type(event) not in _NOTHING_HAPPENS:
                interactions.latest = event.t
        reading.close()
        return reading.ledger


class _Thread:
    """What one thread is doing: calls that have not come back, hooks that have not been left, whom it serves and where."""

    __slots__ = ("calls", "hooks", "inside", "served")

    def __init__(self, inside: list[tuple[str, int]]) -> None:
        self.calls: list[BusinessCall] | None = None
        self.hooks: list[s.Hook] = []
        self.served: list[BusinessCall | None] = []
        self.inside = inside


class _Reading:
    """One trace being read: the model, the operation in progress, and who is inside whom on each thread.

    What takes an event in returns True where reading is to end, and else nothing.
    """

    __slots__ = (
        "calls",
        "connecting",
        "executions",
        "heard",
        "interactions",
        "judge",
        "ledger",
        "runtime",
        "steps",
        "threads",
        "watch",
        "window",
    )

    def __init__(self, judge: Judge, watch: Watch, scenario: s.Scenario, followed: frozenset[Where]) -> None:
        self.judge = judge
        self.watch = watch
        self.ledger = Ledger(scenario, judge.duties, claims=judge.claims)
        self.steps = scenario.steps
        self.runtime = Runtime(scenario)
        self.window: Window | None = None
        self.heard: dict[tuple[str, int], Heard] = {}
        self.calls: list[list[BusinessCall]] = []
        self.threads: dict[int, _Thread] = {}
        interacting = "interactions" in followed
        self.executions = Executions(self.runtime) if interacting else None
        self.interactions = Interactions(self.runtime) if interacting else None
        self.runtime.interactions = self.interactions
        self.runtime.executions = self.executions
        self.connecting: dict[int, Call] = {}

    def close(self) -> None:
        """The trace is over."""
        if self.interactions is not None:
            self.interactions.is_over, self.interactions.services = True, None
            for check in self.watch.closed:
                check(self.ledger, self.runtime)
        self.ledger.close()

    def thread(self, number: int) -> _Thread:
        """The thread of that number."""
        known = self.threads.get(number)
        if known is None:
            inside = self.runtime.inside[number] = []
            known = self.threads[number] = _Thread(inside)
        return known

    def call(self, event: Call) -> bool | None:
        step = self.steps[event.step]
        kind = type(step)
        is_operation = kind in _CONTAINER_CALLS
        if is_operation and self.window is not None:
            return True
        if self.interactions is not None:
            self.interactions.operate(step, event)
        if is_operation:
            self.window = self.judge.situations.open(self.runtime, event.step, step, event.n)  # type: ignore[arg-type]
        elif isinstance(step, s.Invoke):
            thread = self.threads.get(event.thread) or self.thread(event.thread)
            self.begin(thread, BusinessCall(step.value, event.n, None, step))
        else:
            self.connecting[event.step] = event
        return None

    def end(self, event: Return | Raise) -> None:
        window, ledger, runtime = self.window, self.ledger, self.runtime
        if self.interactions is not None:
            self.interactions.operated(event)
        if window is not None and window.step_number == event.step:
            for check in self.watch.ended[window.operation]:
                check(ledger, runtime, window, event)
            adopt(runtime, window, event)
            runtime.starting.clear()
            runtime.starting_up.clear()
            runtime.changed()
            self.window = None
            return
        step = self.steps[event.step]
        begin = self.connecting.pop(event.step, None) if self.connecting else None
        if begin is not None:
            self.end_connecting(step, begin, event)
            return
        thread = self.threads.get(event.thread)
        calls = thread.calls if thread is not None else None
        if calls and type(step) is s.Invoke:
            call = calls.pop()
            for check in self.watch.answered:
                check(ledger, runtime, call, event)
            if self.executions is not None:
                self.come_back(call, event.n)

    def end_connecting(self, step: s.Step, begin: Call, event: Return | Raise) -> None:
        if self.interactions is None:
            return
        if type(step) in _CONNECTOR_CALLS:
            link = self.interactions.linked(step, begin, event)  # type: ignore[arg-type]
            self.runtime.changed()
            for check in self.watch.linked:
                check(self.ledger, self.runtime, link, step, event)
        elif isinstance(event, Return):
            self.tell(event)

    def skip(self, event: Skip) -> None:
        if self.connecting.pop(event.step, None) is not None:
            self.runtime.not_offered.append(event)

    def tell(self, event: Return | Pushed | Counted | Paused | Stressed) -> None:
        if isinstance(event, Pushed) and self.interactions is not None:
            self.interactions.push(event)
        for check in self.watch.told if self.interactions is not None else ():
            check(self.ledger, self.runtime, event)

    def paused(self, event: Paused) -> None:
        if self.interactions is not None:
            self.interactions.pauses.append(event)
        self.tell(event)

    def create(self, event: Create) -> None:
        if self.window is not None:
            self.window.created.append((event.component, event.instance))

    def enter(self, event: Enter) -> None:
        thread = self.threads.get(event.thread) or self.thread(event.thread)
        hook = event.hook
        thread.hooks.append(hook)
        if hook == "exchange" and self.executions is None:
            self.enter_plainly(thread, event)
            return
        if hook in _BUSINESS:
            self.enter_business(thread, event)
            return
        body = event.component, event.instance
        heard = self.heard.get(body)
        if heard is None:
            heard = self.heard[body] = Heard()
        window, ledger, runtime = self.window, self.ledger, self.runtime
        for check in self.watch.entered[hook]:
            check(ledger, runtime, window, event, heard)
        heard.hear(hook, event.n)
        if hook == "on_startup":
            runtime.startups[body] = event.n, event.thread
        member = runtime.bodies.get(body)
        if member is not None:
            self.changes(member, hook)
            starts = window is not None and window.operation == "start" and window.container is member.container
            if hook == "on_startup" and starts:
                runtime.starting_up[body] = event.thread
        runtime.changed()
        if window is not None:
            window.hear(event)

    def changes(self, member: Member, hook: s.Hook) -> None:
        """What is so from now on, although the operation has not ended."""
        if hook == "on_startup":
            member.closing = False
            known = self.window is None or self.window.operation != "connect"
            member.handed_over = tuple([c for c in member.connections if c.live is not False]) if known else None
        elif hook == "on_shutdown":
            member.closing = True

    def enter_plainly(self, thread: _Thread, event: Enter) -> None:
        """As ``enter_business``, where nobody has interfaces or policies."""
        calls = thread.calls
        call = calls[-1] if calls else None
        if call is None or call.value != event.value:
            call = self.call_behind(event, call)
        body = event.component, event.instance
        thread.served.append(call)
        thread.inside.append(body)
        if call is not None:
            call.entries.append((event, None))
        runtime = self.runtime
        for check in self.watch.called[call.by if call is not None else "nobody"]:
            check(self.ledger, runtime, self.window, event, call)
        member = runtime.bodies.get(body)
        if member is not None and member.operational:
            member.served = True

    def enter_business(self, thread: _Thread, event: Enter) -> None:
        delivery = None
        hook = event.hook
        call: BusinessCall | None
        if hook == "method" and self.interactions is not None:
            delivery = self.interactions.enter(event)
            call = delivery.call.business if delivery.call is not None else None
        elif hook == "exchange":
            calls = thread.calls
            call = calls[-1] if calls else None
            if call is None or call.value != event.value:
                call = self.call_behind(event, call)
        else:
            call = None
        thread.served.append(call)
        body = event.component, event.instance
        thread.inside.append(body)
        ledger, runtime = self.ledger, self.runtime
        if self.executions is not None:
            execution, met = self.executions.begin(event, call)
            for check in self.watch.began:
                check(ledger, runtime, execution, met)
        if hook == "run":
            runtime.last_run[body] = event.n
            return
        if call is not None:
            call.entries.append((event, None))
        if delivery is not None:
            for check in self.watch.delivered:
                check(ledger, runtime, delivery)
        else:
            for check in self.watch.called[call.by if call is not None else "nobody"]:
                check(ledger, runtime, self.window, event, call)
        member = runtime.bodies.get(body)
        if member is not None and member.operational:
            member.served = True

    def exit(self, event: Exit) -> None:
        thread = self.threads.get(event.thread) or self.thread(event.thread)
        hook = event.hook
        if thread.hooks:
            thread.hooks.pop()
        if hook == "on_startup":
            self.runtime.starting.add((event.component, event.instance))
            self.runtime.starting_up.pop((event.component, event.instance), None)
        if hook not in _BUSINESS or not thread.served:
            return
        thread.inside.pop()
        if hook == "method" and self.interactions is not None:
            self.interactions.exit(event)
        call = thread.served.pop()
        if call is not None:
            call.close(event)
        if self.executions is None:
            return
        execution = self.executions.end(event)
        if execution is not None:
            for check in self.watch.over:
                check(self.ledger, self.runtime, execution, event.n)

    def call_behind(self, event: Enter, own: BusinessCall | None) -> BusinessCall | None:
        """The call of another thread that seems to have led to this entry, else this thread's ``own``."""
        waiting = [calls[-1] for calls in self.calls if calls and calls[-1].value == event.value]
        return waiting[-1] if waiting else own

    def request(self, event: Request) -> None:
        thread = self.threads.get(event.thread) or self.thread(event.thread)
        call = BusinessCall(event.value, event.n, event, None, thread.hooks[-1] if thread.hooks else "")
        if self.executions is not None:
            call.caller = self.executions.innermost(event.thread)
        self.begin(thread, call)
        if event.method is not None and self.interactions is not None:
            self.interactions.request(event, call)

    def begin(self, thread: _Thread, call: BusinessCall) -> None:
        call.look(self.runtime)
        if thread.calls is None:
            thread.calls = []
            self.calls.append(thread.calls)
        thread.calls.append(call)
        if self.executions is not None:
            self.executions.made(call)

    def reply(self, event: Reply) -> None:
        thread = self.threads.get(event.thread)
        calls = thread.calls if thread is not None else None
        if not calls:
            return
        call = calls.pop()
        if call.request is None or call.request.method is None:
            for check in self.watch.replied:
                check(self.ledger, self.runtime, call, event)
        elif self.interactions is not None:
            completed = self.interactions.reply(event)
            if completed is not None:
                for check in self.watch.completed:
                    check(self.ledger, self.runtime, completed)
        if self.executions is not None:
            self.come_back(call, event.n)

    def come_back(self, call: BusinessCall, end: int) -> None:
        waited = self.executions.answered(call) if self.executions is not None else None
        for check in self.watch.served if waited is not None else ():
            check(self.ledger, self.runtime, call, waited, end)

    def held(self, event: Held) -> None:
        if self.executions is not None:
            self.executions.hold(event)
        if self.interactions is not None:
            self.interactions.hold(event)

    def opened(self, event: Opened) -> None:
        if event.gate not in self.runtime.in_vain:
            self.runtime.opened.add(event.gate)
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
        step = self.steps[event.step]
        if isinstance(step, s.ReachGate):
            self.runtime.in_vain.add(step.gate)
        if self.executions is None and self.interactions is None:
            return
        if self.interactions is not None:
            self.interactions.wait(event)
        for check in self.watch.waited:
            check(self.ledger, self.runtime, event)
        if self.executions is not None and isinstance(step, s.Join):
            for call, waited in self.executions.lost():
                for check in self.watch.served:
                    check(self.ledger, self.runtime, call, waited, 0)

    def siblings(self, event: Siblings) -> None:
        for check in self.watch.noted:
            check(self.ledger, self.runtime, self.window, event)


_TAKE: dict[type[Any], Callable[[_Reading, Any], bool | None]] = {
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
"""What to do with each kind of event."""
