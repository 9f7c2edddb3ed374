"""The monitor: reads a trace and checks every property against it. Pure and offline: the same trace gives the same findings."""

from __future__ import annotations

import functools
from collections import defaultdict
from collections.abc import Callable, Iterable
from itertools import chain
from typing import Any, get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.reference_models.causes import Causes
from ucm_cts.reference_models.model.callback_history import Callback, CallbackHistory
from ucm_cts.reference_models.model.changing import Changing
from ucm_cts.reference_models.model.executions import BusinessCall
from ucm_cts.reference_models.model.expected_callbacks import ExpectedCallbacks
from ucm_cts.reference_models.model.hindrance import is_forgiving
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable
from ucm_cts.reference_models.model.log_contents import contents_read
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.operation_effects import apply
from ucm_cts.reference_models.model.operation_end import conclude
from ucm_cts.reference_models.model.row_selection import RowSelection
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.naming import Namer
from ucm_cts.reference_models.properties.declaration import Feature, Moment
from ucm_cts.reference_models.properties.table import PropertyTable, features_of
from ucm_cts.reference_models.verdicts import Verdicts

_BUSINESS = frozenset(("exchange", "run", "method"))
"""Hooks that are not callbacks of the life cycle."""

_NOTHING_HAPPENS = frozenset((t.Timeout, t.Settled))
_CONTAINER_CALLS = frozenset(get_args(s.ContainerCall))
_CONNECTOR_CALLS = frozenset(get_args(s.ConnectorCall))


class Monitor:
    """Checks traces against one life-cycle table and the vendor's statement. It holds no state between traces."""

    def __init__(self, table: LifeCycleTable, ics: Ics | None = None) -> None:
        self.ics = ics or Ics()
        self.row_selection = RowSelection(table)
        self.expected = ExpectedCallbacks(table)
        self._table_for = functools.cache(PropertyTable)

    def judge(self, scenario: s.Scenario, trace: Iterable[t.Event]) -> Verdicts:
        """What the properties say about ``trace``, which may break off anywhere, and is read event by event.

        Where two operations overlap, because one of them took too long, reading ends: it is open which of them an event belongs to.
        Findings name what they are about, and what caused them, only if ``trace`` can be read again; a stream takes no memory.
        """
        features = features_of(scenario)
        reader = _TraceReader(self, self._table_for(features), scenario, features)
        interactions = reader.runtime.interactions
        interacting = "interactions" in features
        for event in trace:
            if _TAKE[type(event)](reader, event):
                reader.check("overlapped", trace)
                break
            if interacting and type(event) not in _NOTHING_HAPPENS:
                interactions.latest = event.t
        reader.close()
        findings = reader.verdicts.findings
        if findings and isinstance(trace, tuple | list):
            findings[:] = map(Namer(scenario, trace).named, findings)
        if len(findings) > 1 and isinstance(trace, tuple | list):
            findings[:] = Causes(scenario, trace, reader.runtime.bodies).linked(findings)
        reader.runtime.dissolve()
        return reader.verdicts


class _Thread(Changing):
    """What one thread is doing.

    ``inside``: the bodies that it executes; ``served``: the calls that led there.
    ``calls``: its calls that have not come back; None while it has made none.
    ``hooks``: the hooks that have not been left.
    """

    inside: list[tuple[str, int]]
    calls: list[BusinessCall] | None = None
    hooks: list[s.Hook] = []
    served: list[BusinessCall | None] = []


