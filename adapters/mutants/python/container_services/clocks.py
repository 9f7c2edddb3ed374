"""Wrong frameworks, clause 10.1.4.1: missing clocks, and clocks with the wrong time."""

from __future__ import annotations

import time

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, UcmError
from ucm_cts.adapters.contract.scenario import CLOCK, Policy
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.reference.python.members import Failures, Member

SECOND = 1_000_000_000
HERE = ("10.1.4",)
BEGINNING = time.time_ns()

# clocks


@replaces("_check_clocks", "R-10.1.4.1-02", clauses=HERE)
def accepts_several_clocks(_self: Base, *_: object) -> None:
    """A component may have several clocks."""


@refuses_if("_check_service", "R-10.1.4.1-02", clauses=HERE)
def refuses_clocks(_self: Base, _implementation: Implementation, policy: Policy) -> bool:
    """Components with a clock policy are refused."""
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
    """on_startup names the clock and gives no reference to it."""


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


@replaces("_dependencies_of", "R-11.2.1.2-09", clauses=HERE, also=("R-11.2.3-10",))
def hands_over_clocks_to_everybody(self: Base, member: Member) -> list[PortConnection]:
    """on_startup hands a clock over to components that did not ask for one."""
    clock = self._service_element(member, Policy(CLOCK, element="clock_clock_api"))
    return [*Base._dependencies_of(self, member), clock]


@replaces("_synchronized_time", "R-10.1.4.1-06", clauses=HERE)
def has_no_synchronized_time(_self: Base, *_: object) -> int:
    """The clock's second method fails."""
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


@replaces("_local_time", "R-10.1.4.1-09", clauses=HERE)
def clock_stands_still(_self: Base, *_: object) -> int:
    """Local time is always the time at which the framework was loaded."""
    return BEGINNING


@replaces("advance", "R-10.1.4.1-09", clauses=HERE, also=("R-10.1.4.1-10",), readings={"virtual-time": "hook"})
def clock_ignores_virtual_time(_self: Base, *_: object) -> None:
    """advance moves neither local nor synchronized time."""


@replaces("advance", "R-10.1.4.1-09", clauses=HERE, readings={"virtual-time": "hook"})
def virtual_time_passes_twice(self: Base, milliseconds: int) -> None:
    """Clocks go on by two seconds when one second of virtual time passes."""
    Base.advance(self, 2 * milliseconds)


@alters("_local_time", "R-10.1.4.1-09", clauses=HERE, readings={"virtual-time": "hook"})
def virtual_time_stays_above(self: Base, given: int, _member: Member) -> int:
    """Virtual time does not pass for the local clocks of sub-containers."""
    return given - self.manager.advanced if is_below(self) else given


class _Paced(Base):
    pace = 1.0

    def _local_time(self, member: Member) -> int:
        return BEGINNING + int(self.pace * (time.time_ns() - BEGINNING))


@breaks("R-10.1.4.1-09", clauses=HERE)
class clock_runs_double(_Paced):
    """Local time passes twice as fast as real time."""

    pace = 2.0


@breaks("R-10.1.4.1-09", clauses=HERE)
class clock_runs_half(_Paced):
    """Local time passes half as fast as real time."""

    pace = 0.5


@alters("_local_time", "R-10.1.4.1-08", clauses=HERE, also=("R-10.1.4.1-09",))
def clock_loses_whole_seconds(_self: Base, given: int, _member: Member) -> int:
    """Local time has the right microseconds, and its seconds are always 0."""
    return given % SECOND


@alters("_synchronized_time", "R-10.1.4.1-10", clauses=HERE)
def synchronized_clock_loses_whole_seconds(_self: Base, given: int, _member: Member) -> int:
    """Synchronized time has the right microseconds, and its seconds are always 0."""
    return given % SECOND


@replaces("_local_time", "R-10.1.4.1-09", clauses=HERE, readings={"clock-epoch": "unix"})
def clock_has_another_epoch_than_declared(_self: Base, *_: object) -> int:
    """Local time is monotonic time; the vendor declares Unix time."""
    return time.monotonic_ns()


@alters("_synchronized_time", "R-10.1.4.1-10", clauses=HERE)
def every_component_has_its_own_synchronized_time(_self: Base, given: int, member: Member) -> int:
    """Synchronized times of components are half a second apart."""
    return given + member.id * SECOND // 2


@alters("_synchronized_time", "R-10.1.4.1-10", clauses=HERE)
def synchronizes_in_containers_only(self: Base, given: int, _member: Member) -> int:
    """Synchronized time of the root container is a second ahead of that of sub-containers."""
    return given + (not is_below(self)) * SECOND


@replaces("_synchronized_time", "R-10.1.4.1-10", clauses=HERE)
def synchronized_time_begins_with_the_first_reading(_self: Base, member: Member) -> int:
    """Every component's synchronized time is the time since it first asked."""
    now = time.monotonic_ns()
    return now - int(member.__dict__.setdefault("first asked", now))


@replaces("_synchronized_time", "R-10.1.4.1-10", clauses=HERE)
def synchronized_time_stands_still(_self: Base, *_: object) -> int:
    """Synchronized time is always the time at which the framework was loaded."""
    return BEGINNING


@alters("_time_value", "R-10.1.4.2-14", clauses=HERE)
def tells_too_many_microseconds(_self: Base, given: list[int], *_: object) -> list[int]:
    """The microseconds of a time exceed a second."""
    return [given[0] - 1, given[1] + 1_000_000]


@alters("_time_value", "R-10.1.4.2-14", clauses=HERE)
def tells_seconds_beyond_their_type(_self: Base, given: list[int], *_: object) -> list[int]:
    """The seconds of a time need 33 bits."""
    return [given[0] + 2**32, given[1]]


@alters("_time_value", "R-10.1.4.2-14", clauses=HERE)
def tells_negative_microseconds(_self: Base, given: list[int], *_: object) -> list[int]:
    """The microseconds of a time are negative."""
    return [given[0] + 1, given[1] - 1_000_000]


@replaces(
    "_time_value", "R-10.1.4.2-14", clauses=HERE, also=("R-10.1.4.1-08", "R-10.1.4.1-09", "R-10.1.4.1-10")
)  # time passes a thousand times too fast, and goes back each second
def tells_nanoseconds(_self: Base, nanoseconds: int) -> list[Datum]:
    """The microseconds of a time are nanoseconds."""
    return [nanoseconds // SECOND, nanoseconds % SECOND]
