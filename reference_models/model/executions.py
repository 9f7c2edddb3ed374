"""Business calls and executions of bodies, and the calls that were seen waiting for an execution (11.1.3, 10.1.3).

Overlap is proved, not guessed: a call *waited* for an execution if it had been made, and the worker that made it was looked
for and found waiting, while the execution was held at a gate that had not been opened.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter, Exit, Held, Opened, Request, Settled
from ucm_cts.reference_models.model.changing import Changing
from ucm_cts.reference_models.model.execution_policies import protection_of
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.runtime import Behind, Connection, Container, Member, Runtime

Caller = Literal["test", "body", "framework"]
"""Who made the call that led to an entry; ``framework`` if there was no call."""


class BusinessCall(Changing):
    """One call of the probes' business method.

    ``value``, ``n``: the value sent, and the event that begins the call.
    ``request``, ``step``: how it was made; by a body or by the test.
    ``caller``, ``caller_hook``: the execution and the hook of the body that makes it.
    ``waited``: it was seen waiting to get in.
    ``entries``: the bodies it entered, with how they were left.
    ``callee``, ``port``: the instance and port element that the test called.
    ``possible``: all instances that could be called were operational when the call was made.
    ``behind``, ``behind_since``: what was behind the port element after so many changes of the runtime.
    """

    value: int
    n: int
    request: Request | None = None
    step: s.Invoke | None = None
    caller_hook: str = ""
    callee: Member | None = None
    port: str | None = None
    possible: bool = False
    behind: Behind | None = None
    behind_since: int = 0
    caller: Execution | None = None
    waited: bool = False
    entries: list[tuple[Enter, Exit | None]] = []

    @property
    def by(self) -> Caller:
        """Who made it."""
        return "body" if self.step is None else "test"

    @property
    def is_of_method(self) -> bool:
        """Does a body call a method with it, and not ``exchange``?"""
        return self.request is not None and self.request.method is not None

    @property
    def worker(self) -> str | None:
        """The worker whose step it is that led to this call."""
        call = self
        while call.caller is not None and call.caller.call is not None:
            call = call.caller.call
        return call.step.thread if call.step is not None else None

    def resolve(self, runtime: Runtime) -> None:
        """Note which instance is called, and whether a call is possible."""
        request = self.request
        if self.step is not None:
            _, self.callee = runtime.reference(self.step.ref)
            self.port = runtime.ports.get(self.step.ref)
            self.possible = self.callee is not None and self.callee.serving
        elif request is not None:
            self.possible = True
            self.behind = behind(runtime, request.body, request.port)
            self.behind_since = runtime.changes
            for provider in self.behind.providers:
                if provider.closing or provider.suspended or not provider.operational:
                    self.possible = False
                    break

    def callers(self, at: int = 0) -> Iterator[Execution]:
        """The executions that wait for this call when it is made, or at event ``at``, the innermost first.

        One that had ended by then, because what it pushed was not waited for, waits no longer.
        """
        caller = self.caller
        while caller is not None and not (caller.over and caller.end < (at or self.n)):
            yield caller
            caller = caller.call.caller if caller.call is not None else None

    def leads_back_to(self, member: Member) -> bool:
        """Does an execution of ``member`` wait for this call?"""
        return any(caller.enter.body == member.body for caller in self.callers())

    def is_like(self, other: BusinessCall) -> bool:
        """Does it call ``exchange`` of the same port elements with the same value, so that an entry does not show which one led to it?"""
        if other is self or other.value != self.value or self.is_of_method or other.is_of_method:
            return False
        if self.step is not None:
            return other.step is not None and (other.callee, other.port) == (self.callee, self.port)
        return other.step is None and self.behind is not None and other.behind == self.behind

    def is_meant_for(self, entry: Enter) -> bool:
        """Does it call the instance and port element that ``entry`` enters, as far as that is known?"""
        if self.step is not None:
            return self.callee is not None and (self.callee.body, self.port) == (entry.body, entry.port)
        return self.behind is not None and (*entry.body, entry.port) in self.behind.targets

    def claim(self, waiting: Iterable[BusinessCall], value: object, raised: bool) -> tuple[BusinessCall, Enter] | None:
        """It comes back with ``value``, or with an exception, and seems to have entered no body: if a call like it, which is still
        ``waiting``, was taken for it at an entry that ended so, the entry is its own. Returns the other call and the entry.
        """
        for other in filter(self.is_like, waiting):
            for enter, exit_ in other.entries:
                if exit_ is not None and enter.n > self.n and (exit_.raised, exit_.value) == (raised, value):
                    other.entries.remove((enter, exit_))
                    self.entries.append((enter, exit_))
                    return other, enter
        return None

    def close(self, end: Exit) -> None:
        """The innermost entry of that body came to its end."""
        for index in range(len(self.entries) - 1, -1, -1):
            enter, exit_ = self.entries[index]
            if exit_ is None and enter.body == end.body:
                self.entries[index] = (enter, end)
                return


class Execution(Changing):
    """A body inside ``exchange`` or ``run``.

    ``enter``, ``call``: how it was entered, and by which call.
    ``gate``: where it is held.
    ``waited``: calls that were seen waiting meanwhile.
    ``over``, ``left``, ``end``, ``failed``: whether it has ended, when (``t``), by which event (``n``), and whether with an exception.
    ``earlier``: the body's runs before this one.
    ``met``: other executions that were in the body when this one began, and not among its callers.
    """

    enter: Enter
    call: BusinessCall | None
    gate: str | None = None
    waited: list[BusinessCall] = []
    over: bool = False
    left: int = 0
    end: int = 0
    failed: bool = False
    earlier: list[Execution] = []
    met: list[Execution] = []

    @property
    def way(self) -> str:
        """The port element it came through, or ``run``."""
        return self.enter.port or "run"


class Executions:
    """All executions in progress in one trace, by body.

    ``pending``: the calls that have not entered a body yet and not come back.
    ``calls``: all calls.
    ``startups``: entry into and exit from each on_startup, by body.
    ``waiting``: the calls that wait for an execution, by the event that begins them.
    ``past``: what each body has executed, in the order in which it ended.
    """

    def __init__(self, runtime: Runtime) -> None:
        self._runtime = runtime
        self._inside: dict[tuple[str, int], list[Execution]] = {}
        self._on: dict[int, list[Execution]] = {}
        self._runs: dict[tuple[str, int], list[Execution]] = {}
        self.past = defaultdict[tuple[str, int], list[Execution]](list)
        self._opened: set[str] = set()
        self.pending: list[BusinessCall] = []
        self.calls: list[BusinessCall] = []
        self.startups = defaultdict[tuple[str, int], list[tuple[Enter, Exit | None]]](list)
        self.waiting: dict[int, tuple[BusinessCall, Execution]] = {}

    def made(self, call: BusinessCall) -> None:
        """A call has been made."""
        self.pending.append(call)
        self.calls.append(call)

    def start_up(self, event: Enter | Exit) -> None:
        """on_startup of a body begins or ends."""
        known = self.startups[event.body]
        if isinstance(event, Enter):
            known.append((event, None))
        elif known:
            known[-1] = known[-1][0], event

    def of(self, body: tuple[str, int]) -> list[Execution]:
        """All executions of the body, in the order in which they began."""
        return sorted([*self.past[body], *self._inside.get(body, ())], key=lambda execution: execution.enter.n)

    def answered(self, call: BusinessCall) -> Execution | None:
        """A call is over; returns the execution it had waited for."""
        if call in self.pending:
            self.pending.remove(call)
        waited = self.waiting.pop(call.n, None)
        return waited[1] if waited is not None else None

    def claimed(self, call: BusinessCall, other: BusinessCall, enter: Enter) -> None:
        """``call`` has claimed the entry ``enter`` from ``other``."""
        if not other.entries:
            self.pending.append(other)
        for execution in self.past[enter.body]:
            if execution.enter is enter:
                execution.call = call

    def lost(self) -> list[tuple[BusinessCall, Execution]]:
        """Calls that have no answer although the execution they waited for is over. Each is returned once."""
        lost = {n: waiting for n, waiting in self.waiting.items() if waiting[1].over}
        for n in lost:
            del self.waiting[n]
        return list(lost.values())

    def begin(self, enter: Enter, call: BusinessCall | None) -> Execution:
        """A body is entered."""
        inside = self._inside.setdefault(enter.body, [])
        execution = Execution(enter, call)
        if enter.hook == "run":
            runs = self._runs.setdefault(enter.body, [])
            execution.earlier = runs.copy()
            runs.append(execution)
        others = [other for other in inside if other.enter.thread != enter.thread] if inside else []
        if others:
            callers = {id(caller) for caller in call.callers()} if call is not None else set()
            execution.met = [other for other in others if id(other) not in callers]
        inside.append(execution)
        self._on.setdefault(enter.thread, []).append(execution)
        if call in self.pending:
            self.pending.remove(call)
        return execution

    def is_alone(self, execution: Execution) -> bool:
        """Is nothing else being executed in its body?"""
        return len(self._inside[execution.enter.body]) == 1

    def innermost(self, thread: int) -> Execution | None:
        """The execution in progress on ``thread``."""
        own = self._on.get(thread)
        return own[-1] if own else None

    def end(self, exit_: Exit) -> Execution | None:
        """A body is left."""
        inside = self._inside.get(exit_.body, [])
        for execution in reversed(inside):
            if execution.enter.thread == exit_.thread and execution.enter.hook == exit_.hook:
                inside.remove(execution)
                on = self._on[exit_.thread]
                if on[-1] is execution:
                    on.pop()
                else:
                    on.remove(execution)
                execution.over = True
                execution.left, execution.end, execution.failed = exit_.t, exit_.n, exit_.failed
                self.past[exit_.body].append(execution)
                return execution
        return None

    def runs_since_start(self, body: tuple[str, int]) -> list[Execution]:
        """The body's executions by ``run`` since its last on_startup, over or not, in the order in which they began."""
        started = self._runtime.startups.get(body)
        runs = self._runs.get(body, ())
        return [run for run in runs if started is not None and run.enter.n > started[0]]

    def hold(self, event: Held) -> None:
        """An execution is held at a gate."""
        for execution in self._inside.get(event.body, ()):
            if execution.enter.thread == event.thread and event.gate not in self._opened:
                execution.gate = event.gate

    def open(self, event: Opened) -> None:
        """A gate was opened: no body is held there any more."""
        self._opened.add(event.gate)
        for inside in self._inside.values():
            for execution in inside:
                if execution.gate == event.gate:
                    execution.gate = None

    def settle(self, event: Settled) -> None:
        """A worker was found: if it waits, its pending call waits for the execution that is held where the call goes."""
        if event.where not in ("blocked", "running"):
            return
        for call in (c for c in self.pending if c.worker == event.worker):
            for member, _ in goals_of(self._runtime, call):
                for execution in self._inside.get(member.body, ()):
                    if execution.gate is not None and call not in execution.waited:
                        execution.waited.append(call)
                        call.waited = True
                        self.waiting[call.n] = call, execution


