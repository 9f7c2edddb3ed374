"""Trace: the events of a scenario, in the order in which they happened."""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.scenario import Hook, PortElementName
from ucm_cts.adapters.contract.value import Int64, Value

MOST = 10_000
"""How many ids, records or dependencies one event may hold: far more than any scenario makes."""

DeclaredError = Literal["NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR"]
"""The three exceptions of 12.10."""

ErrorName = Literal["NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR", "UNDECLARED"]
"""What left an operation: one of 12.10's exceptions, or anything else."""


class Reference(Value, frozen=True):
    """A provided port element that the SDK recognised.

    ``component``: name of the declaration.
    ``instance``: number of the body among those made for ``component``, from 1.
    ``port``: the port element.
    """

    component: str
    instance: Int64
    port: PortElementName


Opaque = Literal["opaque"]
"""A reference that is not a probe's own object, for instance a framework's proxy: judged by behaviour only."""

MaybeReference = Reference | Opaque | None


class Dependency(Value, frozen=True):
    """A PortConnection of ``on_startup``.

    ``port``: the required port element, as the framework named it.
    ``references``: the references that the framework passed.
    """

    port: PortElementName
    references: tuple[MaybeReference, ...]


class EventBase(Value, frozen=True, tag_field="kind"):
    """Common to all events.

    ``n``: number from one atomic counter of the host process, from 1 in each trace: lower happened before.
    ``t``: the host's monotonic clock, in nanoseconds.
    ``thread``: number of the thread; 0 is the scenario's own.
    """

    n: Int64
    t: Int64
    thread: Int64


class StepEvent(EventBase, frozen=True):
    """Common to events about a step.

    ``step``: number of the step, from 0.
    """

    step: Int64


class Call(StepEvent, frozen=True, tag="call"):
    """The step is passed to the framework."""


class LogRecord(Value, frozen=True):
    """A record of the trace of 10.1.4.2.

    ``severity``: enumerator of log_severity_t.
    ``message``: its text.
    """

    severity: str
    message: str


class Return(StepEvent, frozen=True, tag="return"):
    """The operation of the step returned.

    ``value``: an id, a list of ids, a reference or a business result.
    ``records``: the records that were read from the log.
    ``wrong``: what a business call gave instead of an integer, for people.
    """

    value: Int64 | tuple[Int64, ...] | Reference | Opaque | None = None
    records: tuple[LogRecord, ...] | None = None
    wrong: str = ""


class Raise(StepEvent, frozen=True, tag="raise"):
    """The operation of the step ended with an exception.

    ``error``: which one.
    ``detail``: its text, for people.
    """

    error: ErrorName
    detail: str = ""


class Skip(StepEvent, frozen=True, tag="skip"):
    """The step was not run.

    ``variable``: the variable that was not bound, or the operation that the adapter does not offer.
    """

    variable: str


class Timeout(StepEvent, frozen=True, tag="timeout"):
    """Patience ended before what the step waits for happened."""


class BodyEvent(EventBase, frozen=True):
    """Common to events of a body.

    ``component``: name of the declaration.
    ``instance``: number of the body among those made for ``component``, from 1.
    """

    component: str
    instance: Int64

    @property
    def body(self) -> tuple[str, int]:
        """The body: its component and instance."""
        return self.component, self.instance


class Create(BodyEvent, frozen=True, tag="create"):
    """The framework instantiated the body."""


class Enter(BodyEvent, frozen=True, tag="enter"):
    """The framework entered the body.

    ``hook``: where.
    ``port``: argument of Connectable callbacks; the port element of ``exchange`` and ``method``.
    ``value``: argument of ``exchange``.
    ``reference``: argument of ``on_connect``.
    ``dependencies``: argument of ``on_startup``.
    ``attributes``: the values that the body has at ``on_init``.
    ``method``: name of the method.
    ``arguments``: IN and INOUT values of the method.
    ``wrong``: what the framework handed over that is not of the type of the interface, for people; its field is empty.
    ``timer``: the object timer that ``on_trigger`` was given: its number among those that came to the body, from 1. One that comes
        again has another number, because the body cannot tell whether it is the same.
    """

    hook: Hook
    port: PortElementName | None = None
    value: Int64 | None = None
    reference: MaybeReference = None
    dependencies: tuple[Dependency, ...] | None = None
    attributes: dict[str, str] | None = None
    method: str | None = None
    arguments: tuple[Datum, ...] | None = None
    wrong: str = ""
    timer: Int64 | None = None


