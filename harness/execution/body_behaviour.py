"""Bodies and threads of a trace: in which body each thread is, and whether each body acts as its plan says."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.scenario import Declaration, Scenario
from ucm_cts.harness.execution.planned_actions import (
    Act,
    Due,
    Plan,
    as_entered,
    depends_on_entries,
    is_as_planned,
    plan_of,
)
from ucm_cts.reference_models.model.service_policies import has_timers

_NONE_HELD: dict[str, int] = {}
"""The references of a body that was given none. It stays empty."""


class Body:
    """An instance of a component; ``held`` are the numbers of references of each port element that it has held, one after the
    other: now the last ones. ``entries`` are those at methods, if what it calls depends on its entries. ``timers`` are the object timers
    that came to it: by which method, and the event.
    """

    __slots__ = ("declaration", "depends_on_entries", "entries", "held", "plans", "timers")

    def __init__(self, declaration: Declaration) -> None:
        self.declaration = declaration
        self.depends_on_entries = depends_on_entries(declaration)
        self.entries: list[t.Enter] = []
        self.held = [_NONE_HELD]
        self.plans: dict[str, Plan] = {}
        self.timers: list[tuple[str, int]] = []

    def take_timer(self, method: str | None, event: t.Enter | t.Reply) -> str | None:
        """It gets an object timer by ``method``, if the event tells one; what is wrong with its number."""
        if event.timer is None:
            return None
        self.timers.append((method or "", event.n))
        due = len(self.timers)
        return None if event.timer == due else f"timer {event.timer} came after {due - 1}"

    def plan(self, hook: s.Hook) -> Plan:
        """Its plan for ``hook``."""
        plan = self.plans.get(hook)
        if plan is None:
            plan = self.plans[hook] = plan_of(self.declaration, hook)
        return plan

    def be_given(self, dependencies: tuple[t.Dependency, ...]) -> None:
        """It gets the references of its port elements."""
        held: dict[str, int] = {}
        for dependency in dependencies:
            given = sum(reference is not None for reference in dependency.references)
            held[dependency.port] = held.get(dependency.port, 0) + given
        self.held.append(held)

    def held_since(self, moment: int) -> tuple[dict[str, int], ...]:
        """What it has held since then, each once."""
        if moment == len(self.held) - 1:
            return (self.held[-1],)
        found: list[dict[str, int]] = []
        for held in self.held[moment:]:
            if held not in found:
                found.append(held)
        return tuple(found)


class Frame:
    """An activity on a thread: an operation, a call that a body makes, or a call of ``body``. ``acts`` are the actions of that
    body so far, ``replies`` what came back, by request, if what it calls depends on that, and ``began`` is the place in its ``held`` at the
    beginning.
    """

    __slots__ = ("acts", "began", "body", "event", "replies")

    def __init__(self, event: t.Call | t.Enter | t.Request, body: Body | None = None) -> None:
        self.event = event
        self.body = body
        self.acts: list[Act] = []
        self.replies: dict[int, t.Reply] = {}
        self.began = len(body.held) - 1 if body is not None else 0


class Thread:
    """A thread of the trace: its ``number``, the time of its last event (``clock``), and its open activities (``frames``)."""

    __slots__ = ("clock", "frames", "number")

    def __init__(self, number: int) -> None:
        self.number = number
        self.clock: int | None = None
        self.frames: list[Frame] = []

    def entered(self, event: t.BodyEvent) -> Frame | None:
        """The activity in which the body of ``event`` acts; None if this thread is not inside that body."""
        frame = self.frames[-1] if self.frames else None
        inside = frame.event if frame is not None else None
        if type(inside) is t.Enter and inside.instance == event.instance and inside.component == event.component:
            return frame
        return None


class BodyChecks:
    """Follows bodies event by event. Each check returns what is wrong with its event, None if nothing is."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.made: dict[str, list[Body]] = {name: [] for name in scenario.components}

    def exists(self, component: str, instance: int) -> bool:
        """Has this instance been made?"""
        return 1 <= instance <= len(self.made.get(component, ()))

    def body(self, event: t.BodyEvent) -> Body | None:
        """The body that the event is about; None if it was never made."""
        made = self.made.get(event.component)
        return made[event.instance - 1] if made and 1 <= event.instance <= len(made) else None

    def why_outside(self, event: t.BodyEvent) -> str:
        """Why the body that acts cannot do so: it was never made, or is not entered."""
        if event.component not in self.made:
            return f"there is no component {event.component}"
        if not self.exists(event.component, event.instance):
            return f"instance {event.instance} of {event.component} was never made"
        return f"{event.component} acts without having been entered"

    def check_create(self, event: t.Create, thread: Thread) -> str | None:
        bodies = self.made.get(event.component)
        if bodies is None:
            return self.why_outside(event)
        bodies.append(Body(self.scenario.components[event.component]))
        due = len(bodies)
        return None if event.instance == due else f"instance {event.instance} is made after {due - 1}"

    def check_enter(self, event: t.Enter, thread: Thread) -> str | None:
        body = self.body(event)
        if body is None:
            return self.why_outside(event)
        problem = _entry_problem(body.declaration, event)
        if event.dependencies is not None:
            body.be_given(event.dependencies)
        if body.depends_on_entries and event.hook == "method":
            body.entries.append(event)
        thread.frames.append(Frame(event, body))
        return body.take_timer(event.method, event) or problem

    def check_request(self, event: t.Request, thread: Thread) -> str | None:
        body = self.body(event)
        if body is None:
            return self.why_outside(event)
        within = next((frame for frame in reversed(thread.frames) if frame.body is not None), None)
        if within is not None:
            within.acts.append(event)
        thread.frames.append(Frame(event))
        declaration = body.declaration
        known = event.port in declaration.requires or event.port in [p.element for p in declaration.policies]
        if not known:
            return f"a request through {event.port!r}"
        if event.handler is not None and event.handler not in declaration.handlers:
            return f"a request with handler {event.handler!r}"
        had = event.timer is None or 1 <= event.timer <= len(body.timers)
        return None if had else f"a request on timer {event.timer} of {len(body.timers)}"

    def check_reply(self, event: t.Reply, thread: Thread) -> str | None:
        asked = thread.frames[-1].event if thread.frames else None
        same = isinstance(asked, t.Request) and asked.port == event.port and asked.instance == event.instance
        if not same or asked.component != event.component:  # type: ignore[union-attr]
            exists = self.exists(event.component, event.instance)
            return "a reply without its request" if exists else self.why_outside(event)
        thread.frames.pop()
        within = thread.frames[-1] if thread.frames else None
        if within is not None and within.body is not None and within.body.depends_on_entries:
            within.replies[asked.n] = event  # type: ignore[union-attr]
        body = self.body(event)
        assert isinstance(asked, t.Request)
        problem = body.take_timer(asked.method, event) if body is not None else None
        return problem or _reply_problem(asked, event)

    def check_act(self, event: t.Pushed | t.Siblings | t.Held, thread: Thread) -> str | None:
        frame = thread.entered(event)
        if frame is None or frame.body is None:
            return self.why_outside(event)
        frame.acts.append(event)
        if isinstance(event, t.Siblings) and len(event.ids) > t.MOST:
            return f"get_components of the container interface returned more than {t.MOST} ids"
        if isinstance(event, t.Pushed):
            answers = sum(event.answers.values())
            return None if answers == event.count else f"{answers} answers to {event.count} messages"
        if isinstance(event, t.Held):
            actions = frame.body.plan(frame.event.hook).actions  # type: ignore[union-attr]
            if event.gate not in {a.gate for a in actions if isinstance(a, s.HoldAtGate)}:
                return f"held at {event.gate!r}, which the plan does not name"
        return None

    def check_exit(self, event: t.Exit, thread: Thread) -> str | None:
        frame = thread.entered(event)
        if frame is None or frame.body is None:
            return self.why_outside(event)
        thread.frames.pop()
        enter, body, acts = frame.event, frame.body, frame.acts
        assert isinstance(enter, t.Enter)
        if enter.hook != event.hook:
            return f"{event.hook} is left where {enter.hook} was entered"
        plan = body.plan(enter.hook)
        actions: tuple[Due, ...] = plan.actions
        raises, returned = plan.raises, plan.returns
        if event.raised != raises:
            return f"{event.hook} {'raised' if event.raised else 'did not raise'} against its plan"
        if event.hook == "method" and not event.raised:
            due = _due_results(plan, enter, body.declaration)
            if (event.results, event.exception) != due:
                return f"{enter.method} gave {event.results!r}, its plan says {due[0]!r}"
        if body.depends_on_entries:
            actions = as_entered(plan.actions, acts, enter, body.entries, frame.replies, body.timers)
        # most bodies have nothing to do
        if (actions or acts) and not is_as_planned(actions, acts, body.held_since(frame.began), frame.replies):
            return f"{event.component} did not act in {event.hook} as its plan says"
        if event.hook == "on_shutdown":
            body.held.append(_NONE_HELD)
        if event.hook != "exchange" or event.raised or enter.value is None:
            return None
        value = ~enter.value if returned is None else returned
        return None if event.value == value else f"exchange returned {event.value}, its plan says {value}"