def without_policy(runtime: Runtime, container: Container) -> list[Member]:
    """The members of ``container`` without execution policy, where that is the only reason to refuse its start; none in a scenario that
    knows no policies.
    """
    if not runtime.knows_policies or container.started:
        return []
    members = container.live_members()
    if any(not m.connected or m.raises("on_startup") for m in members):
        return []
    return [m for m in members if not protection_of(m.declaration)]


def guards_direct_calls(ics: Ics) -> bool:
    """Does the container guard the references that the test itself calls (``raw-references``)?"""
    return ics.reading("raw-references") != "unprotected"


def is_guarded(ics: Ics, *executions: Execution) -> bool:
    """Must the container keep these executions apart, or did the test enter through a reference that is declared unprotected?"""
    return guards_direct_calls(ics) or not any(e.call and e.call.by == "test" for e in executions)


def goals_of(runtime: Runtime, call: BusinessCall) -> list[tuple[Member, str]]:
    """Whose provided port elements a call is meant for; empty if that is not known."""
    if call.request is None:
        return [(call.callee, call.port)] if call.callee is not None and call.port is not None else []
    caller = runtime.bodies.get(call.request.body)
    if caller is None or not behind(runtime, call.request.body, call.request.port).providers:
        return []
    connections = connections_behind(caller, call.request.port)
    return [(c.provider, c.provided) for c in connections if c.provider is not None]


