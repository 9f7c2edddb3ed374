"""Trace: the totally ordered events that really happened while a scenario ran.

Every event has ``n``, drawn from ONE atomic counter of the host process and starting at 1 in each trace, so that order
means happened-before; ``t``, the host's monotonic clock in nanoseconds; and ``thread``, 0 for the scenario's own thread.
"""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.scenario import Hook, PortElementName
from ucm_cts.adapters.contract.value import Int64, Value

DeclaredError = Literal["NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR"]
"""The three exceptions of 12.10."""

ErrorName = Literal["NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR", "UNDECLARED"]
"""What left an operation: one of 12.10's exceptions, or anything else."""


class Reference(Value, frozen=True):
    """A provided port element that the SDK recognised: ``port`` of the ``instance``-th body made for ``component``."""

    component: str
    instance: Int64
    port: PortElementName


Opaque = Literal["opaque"]
"""A reference that is not a probe's own object, for instance a framework's proxy: judged by behaviour only."""

MaybeReference = Reference | Opaque | None


class Dependency(Value, frozen=True):
    """One PortConnection of ``on_startup``: the name the framework used and the references it handed over."""

    port: PortElementName
    references: tuple[MaybeReference, ...]


class EventBase(Value, frozen=True, tag_field="kind"):
    """Common to all events."""

    n: Int64
    t: Int64
    thread: Int64


class StepEvent(EventBase, frozen=True):
    """Common to events about scenario step number ``step`` (from 0)."""

    step: Int64


class Call(StepEvent, frozen=True, tag="call"):
    """Scenario step number ``step`` (from 0) is handed to the framework."""


class LogRecord(Value, frozen=True):
    """One record of the trace (10.1.4.2): ``severity`` is an enumerator of log_severity_t."""

    severity: str
    message: str


class Return(StepEvent, frozen=True, tag="return"):
    """The step's operation came back; ``value`` is an id, a list of ids, a reference, or a business result, ``records``
    what was read from the trace.
    """

    value: Int64 | tuple[Int64, ...] | Reference | Opaque | None = None
    records: tuple[LogRecord, ...] | None = None


class Raise(StepEvent, frozen=True, tag="raise"):
    """The step's operation ended with an exception; ``detail`` is its text, for people."""

    error: ErrorName
    detail: str = ""


class Skip(StepEvent, frozen=True, tag="skip"):
    """The step was not tried, because ``variable`` was never bound, or the adapter does not offer the operation of that
    name.
    """

    variable: str


class Timeout(StepEvent, frozen=True, tag="timeout"):
    """A wait step ran out of patience."""


class BodyEvent(EventBase, frozen=True):
    """Common to events inside the ``instance``-th body (from 1) that the framework made for ``component``."""

    component: str
    instance: Int64


class Create(BodyEvent, frozen=True, tag="create"):
    """The framework instantiated the body."""


class Enter(BodyEvent, frozen=True, tag="enter"):
    """The framework entered the body at ``hook``.

    ``port`` and ``reference`` are the arguments of the Connectable callbacks, ``port`` and ``value`` those of
    ``exchange``, ``dependencies`` that of ``on_startup``; ``attributes`` are the values the body holds at ``on_init``;
    ``port``, ``method`` and ``arguments`` belong to ``method``.
    """

    hook: Hook
    port: PortElementName | None = None
    value: Int64 | None = None
    reference: MaybeReference = None
    dependencies: tuple[Dependency, ...] | None = None
    attributes: dict[str, str] | None = None
    method: str | None = None
    arguments: tuple[Datum, ...] | None = None


class Exit(BodyEvent, frozen=True, tag="exit"):
    """The body left ``hook``: with ``value``, or with an exception when ``raised``.

    ``method`` is left with ``results``; ``exception`` names a declared exception, whose fields are ``results``.
    """

    hook: Hook
    value: Int64 | None = None
    raised: bool = False
    results: tuple[Datum, ...] | None = None
    exception: str | None = None


class Request(BodyEvent, frozen=True, tag="request"):
    """The body is about to call ``exchange(value)``, or ``method`` with ``arguments``, through its required port element
    ``port``.
    """

    port: PortElementName
    value: Int64 = 0
    method: str | None = None
    arguments: tuple[Datum, ...] | None = None


class Reply(BodyEvent, frozen=True, tag="reply"):
    """That call came back with ``value``, or with an exception when ``raised``.

    A method comes back with ``results``; ``exception`` names a declared exception, whose fields are ``results``.
    """

    port: PortElementName
    value: Int64 | None = None
    raised: bool = False
    results: tuple[Datum, ...] | None = None
    exception: str | None = None


class Pushed(BodyEvent, frozen=True, tag="pushed"):
    """The body has pushed a burst of ``count`` messages, from ``first`` on; ``answers`` says how often it got which
    return code, and under ``raised`` how many pushes ended with an exception.
    """

    port: PortElementName
    first: Int64
    count: Int64
    answers: dict[str, Int64]


class Siblings(BodyEvent, frozen=True, tag="siblings"):
    """A fragment asked its container interface for ``get_components``: the ids, or an exception when ``raised``."""

    ids: tuple[Int64, ...] = ()
    raised: bool = False


class Held(BodyEvent, frozen=True, tag="held"):
    """The body waits at ``gate``."""

    gate: str


class Opened(EventBase, frozen=True, tag="opened"):
    """The scenario opened ``gate``."""

    gate: str


class Settled(EventBase, frozen=True, tag="settled"):
    """Where a worker was found: its steps ``done``, its body ``held`` at a gate, the thread ``blocked`` by the operating
    system, or still ``running`` when patience ran out.
    """

    worker: str
    where: Literal["done", "held", "blocked", "running"]


class Counted(StepEvent, frozen=True, tag="counted"):
    """What ``instance`` of ``component`` had counted when step ``step`` was done: how many messages it ``received``, how
    many of them for the first time (``distinct``), how many after a greater one (``disordered``), and the least and the
    greatest.
    """

    component: str
    instance: Int64
    received: Int64
    distinct: Int64
    disordered: Int64
    least: Int64 = 0
    greatest: Int64 = 0


class Paused(StepEvent, frozen=True, tag="paused"):
    """Time has passed. ``calendar`` is the host's calendar clock in nanoseconds, read together with ``t``."""

    calendar: Int64


class Stressed(StepEvent, frozen=True, tag="stressed"):
    """What a stress found: ``calls`` made through the framework, how many ``failed``, how many ``overlaps`` bodies
    counted, and the same for the body that nobody protects.
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
    """How the kind of ``event`` is called on the wire."""
    return str(type(event).__struct_config__.tag)
