"""Conformant variants that offer clock and trace in their own way (10.1.4)."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TypeVar

from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection
from ucm_cts.adapters.contract.scenario import Policy
from ucm_cts.adapters.mutants.python.methods import alters, replaces
from ucm_cts.adapters.mutants.python.registry import Base, is_below, variant_of
from ucm_cts.adapters.reference.python.container_services import Record
from ucm_cts.adapters.reference.python.members import Member

T = TypeVar("T")

SECOND, MILLISECOND = 1_000_000_000, 1_000_000
LATE = 0.02
"""Seconds. Records are written so much later than they are made."""


@variant_of("10.1.4", readings={"local-clock": "monotonic", "clock-epoch": "unspecified"})
class has_monotonic_clocks(Base):
    """Times begin when the machine was started; synchronized time is an hour ahead of local time."""

    def _local_time(self, member: Member) -> int:
        return time.monotonic_ns()

    def _synchronized_time(self, member: Member) -> int:
        return time.monotonic_ns() + 3600 * SECOND


@variant_of("10.1.4")
class has_coarse_clocks(Base):
    """Times go on in steps of 10 ms."""

    def _local_time(self, member: Member) -> int:
        return super()._local_time(member) // (10 * MILLISECOND) * 10 * MILLISECOND

    _synchronized_time = _local_time


@variant_of("10.1.4")
class has_seconds_that_wrap(Base):
    """The seconds of a time have no more than 32 bits and begin at zero again, soon after the runtime was made."""

    def _local_time(self, member: Member) -> int:
        runtime = self.manager.__dict__
        return (
            time.monotonic_ns() - int(runtime.setdefault("made", time.monotonic_ns())) + 2**32 * SECOND - SECOND // 10
        )

    _synchronized_time = _local_time


@alters("_local_time", clauses=("10.1.4",))
def has_a_node_for_each_container(self: Base, given: int, member: Member) -> int:
    """Local time of sub-containers is five seconds behind; synchronized time is the same for all."""
    return given - is_below(self) * 5 * SECOND


@alters("_synchronized_time", clauses=("10.1.4",))
def keeps_synchronized_time_loosely(_self: Base, given: int, member: Member) -> int:
    """Synchronized time goes on in steps of 40 ms, and a bit slower than it should."""
    return given * 9 // 10 // (40 * MILLISECOND) * 40 * MILLISECOND


@variant_of("10.1.4")
class notices_clocks_at_start(Base):
    """Components with two clocks are added, and keep their container from starting."""

    def _check_clocks(self, implementation: Implementation) -> None:
        pass

    def _check_startable(self) -> None:
        super()._check_startable()
        for member in self.members.values():
            super()._check_clocks(member.implementation)


@variant_of("10.1.4")
class has_one_element_for_all(Base):
    """Components get the same object for the same policy, and get it first of all."""

    def _service_element(self, member: Member, policy: Policy) -> PortConnection:
        kept = self.manager.__dict__.setdefault(f"element of {policy.definition}", {})
        given = super()._service_element(member, policy)
        first = kept.setdefault(policy.definition, given)
        return PortConnection(given.from_port, first.to_port)

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return list(reversed(super()._dependencies_of(member)))


@variant_of("10.1.4", readings={"port-trace-records": "call-and-return"})
class writes_calls_and_returns(Base):
    """A traced call has a record when it is made and one when it returns."""

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        result = super()._trace_call(member, port, method, work)
        super()._trace_call(member, port, method, lambda: None)
        return result


@replaces("_trace_call", clauses=("10.1.4",))
def writes_returns_at_required_ports(self: Base, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
    """A traced call has a record, and one more when it returns to a required port."""
    result = Base._trace_call(self, member, port, method, work)
    if port in member.implementation.requires:
        Base._trace_call(self, member, port, method, lambda: None)
    return result


@variant_of("10.1.4")
class writes_late(Base):
    """Another thread writes records, one by one, some time after they were made."""

    def _write(self, record: Record) -> None:
        write = super()._write
        due = time.monotonic() + LATE
        lock: threading.Lock = self.manager.__dict__.setdefault("writing", threading.Lock())

        def later() -> None:
            time.sleep(max(due - time.monotonic(), 0))
            with lock:
                write(record)

        threading.Thread(target=later, daemon=True).start()


@replaces("read_log", clauses=("10.1.4",))
def keeps_logs_of_components(self: Base) -> list[Record]:
    """Each component has a log of its own; the trace lists one log after the other."""
    return sorted(self.manager.log)