_NOTHING_KNOWN = Behind((), True, frozenset())


def behind_call(runtime: Runtime, call: BusinessCall, request: Request) -> Behind:
    """What is now behind the port element that a body called through."""
    if call.behind is not None and call.behind_since == runtime.changes:
        return call.behind
    return behind(runtime, request.body, request.port)


def behind(runtime: Runtime, body: tuple[str, int], port: str) -> Behind:
    """What is behind required port element ``port`` of ``body``."""
    known = runtime.behind.get((body, port))
    if known is None:
        known = runtime.behind[body, port] = _found_behind(runtime.bodies.get(body), port)
    return known


def _found_behind(caller: Member | None, port: str) -> Behind:
    if caller is None or caller.suspended or caller.handed_over is None:
        return _NOTHING_KNOWN
    connections = connections_behind(caller, port)
    providers = [(c.provider, c.provided) for c in connections if c.provider is not None]
    if len(providers) < len(connections):
        return _NOTHING_KNOWN
    targets = frozenset([(p.component, p.instance, provided) for p, provided in providers])
    fragments = all(provider.declaration.fragment for provider, _ in providers)
    return Behind(tuple([provider for provider, _ in providers]), fragments, targets)


def connections_behind(caller: Member, port: str) -> list[Connection]:
    """What may be behind ``port``: connections that stand, or stood when the caller was started."""
    return [
        c for c in caller.connections if c.port == port and (c.live is not False or c in (caller.handed_over or ()))
    ]