def _due_results(plan: Plan, enter: t.Enter, declaration: Declaration) -> tuple[tuple[Datum, ...] | None, str | None]:
    """The results of a method, and the exception with which it ends."""
    answers = [a for a in plan.actions if isinstance(a, s.Answer) and a.method == enter.method]
    if not answers or _is_trigger(declaration, enter):
        return (), None
    own = answers[-1].results
    return enter.arguments if own is None else own, answers[-1].exception


def _is_trigger(declaration: Declaration, event: t.Enter) -> bool:
    """Does an object timer call a handler of the body (10.3.1)?"""
    return event.hook == "method" and event.method == s.ON_TRIGGER and event.port in declaration.handlers


def _reply_problem(asked: t.Request, event: t.Reply) -> str | None:
    """Why a request cannot have ended so: timers come back from schedulers alone, and they give nothing else."""
    if asked.handler is None or event.failed or event.wrong:
        return None if event.timer is None else f"timer {event.timer} comes back from {asked.method}"
    if event.results:
        return f"{asked.method} gives {event.results!r} for a timer"
    lacks = event.timer is None and asked.method == s.SCHEDULE_ONCE
    return f"{asked.method} gives no timer" if lacks else None


def _entry_problem(declaration: Declaration, event: t.Enter) -> str | None:
    """Why a body of this declaration cannot be entered so."""
    hook = event.hook
    is_trigger = _is_trigger(declaration, event)
    if (event.timer is not None) != (is_trigger and not event.wrong):
        return f"{event.method or hook} with timer {event.timer}"
    if (hook == "on_startup") != (event.dependencies is not None):
        return f"{hook} {'with' if event.dependencies is not None else 'without'} dependencies"
    if hook == "exchange":
        right = (event.value is not None or bool(event.wrong)) and event.port in declaration.provides
        return None if right else f"exchange on {event.port!r} with {event.value!r}"
    if hook == "method":
        known = event.port in declaration.ports or is_trigger
        known = known or (event.port == s.TIMER_CALLBACK and has_timers(declaration, s.INDEX_TIMERS))
        right = event.method is not None and event.arguments is not None and known
        return None if right else f"method {event.method!r} on {event.port!r}"
    if hook == "run" and not any(s.is_self_executing(policy.definition) for policy in declaration.policies):
        return "run of a component that does not execute by itself"
    if hook in ("on_connect", "on_disconnect") and not declaration.connectable:
        return f"{hook} on a body that is not Connectable"
    if hook == "set_container_interface" and not declaration.fragment:
        return "set_container_interface on a body that is no fragment"
    return None
