"""Wrong frameworks, clause 10.1.4.1: clocks that are not there, and clocks that tell the wrong time."""

from __future__ import annotations

import time

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, UcmError
from ucm_cts.adapters.contract.scenario import CLOCK, Policy
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.reference.python.framework import Failures, Member

SECOND = 1_000_000_000
HERE = ("10.1.4",)
BEGINNING = time.time_ns()

# clocks


@breaks("R-10.1.4.1-02", clauses=HERE)
class accepts_several_clocks(Base):
    """A second clock is one more reference."""

    def _check_clocks(self, implementation: Implementation) -> None:
        pass


@refuses_if("_check_service", "R-10.1.4.1-02", clauses=HERE)
def refuses_clocks(_self: Base, _implementation: Implementation, policy: Policy) -> bool:
    """There are no clocks."""
    return policy.definition == CLOCK


class Withholds(Base):
    """The port elements of some policies are not handed over."""

    definition = CLOCK

    def _withholds(self, member: Member) -> bool:
        return True

    def _service_element(self, member: Member, policy: Policy) -> PortConnection:
        given = super()._service_element(member, policy)
        if policy.definition != self.definition or not self._withholds(member):
            return given
        return PortConnection(given.from_port, ())


@breaks("R-10.1.4.1-06", clauses=HERE)
class hands_over_no_clock(Withholds):
    """Nothing is behind the name of the clock."""


@alters("_service_element", "R-10.1.4.1-06", clauses=HERE)
def hands_over_a_null_clock(_self: Base, given: PortConnection, _member: Member, policy: Policy) -> PortConnection:
    """The reference of the clock is null."""
    return PortConnection(given.from_port, (None,)) if policy.definition == CLOCK else given


@breaks("R-10.1.4.1-06", clauses=HERE)
class hands_over_the_clock_once(Withholds):
    """A component that is started again gets no clock."""

    def _withholds(self, member: Member) -> bool:
        return bool(member.__dict__.setdefault("has been stopped", False))

    def _shut_down(self, member: Member, failures: Failures) -> None:
        super()._shut_down(member, failures)
        member.__dict__["has been stopped"] = True


@breaks("R-11.2.1.2-09", clauses=HERE, also=("R-11.2.3-10",))
class hands_over_clocks_to_everybody(Base):
    """on_startup tells of a clock that was not asked for."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        clock = self._service_element(member, Policy(CLOCK, element="clock_clock_api"))
        return [*super()._dependencies_of(member), clock]


@breaks("R-10.1.4.1-06", clauses=HERE)
class has_no_synchronized_time(Base):
    """The clock's second method fails."""

    def _synchronized_time(self, member: Member) -> int:
        raise UcmError("there is nothing to synchronize with")


@refuses_if("_local_time", "R-10.1.4.1-06", clauses=HERE)
def clock_ends_before_shutdown(_self: Base, member: Member) -> bool:
    """The clock fails in on_shutdown."""
    return member.container.is_started and member not in member.container.started