class _TraceReader:
    """One trace being read: the model, the operation in progress, and the bodies that each thread executes.

    Methods that take an event return True where reading is to end, and else nothing.
    """

    def __init__(
        self, monitor: Monitor, table: PropertyTable, scenario: s.Scenario, features: frozenset[Feature]
    ) -> None:
        self.monitor = monitor
        self.table = table
        self.verdicts = Verdicts()
        self.steps = scenario.steps
        self.runtime = ObservedRuntime(scenario, monitor.ics, "interactions" in features)
        self.evaluate = functools.partial(self.verdicts.evaluate, self.runtime)
        self.evaluate_with = functools.partial(self.verdicts.evaluate_with, self.runtime)
        self.ongoing: OperationInProgress | None = None
        self.histories = defaultdict[tuple[str, int], CallbackHistory](CallbackHistory)
        self.calls: list[list[BusinessCall]] = []
        self.threads: dict[int, _Thread] = {}
        self.executions = self.runtime.executions
        self.interactions = self.runtime.interactions
        self.connecting: dict[int, t.Call] = {}

    def close(self) -> None:
        """The trace is over."""
        self.runtime.is_over, self.runtime.service_calls = True, None
        self.check("closed")
        self.verdicts.close()

    def check(self, moment: Moment, *details: object) -> None:
        """Add what the properties of ``moment`` conclude from ``details``."""
        if properties := self.table.at[moment]:
            self.evaluate(properties, *details)

    def suspend(self) -> None:
        """Apply to the model what properties concluded."""
        self.look_elsewhere()
        for member in self.verdicts.suspended:
            member.suspended = True
        self.verdicts.suspended.clear()

    def look_elsewhere(self) -> None:
        """Something is about to change: what the operation in progress found in other containers is asked now."""
        if self.ongoing is not None:
            is_forgiving(self.runtime, self.ongoing)

    def thread(self, number: int) -> _Thread:
        """The thread of that number."""
        known = self.threads.get(number)
        if known is None:
            inside = self.runtime.inside[number] = []
            known = self.threads[number] = _Thread(inside)
        return known

    def call(self, event: t.Call) -> bool | None:
        step = self.steps[event.step]
        is_operation = type(step) in _CONTAINER_CALLS
        if is_operation and self.ongoing is not None:
            return True
        self.interactions.operate(step, event)
        if is_operation:
            self.ongoing = self.monitor.row_selection.open(self.runtime, event.step, step, event.n)  # type: ignore[arg-type]
            self.runtime.ending = self.ongoing if step.undoes == "phase" else None
        elif isinstance(step, s.Invoke):
            thread = self.threads.get(event.thread) or self.thread(event.thread)
            self.begin(thread, BusinessCall(step.value, event.n, None, step))
        else:
            self.connecting[event.step] = event
        return None

    def end(self, event: t.Return | t.Raise) -> None:
        ongoing, runtime, verdicts = self.ongoing, self.runtime, self.verdicts
        self.interactions.operated(event)
        if ongoing is not None and ongoing.step_number == event.step:
            conclude(runtime, ongoing, event, self.monitor.expected)
            ended = self.table.ended_after_removal if ongoing.is_after_removal else self.table.ended
            self.evaluate_with(ended[ongoing.operation], ongoing)
            unsettled = self.table.unsettled[ongoing.operation]
            if unsettled and not ongoing.judged and not ongoing.is_after_removal and not verdicts.findings:
                self.evaluate_with(unsettled, ongoing)
            if verdicts.suspended:
                self.suspend()
            apply(runtime, ongoing, event)
            runtime.starting.clear()
            runtime.starting_up.clear()
            runtime.changed()
            self.ongoing = runtime.ending = None
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
            self.claim_entry(call, event.value if isinstance(event, t.Return) else None, isinstance(event, t.Raise))
            self.check("answered", call, event)
            self.come_back(call, event.n)

    def end_connecting(self, step: s.Step, begin: t.Call, event: t.Return | t.Raise) -> None:
        if type(step) in _CONNECTOR_CALLS:
            self.look_elsewhere()
            link = self.interactions.linked(step, begin, event)  # type: ignore[arg-type]
            self.runtime.changed()
            self.check("linked", link, step, event)
        elif isinstance(event, t.Return) and event.records is not None:
            contents = contents_read(self.runtime, event)
            if contents is not None:
                self.check("read", contents)

    def skip(self, event: t.Skip) -> None:
        if self.connecting.pop(event.step, None) is not None:
            self.runtime.not_offered.append(event)

    def pushed(self, event: t.Pushed) -> None:
        self.interactions.push(event)
        self.check("pushed", event)

    def counted(self, event: t.Counted) -> None:
        self.check("counted", event)

    def stressed(self, event: t.Stressed) -> None:
        self.check("stressed", event)

    def paused(self, event: t.Paused) -> None:
        self.interactions.pause(event)

    def create(self, event: t.Create) -> None:
        if self.ongoing is not None:
            self.ongoing.created.append(event.body)

    def enter(self, event: t.Enter) -> None:
        thread = self.threads.get(event.thread) or self.thread(event.thread)
        hook = event.hook
        thread.hooks.append(hook)
        if hook in _BUSINESS:
            self.enter_business(thread, event)
            return
        body = event.body
        history = self.histories[body]
        ongoing, runtime = self.ongoing, self.runtime
        member = runtime.bodies.get(body)
        callback = Callback(event, member, ongoing, history)
        self.evaluate_with(self.table.entered[hook], callback)
        if self.verdicts.suspended:
            self.suspend()
        unclear = self.table.unclear[hook]
        if unclear and not self.verdicts.findings:
            self.evaluate_with(unclear, callback)
        history.add(hook, event.n)
        if hook == "on_startup":
            runtime.startups[body] = event.n, event.thread
            self.executions.start_up(event)
        if member is not None:
            self.changes(member, hook)
            starts = ongoing is not None and ongoing.operation == "start" and ongoing.container is member.container
            if hook == "on_startup" and starts:
                runtime.starting_up[body] = event.thread
        runtime.changed()
        if ongoing is not None:
            ongoing.add(event, body)

    def changes(self, member: Member, hook: s.Hook) -> None:
        """The state of ``member`` changes at this callback, not at the end of the operation."""
        if hook in ("on_startup", "on_shutdown"):
            member.phase = hook
        elif hook == "on_remove":
            member.told_of_removal = True
        if hook == "on_startup":
            member.closing = False
            known = self.ongoing is None or self.ongoing.operation != "connect"
            member.handed_over = tuple([c for c in member.connections if c.live is not False]) if known else None
        elif hook == "on_shutdown":
            member.closing = True

    def enter_business(self, thread: _Thread, event: t.Enter) -> None:
        delivery = None
        hook = event.hook
        call: BusinessCall | None
        if hook == "method":
            delivery = self.interactions.enter(event)
            call = delivery.call.business if delivery is not None and delivery.call is not None else None
        elif hook == "exchange":
            calls = thread.calls
            call = calls[-1] if calls else None
            if call is None or (call.value != event.value and not event.wrong):
                call = self.call_behind(event, call)
        else:
            call = None
        thread.served.append(call)
        thread.inside.append(event.body)
        self.check("began", self.executions.begin(event, call))
        if hook == "run":
            return
        if call is not None:
            call.entries.append((event, None))
        if delivery is not None:
            self.check("delivered", delivery)
        else:
            self.evaluate(self.table.called[call.by if call is not None else "framework"], self.ongoing, event, call)
        member = self.runtime.bodies.get(event.body)
        if member is not None and member.operational:
            member.serve()

    def exit(self, event: t.Exit) -> None:
        thread = self.threads.get(event.thread) or self.thread(event.thread)
        hook = event.hook
        if thread.hooks:
            thread.hooks.pop()
        if hook not in _BUSINESS:
            body = event.body
            if self.ongoing is not None:
                self.ongoing.leave(body, hook)
            if hook == "on_startup":
                self.executions.start_up(event)
                self.runtime.starting.add(body)
                self.runtime.starting_up.pop(body, None)
            return
        if not thread.served:
            return
        thread.inside.pop()
        if hook == "method":
            self.interactions.exit(event)
        call = thread.served.pop()
        if call is not None:
            call.close(event)
        execution = self.executions.end(event)
        if execution is not None:
            self.check("over", execution, event.n)

    def call_behind(self, event: t.Enter, own: BusinessCall | None) -> BusinessCall | None:
        """The call of another thread that seems to have led to this entry, else this thread's ``own``. No call of a method leads there."""
        newest = [calls[-1] for calls in self.calls if calls]
        waiting = [call for call in newest if call.value == event.value and not call.is_of_method]
        waiting = [call for call in waiting if not call.entries] or waiting
        if len(waiting) > 1:
            waiting = [call for call in waiting if call.is_meant_for(event)] or waiting
        return waiting[-1] if waiting else own

    def request(self, event: t.Request) -> None:
        thread = self.threads.get(event.thread) or self.thread(event.thread)
        call = BusinessCall(event.value, event.n, event, None, thread.hooks[-1] if thread.hooks else "")
        call.caller = self.executions.innermost(event.thread)
        self.begin(thread, call)
        if event.method is not None:
            self.interactions.request(event, call)

    def begin(self, thread: _Thread, call: BusinessCall) -> None:
        call.resolve(self.runtime)
        if thread.calls is None:
            thread.calls = []
            self.calls.append(thread.calls)
        thread.calls.append(call)
        self.executions.made(call)

    def reply(self, event: t.Reply) -> None:
        thread = self.threads.get(event.thread)
        calls = thread.calls if thread is not None else None
        if not calls:
            return
        call = calls.pop()
        if call.request is None or call.request.method is None:
            self.claim_entry(call, event.value, event.raised)
            self.check("replied", call, event)
        else:
            completed = self.interactions.reply(event)
            if completed is not None:
                self.check("completed", completed)
        self.come_back(call, event.n)

    def claim_entry(self, call: BusinessCall, value: object, raised: bool) -> None:
        """If ``call`` comes back and seems to have entered no body, its entry may have been taken for that of a call like it."""
        claimed = call.claim(chain(*self.calls), value, raised) if not call.entries else None
        if claimed is not None:
            self.executions.claimed(call, *claimed)

    def come_back(self, call: BusinessCall, end: int) -> None:
        waited = self.executions.answered(call)
        if waited is not None:
            self.check("served", call, waited, end)

    def held(self, event: t.Held) -> None:
        self.executions.hold(event)
        self.interactions.hold(event)

    def opened(self, event: t.Opened) -> None:
        if event.gate not in self.runtime.in_vain:
            self.runtime.opened.add(event.gate)
        self.executions.open(event)
        self.interactions.open(event)

    def settled(self, event: t.Settled) -> None:
        self.executions.settle(event)
        self.interactions.settle(event)

    def timeout(self, event: t.Timeout) -> None:
        step = self.steps[event.step]
        if isinstance(step, s.ReachGate):
            self.runtime.in_vain.add(step.gate)
        self.interactions.wait(event)
        self.check("waited", event)
        if isinstance(step, s.Join):
            for call, waited in self.executions.lost():
                self.check("served", call, waited, 0)

    def siblings(self, event: t.Siblings) -> None:
        self.check("noted", self.ongoing, event)


_TAKE: dict[type[Any], Callable[[_TraceReader, Any], bool | None]] = {
    t.Call: _TraceReader.call,
    t.Return: _TraceReader.end,
    t.Raise: _TraceReader.end,
    t.Skip: _TraceReader.skip,
    t.Create: _TraceReader.create,
    t.Enter: _TraceReader.enter,
    t.Exit: _TraceReader.exit,
    t.Request: _TraceReader.request,
    t.Reply: _TraceReader.reply,
    t.Siblings: _TraceReader.siblings,
    t.Held: _TraceReader.held,
    t.Opened: _TraceReader.opened,
    t.Settled: _TraceReader.settled,
    t.Timeout: _TraceReader.timeout,
    t.Pushed: _TraceReader.pushed,
    t.Counted: _TraceReader.counted,
    t.Paused: _TraceReader.paused,
    t.Stressed: _TraceReader.stressed,
}
"""What to do with each kind of event."""