class Exit(BodyEvent, frozen=True, tag="exit"):
    """The body left a hook.

    ``hook``: where.
    ``value``: result of ``exchange``.
    ``raised``: it left with an exception.
    ``results``: OUT, INOUT and RETURN values of a method, or fields of ``exception``.
    ``exception``: name of the declared exception.
    """

    hook: Hook
    value: Int64 | None = None
    raised: bool = False
    results: tuple[Datum, ...] | None = None
    exception: str | None = None

    @property
    def failed(self) -> bool:
        """Did it end with an exception, declared or not?"""
        return self.raised or self.exception is not None


class Request(BodyEvent, frozen=True, tag="request"):
    """The body is about to call ``exchange`` or a method.

    ``port``: the required port element.
    ``value``: argument of ``exchange``.
    ``method``: name of the method; none for ``exchange``.
    ``arguments``: IN and INOUT values of the method.
    ``handler``: the handler that is passed before them.
    ``timer``: the object timer that is called, by its number.
    """

    port: PortElementName
    value: Int64 = 0
    method: str | None = None
    arguments: tuple[Datum, ...] | None = None
    handler: PortElementName | None = None
    timer: Int64 | None = None


class Reply(BodyEvent, frozen=True, tag="reply"):
    """The call of the last ``Request`` of this body and thread came back.

    ``port``: the required port element.
    ``value``: result of ``exchange``.
    ``raised``: it came back with an exception.
    ``results``: OUT, INOUT and RETURN values of a method, or fields of ``exception``.
    ``exception``: name of the declared exception.
    ``wrong``: what came back that is not of the type of the interface, for people.
    ``timer``: the object timer that came back: its number, as that of ``Enter``.
    """

    port: PortElementName
    value: Int64 | None = None
    raised: bool = False
    results: tuple[Datum, ...] | None = None
    exception: str | None = None
    wrong: str = ""
    timer: Int64 | None = None

    @property
    def failed(self) -> bool:
        """Did it end with an exception, declared or not?"""
        return self.raised or self.exception is not None


class Pushed(BodyEvent, frozen=True, tag="pushed"):
    """The body has pushed a burst of messages.

    ``port``: the required port element.
    ``first``: the first number.
    ``count``: how many messages.
    ``answers``: how many pushes got each return code; ``raised``: how many ended with an exception.
    """

    port: PortElementName
    first: Int64
    count: Int64
    answers: dict[str, Int64]


class Siblings(BodyEvent, frozen=True, tag="siblings"):
    """A fragment called ``get_components`` of its container interface.

    ``ids``: the result.
    ``raised``: it ended with an exception.
    ``wrong``: the result, if it is no list of integers, for people.
    """

    ids: tuple[Int64, ...] = ()
    raised: bool = False
    wrong: str = ""


class Held(BodyEvent, frozen=True, tag="held"):
    """The body waits at a gate.

    ``gate``: name of the gate.
    """

    gate: str


class Opened(EventBase, frozen=True, tag="opened"):
    """The scenario opened a gate.

    ``gate``: name of the gate.
    """

    gate: str


class Settled(EventBase, frozen=True, tag="settled"):
    """The state of a worker.

    ``worker``: its name.
    ``where``: ``done`` with its steps, ``held`` by a body at a gate, ``blocked`` by the operating system, or still ``running``
    when patience ended.
    """

    worker: str
    where: Literal["done", "held", "blocked", "running"]


class Counted(StepEvent, frozen=True, tag="counted"):
    """The messages that a body has counted.

    ``component``: name of the declaration.
    ``instance``: number of the body, from 1.
    ``received``: how many messages.
    ``distinct``: how many different ones.
    ``disordered``: how many came after a greater one.
    ``least``: the least number.
    ``greatest``: the greatest number.
    """

    component: str
    instance: Int64
    received: Int64
    distinct: Int64
    disordered: Int64
    least: Int64 = 0
    greatest: Int64 = 0


class Paused(StepEvent, frozen=True, tag="paused"):
    """Time has passed.

    ``calendar``: the host's calendar clock in nanoseconds, read together with ``t``.
    """

    calendar: Int64


class Stressed(StepEvent, frozen=True, tag="stressed"):
    """The result of a stress.

    ``calls``: calls through the framework.
    ``overlaps``: overlaps that the bodies counted.
    ``control_calls``: calls of a body without protection, for comparison.
    ``control_overlaps``: overlaps in that body.
    ``failed``: calls that failed.
    """

    calls: Int64
    overlaps: Int64
    control_calls: Int64
    control_overlaps: Int64
    failed: Int64 = 0


Event = (
    Call
    | Return
    | Raise
    | Skip
    | Timeout
    | Create
    | Enter
    | Exit
    | Request
    | Reply
    | Siblings
    | Held
    | Opened
    | Settled
    | Pushed
    | Counted
    | Paused
    | Stressed
)

Trace = tuple[Event, ...]


def kind_of(event: Event) -> str:
    """The name of the kind of ``event`` on the wire."""
    return str(type(event).__struct_config__.tag)