@breaks("R-10.1.4.1-08", clauses=HERE, also=("R-10.1.4.1-09",))
class clock_begins_anew_at_start(Base):
    """Local time is the time since the component was started."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        member.__dict__["began"] = time.time_ns()
        return super()._start_up(member, failures)

    def _local_time(self, member: Member) -> int:
        return super()._local_time(member) - int(member.__dict__["began"])


@alters("_local_time", "R-10.1.4.1-08", clauses=HERE)
def every_component_has_its_own_time(_self: Base, given: int, member: Member) -> int:
    """Local times of components are some minutes apart."""
    return given + member.id * 100 * SECOND


@breaks("R-10.1.4.1-09", clauses=HERE)
class clock_stands_still(Base):
    """Local time is when the framework was loaded."""

    def _local_time(self, member: Member) -> int:
        return BEGINNING


@breaks("R-10.1.4.1-09", clauses=HERE, also=("R-10.1.4.1-10",), readings={"virtual-time": "hook"})
class clock_ignores_virtual_time(Base):
    """Local and synchronized time go on in real time alone."""

    def advance(self, milliseconds: int) -> None:
        pass


@breaks("R-10.1.4.1-09", clauses=HERE, readings={"virtual-time": "hook"})
class virtual_time_passes_twice(Base):
    """Clocks go on by two seconds when one second of virtual time passes."""

    def advance(self, milliseconds: int) -> None:
        super().advance(2 * milliseconds)


class _Paced(Base):
    pace = 1.0

    def _local_time(self, member: Member) -> int:
        return BEGINNING + int(self.pace * (time.time_ns() - BEGINNING))


@breaks("R-10.1.4.1-09", clauses=HERE)
class clock_runs_double(_Paced):
    """Two seconds pass in one."""

    pace = 2.0


@breaks("R-10.1.4.1-09", clauses=HERE)
class clock_runs_half(_Paced):
    """Half a second passes in one."""

    pace = 0.5


@alters("_local_time", "R-10.1.4.1-08", clauses=HERE, also=("R-10.1.4.1-09",))
def clock_loses_whole_seconds(_self: Base, given: int, _member: Member) -> int:
    """Local time is right to the microsecond, and without its seconds."""
    return given % SECOND


@alters("_synchronized_time", "R-10.1.4.1-10", clauses=HERE)
def synchronized_clock_loses_whole_seconds(_self: Base, given: int, _member: Member) -> int:
    """Synchronized time is right to the microsecond, and without its seconds."""
    return given % SECOND


@breaks("R-10.1.4.1-09", clauses=HERE, readings={"clock-epoch": "unix"})
class clock_has_another_epoch_than_declared(Base):
    """Local time is monotonic time; the vendor declares Unix time."""

    def _local_time(self, member: Member) -> int:
        return time.monotonic_ns()


@alters("_synchronized_time", "R-10.1.4.1-10", clauses=HERE)
def every_component_has_its_own_synchronized_time(_self: Base, given: int, member: Member) -> int:
    """Synchronized times of components are half a second apart."""
    return given + member.id * SECOND // 2


@alters("_synchronized_time", "R-10.1.4.1-10", clauses=HERE)
def synchronizes_in_containers_only(self: Base, given: int, _member: Member) -> int:
    """Every container synchronizes its components, but containers are not synchronized with each other."""
    return given + (not is_below(self)) * SECOND


@breaks("R-10.1.4.1-10", clauses=HERE)
class synchronized_time_begins_with_the_first_reading(Base):
    """Every component's synchronized time is the time since it first asked."""

    def _synchronized_time(self, member: Member) -> int:
        now = time.monotonic_ns()
        return now - int(member.__dict__.setdefault("first asked", now))


@breaks("R-10.1.4.1-10", clauses=HERE)
class synchronized_time_stands_still(Base):
    """Synchronized time is when the framework was loaded."""

    def _synchronized_time(self, member: Member) -> int:
        return BEGINNING


@breaks("R-10.1.4.2-14", clauses=HERE)
class tells_too_many_microseconds(Base):
    """A second is told as microseconds."""

    def _time_value(self, nanoseconds: int) -> list[Datum]:
        seconds, microseconds = super()._time_value(nanoseconds)
        return [int(seconds) - 1, int(microseconds) + 1_000_000]  # type: ignore[arg-type]


@breaks("R-10.1.4.2-14", clauses=HERE)
class tells_seconds_beyond_their_type(Base):
    """Seconds are counted from a time so long ago that they need 33 bits."""

    def _time_value(self, nanoseconds: int) -> list[Datum]:
        seconds, microseconds = super()._time_value(nanoseconds)
        return [int(seconds) + 2**32, microseconds]  # type: ignore[arg-type]


@breaks("R-10.1.4.2-14", clauses=HERE)
class tells_negative_microseconds(Base):
    """Microseconds count down to the next second."""

    def _time_value(self, nanoseconds: int) -> list[Datum]:
        seconds, microseconds = super()._time_value(nanoseconds)
        return [int(seconds) + 1, int(microseconds) - 1_000_000]  # type: ignore[arg-type]


@breaks(
    "R-10.1.4.2-14", clauses=HERE, also=("R-10.1.4.1-08", "R-10.1.4.1-09", "R-10.1.4.1-10")
)  # what is told passes a thousand times too fast, and falls back each second
class tells_nanoseconds(Base):
    """Nanoseconds are told as microseconds."""

    def _time_value(self, nanoseconds: int) -> list[Datum]:
        return [nanoseconds // SECOND, nanoseconds % SECOND]
