"""Sequence diagrams, laid out: which lanes stand side by side and which line follows which. Drawing is done elsewhere.

Lanes are ``test``, the containers, and the bodies (``client#1``), each in order of appearance. A line is one arrow
or note; an event and its answer share a line when nothing came between them and neither is under suspicion.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from ucm_cts.adapters.contract import trace as t
from ucm_cts.harness.report.diagrams.wording import Wording, body_key
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Execution
from ucm_cts.reference_models.model.runtime import lane

TEST = "test"

LABEL = 120
"""Characters of the longest label."""

Style = Literal["normal", "offending", "expected"]
LineKind = Literal["call", "answer", "note", "gap", "end"]


@dataclass(frozen=True)
class Lane:
    """One column: lines refer to it by ``key``; ``label`` is its heading."""

    key: str
    label: str
    kind: Literal["test", "container", "body"]


@dataclass(frozen=True)
class Line:
    """One row of a diagram.

    ``source`` and ``target`` are keys of lanes; a call that arrived nowhere has no target. ``result`` is what an answer
    carries. ``begins`` and ``ends`` say that the row starts or finishes an activity on the lane it points to or
    comes from; ``events`` are the numbers of the events it stands for.
    """

    kind: LineKind
    source: str
    target: str
    label: str
    events: tuple[int, ...] = ()
    thread: int = 0
    style: Style = "normal"
    result: str = ""
    begins: bool = False
    ends: bool = False
    answers: int = -1


@dataclass(frozen=True)
class Diagram:
    """A laid-out sequence diagram; ``threads``: whether more than one thread takes part."""

    lanes: tuple[Lane, ...]
    lines: tuple[Line, ...]

    @property
    def threads(self) -> bool:
        """Whether the lines come from more than one thread."""
        return len({line.thread for line in self.lines if line.events}) > 1

    def without_idle_lanes(self, *others: Line) -> Diagram:
        """The diagram with those lanes only that its lines or ``others`` use; ``test`` always stays."""
        used = {key for line in (*self.lines, *others) for key in (line.source, line.target)} | {TEST}
        return replace(self, lanes=tuple(one for one in self.lanes if one.key in used))


@dataclass
class _Frame:
    """An activity that has begun and not yet ended on one thread."""

    what: str
    line: int
    source: str
    target: str
    value: object = None
    arrived: bool = True


def lay_out(execution: Execution, suspects: Iterable[int] = ()) -> Diagram:
    """Lay out a whole execution; ``suspects`` are the numbers of events that get a line of their own, as offending."""
    walk = _Walk(execution)
    for event in execution.trace:
        walk.follow(event)
    if execution.incident is not None:
        detail = one_line(f"{execution.incident.kind}: {execution.incident.detail}", 90)
        walk.lines.append(Line("end", TEST, TEST, detail, style="offending"))
    marked = frozenset(suspects)
    lines = [replace(one, style="offending") if marked.intersection(one.events) else one for one in walk.lines]
    return Diagram(walk.lanes(), tuple(_fold(lines)))


def last_call(execution: Execution) -> str:
    """The last step that began and did not end, in words; empty if all ended or none began."""
    words = Wording(execution)
    open_steps: list[int] = []
    for event in execution.trace:
        if isinstance(event, t.Call):
            words.called(event.step)
            open_steps.append(event.step)
        elif isinstance(event, t.Return | t.Raise | t.Timeout) and event.step in open_steps:
            open_steps.remove(event.step)
    return words.step(open_steps[-1]) if open_steps else ""


def find_lane(name: str, lanes: Sequence[Lane]) -> str | None:
    """The key of the lane with this key or label; None if the diagram has none."""
    return next((one.key for one in lanes if name in (one.key, one.label)), None)


class _Walk:
    """Turns events into lines, one after the other."""

    def __init__(self, execution: Execution) -> None:
        self.words = Wording(execution)
        self.lines: list[Line] = []
        self.frames: dict[int, list[_Frame]] = {}
        self.containers: list[str] = []
        self.bodies: list[tuple[str, int]] = []

    def lanes(self) -> tuple[Lane, ...]:
        """All lanes of the execution, in their final order."""
        return (
            Lane(TEST, TEST, "test"),
            *(Lane(name, one_line(name, 40), "container") for name in self.containers),
            *(Lane(body_key(name, n), one_line(lane(name, n), 40), "body") for name, n in self.bodies),
        )

    def follow(self, event: t.Event) -> None:
        """Append the lines of one event."""
        note = self._note(event)
        if note is None:
            getattr(self, f"_{t.kind_of(event)}")(event)
            return
        place = self._body(event.component, event.instance) if isinstance(event, t.Held | t.Pushed) else TEST
        self._add("note", place, place, note, event)

    # the lanes

    def _container(self, name: str) -> str:
        if name not in self.containers:
            self.containers.append(name)
        return name

    def _body(self, component: str, instance: int) -> str:
        if (component, instance) not in self.bodies:
            self.bodies.append((component, instance))
        return body_key(component, instance)

    def _home(self, event: t.BodyEvent) -> str:
        return self._container(self.words.home(event.component, event.instance))

    # the lines

    def _add(self, kind: LineKind, source: str, target: str, label: str, event: t.EventBase, **more: Any) -> int:
        self.lines.append(Line(kind, source, target, one_line(label, LABEL), (event.n,), event.thread, **more))
        return len(self.lines) - 1

    def _begin(
        self, what: str, source: str, target: str, label: str, event: t.EventBase, value: object = None
    ) -> _Frame:
        line = self._add("call", source, target, label, event, begins=True)
        frame = _Frame(what, line, source, target, value)
        self.frames.setdefault(event.thread, []).append(frame)
        return frame

    def _end(self, what: str, label: str, result: str, event: t.EventBase, source: str) -> None:
        stack = self.frames.get(event.thread, [])
        at = next((i for i in range(len(stack) - 1, -1, -1) if stack[i].what == what), None)
        if at is None:
            self._add("answer", source, TEST, label, event, result=result, ends=True)
            return
        frame = stack[at]
        del stack[at:]
        last = self.lines[-1]
        if (
            last.kind == "answer"
            and last.answers == frame.line
            and last.thread == event.thread
            and last.result == result
        ):
            self.lines[-1] = replace(last, events=(*last.events, event.n))
            return
        origin = frame.target or source
        self._add("answer", origin, frame.source, label, event, result=result, ends=True, answers=frame.line)

    def _call(self, event: t.Call) -> None:
        step = event.step
        words = self.words
        words.called(step)
        value = words.invoked(step)
        if value is None:
            self._begin(f"step {step}", TEST, self._container(words.container(step)), words.step(step), event)
            return
        frame = self._begin(f"step {step}", TEST, words.reached(step) or "", words.step(step), event, value)
        frame.arrived = False
        if frame.target:
            component, _, instance = frame.target.rpartition("#")
            self._body(component, int(instance))

    def _return(self, event: t.Return) -> None:
        step = event.step
        self.words.returned(step, event.value)
        records = event.records
        result = self.words.value(event.value) if records is None else f"{len(records)} records"
        label = f"returns {result}" if result else "returns"
        self._end(f"step {step}", label, result, event, self.words.container(step))

    def _raise(self, event: t.Raise) -> None:
        error, detail = event.error, one_line(event.detail, 60)
        name = "an undeclared exception" if error == "UNDECLARED" else error
        label = f"raises {name}: {detail}" if detail else f"raises {name}"
        self._end(f"step {event.step}", label, label, event, self.words.container(event.step))

    def _skip(self, event: t.Skip) -> None:
        what, name = self.words.step(event.step), one_line(event.variable, 30)
        if event.variable == self.words.operation(event.step):
            self._end(f"step {event.step}", "is not offered", "is not offered", event, TEST)
            return
        self._add("note", TEST, TEST, f"skipped {what}: {name} was never bound", event)

    def _create(self, event: t.Create) -> None:
        open_calls = [frame.what for frame in self.frames.get(event.thread, []) if frame.what.startswith("step ")]
        during = int(open_calls[-1][5:]) if open_calls else None
        self.words.created(event.component, event.instance, during)
        home = self._home(event)
        self._add("call", home, self._body(event.component, event.instance), "create", event)

    def _enter(self, event: t.Enter) -> None:
        body, hook = self._body(event.component, event.instance), event.hook
        what = f"{body} {hook}"
        label = self.words.hook(event)
        if hook not in ("exchange", "method"):
            self._begin(what, self._home(event), body, label, event)
            return
        sent = event.value if hook == "exchange" else (event.method, event.arguments)
        stack = self.frames.get(event.thread, [])
        caller = next((f for f in reversed(stack) if not f.arrived and f.value == sent), None)
        if caller is None:
            others = [frame for frames in self.frames.values() for frame in frames if not frame.arrived]
            caller = next((f for f in others if f.value == sent), None)
        if caller is None:
            self._begin(what, self._home(event), body, label, event)
            return
        caller.arrived, caller.target = True, body
        previous = self.lines[-1]
        if caller.line == len(self.lines) - 1 and previous.thread == event.thread:
            joined = self.words.joined(previous.label, event.port or "")
            self.lines[-1] = replace(previous, target=body, label=joined, events=(*previous.events, event.n))
            self.frames[event.thread].append(_Frame(what, caller.line, caller.source, body))
        else:
            self._begin(what, caller.source, body, label, event)

    def _exit(self, event: t.Exit) -> None:
        body, hook = self._body(event.component, event.instance), event.hook
        result = self.words.outcome(event)
        label = _came_back(event, result) if result else f"{hook} ends"
        self._end(f"{body} {hook}", label, result, event, body)

    def _request(self, event: t.Request) -> None:
        body = self._body(event.component, event.instance)
        sent = event.value if event.method is None else (event.method, event.arguments)
        frame = self._begin(f"{body} request {event.port}", body, "", self.words.request(event), event, sent)
        frame.arrived = False

    def _reply(self, event: t.Reply) -> None:
        body = self._body(event.component, event.instance)
        result = self.words.outcome(event)
        label = _came_back(event, result)
        self._end(f"{body} request {event.port}", label, result, event, body)

    def _siblings(self, event: t.Siblings) -> None:
        answer = "raises an exception" if event.raised else self.words.value(event.ids)
        self._add(
            "call", self._body(event.component, event.instance), self._home(event), f"get_components ⇒ {answer}", event
        )

    def _note(self, event: t.Event) -> str | None:
        """The text of an event that is no call and no answer; None for others."""
        match event:
            case t.Held():
                return f"held at {one_line(event.gate, 30)}"
            case t.Opened():
                return f"opens {one_line(event.gate, 30)}"
            case t.Pushed():
                answers = ", ".join(f"{times} times {code}" for code, times in event.answers.items())
                return f"pushes {event.count} through {event.port}: {answers}"
            case t.Counted():
                counted = f"{event.received} messages received, {event.distinct} distinct"
                return f"{lane(event.component, event.instance)}: {counted}, {event.disordered} out of order"
            case t.Stressed():
                control = f"{event.control_overlaps} in {event.control_calls} without protection"
                return f"{event.overlaps} overlaps in {event.calls} calls, {control}"
            case t.Paused():
                return self.words.step(event.step)
            case t.Timeout():
                return f"{self.words.step(event.step)}: gave up after {self.words.patience} ms"
            case t.Settled():
                return f"{one_line(event.worker, 30)} is {event.where}"
        return None


def _came_back(event: t.Exit | t.Reply, result: str) -> str:
    return f"raises {result}" if event.raised or event.exception is not None else f"returns {result}"


def _fold(lines: Sequence[Line]) -> list[Line]:
    """Put a call and its answer on one line where the answer came at once and neither is offending."""
    folded: list[Line] = []
    for index, line in enumerate(lines):
        if (
            line.kind == "answer"
            and line.answers == index - 1
            and folded
            and folded[-1].kind == "call"
            and folded[-1].style == line.style == "normal"
        ):
            call = folded[-1]
            label = f"{call.label} ⇒ {line.result}" if line.result else call.label
            folded[-1] = replace(call, label=label, events=(*call.events, *line.events), ends=True)
        else:
            folded.append(line)
    return folded
