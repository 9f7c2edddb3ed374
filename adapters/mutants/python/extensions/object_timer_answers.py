"""Wrong frameworks, clause 10.3.1: object timers say wrong things of themselves, or refuse to."""

from __future__ import annotations

from typing import Any

from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.extensions.object_timer_service import ANY_TRIGGER
from ucm_cts.adapters.mutants.python.methods import alters
from ucm_cts.adapters.mutants.python.registry import MISSING_TRIGGERS, TRIGGERED, Row, breaks, family
from ucm_cts.adapters.reference.python.object_timers import ScheduledTimer, Trigger, Triggers


class _Fails(ScheduledTimer):
    """``failing`` is the method that raises, and ``ended`` whether it does so for timers that have ended only."""

    failing = ("", False)

    def _fail(self, method: str) -> None:
        failing, ended = self.failing
        if failing == method and not (ended and self.timer.number in self.triggers._waiting):
            raise UcmError("no such timer")

    def id(self) -> str:
        self._fail("id")
        return super().id()

    def rounds(self) -> int:
        self._fail("rounds")
        return super().rounds()

    def is_cancelled(self) -> bool:
        self._fail("is_cancelled")
        return super().is_cancelled()

    def cancel(self) -> None:
        self._fail("cancel")
        super().cancel()


family(
    _Fails,
    "failing",
    {
        "id_raises": Row("R-10.3.1-01", "id raises.", ("id", False), ANY_TRIGGER),
        "rounds_raises": Row("R-10.3.1-01", "rounds raises.", ("rounds", False), ANY_TRIGGER),
        "is_cancelled_raises": Row("R-10.3.1-01", "is_cancelled raises.", ("is_cancelled", False), ANY_TRIGGER),
        "cancel_raises": Row("R-10.3.1-01", "cancel raises.", ("cancel", False), ANY_TRIGGER),
        "id_raises_afterwards": Row("R-10.3.1-01", "id of an ended timer raises.", ("id", True), ANY_TRIGGER),
        "rounds_raises_afterwards": Row(
            "R-10.3.1-01", "rounds of an ended timer raises.", ("rounds", True), ANY_TRIGGER
        ),
        "is_cancelled_raises_afterwards": Row(
            "R-10.3.1-01", "is_cancelled of an ended timer raises.", ("is_cancelled", True), ANY_TRIGGER
        ),
    },
    TRIGGERED,
)


@alters("id", "R-10.3.1-29", clauses=TRIGGERED, also=ANY_TRIGGER)
def identifiers_are_numbers(self: ScheduledTimer, _own: str) -> Any:
    """id gives a number."""
    return self.timer.number


@alters("rounds", "R-10.3.1-30", clauses=TRIGGERED)
def rounds_are_texts(_self: ScheduledTimer, own: int) -> Any:
    """rounds gives a text."""
    return str(own)


@alters("rounds", "R-10.3.1-30", clauses=TRIGGERED)
def rounds_are_negative(_self: ScheduledTimer, own: int) -> int:
    """rounds gives a negative number."""
    return -own


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def is_cancelled_gives_a_number(_self: ScheduledTimer, own: bool) -> Any:
    """is_cancelled gives 0 or 1."""
    return int(own)


_IDS = ("R-10.3.1-26", "R-10.3.1-25", "R-10.3.1-29", "R-10.3.1-31", "R-10.3.1-33", *MISSING_TRIGGERS)


class _Identified(ScheduledTimer):
    """``identifier`` makes the identifier of the timer."""

    identifier: Any = None

    def id(self) -> str:
        return str(self.identifier(self.timer))


family(
    _Identified,
    "identifier",
    {
        "has_one_identifier": Row("R-10.3.1-28", "All timers have one identifier.", lambda _: "timer", _IDS),
        "has_empty_identifiers": Row("R-10.3.1-28", "All identifiers are empty.", lambda _: "", _IDS),
        "has_identifiers_of_handlers": Row(
            "R-10.3.1-28", "Timers of one handler have one identifier.", lambda timer: id(timer.handler), _IDS
        ),
        "has_identifiers_of_delays": Row(
            "R-10.3.1-28", "Timers of one delay have one identifier.", lambda timer: timer.asked, _IDS
        ),
        "has_four_identifiers": Row(
            "R-10.3.1-28", "Identifiers begin anew after four.", lambda timer: timer.number % 4, _IDS
        ),
        "has_sixteen_identifiers": Row(
            "R-10.3.1-28", "Identifiers begin anew after sixteen.", lambda timer: timer.number % 16, _IDS
        ),
    },
    TRIGGERED,
)


@breaks("R-10.3.1-28", clauses=TRIGGERED, readings={"timer-ids": "ever"}, also=_IDS)
class gives_identifiers_again(Triggers):
    """The identifier of an ended timer is given again, although that is declared never to happen."""

    def _new_number(self) -> int:
        return next(number for number in range(1, 1_000_000) if number not in self._waiting)


class _Renamed(ScheduledTimer):
    """``_prefix`` begins its identifier."""

    def _prefix(self) -> object:
        return ""

    def id(self) -> str:
        return f"{self._prefix()}{super().id()}"


@breaks("R-10.3.1-29", clauses=TRIGGERED, also=ANY_TRIGGER)
class renames_at_each_reading(_Renamed):
    """The identifier is another one whenever it is read."""

    def _prefix(self) -> object:
        readings: list[int] = self.triggers.__dict__.setdefault("readings", [0])
        readings[0] += 1
        return f"{readings[0]}-"


@breaks("R-10.3.1-29", clauses=TRIGGERED, also=ANY_TRIGGER)
class renames_ended_timers(_Renamed):
    """The identifier changes when the timer has triggered for the last time, or was cancelled."""

    def _prefix(self) -> object:
        return "" if self.timer.number in self.triggers._waiting else "ended "


@breaks("R-10.3.1-29", clauses=TRIGGERED, also=ANY_TRIGGER)
class renames_each_round(_Renamed):
    """The identifier tells when the timer is due."""

    def _prefix(self) -> object:
        waiting = self.triggers._waiting.get(self.timer.number)
        return waiting.due if waiting is not None else ""


class _Rounds(ScheduledTimer):
    """``told`` makes what rounds tells of the timer, and of the one that waits."""

    told: Any = None

    def rounds(self) -> int:
        waiting = self.triggers._waiting.get(self.timer.number)
        return self.told(self.timer, waiting)  # type: ignore[no-any-return]


def _left(timer: Trigger, waiting: Any) -> int:
    return timer.max_rounds - waiting.round if waiting is not None else 0


family(
    _Rounds,
    "told",
    {
        "tells_one_round_more": Row("R-10.3.1-30", "rounds is one too many.", lambda timer, _: timer.max_rounds + 1),
        "tells_no_rounds": Row("R-10.3.1-30", "rounds is always 0.", lambda *_: 0),
        "tells_one_round": Row("R-10.3.1-30", "rounds is always 1.", lambda *_: 1),
        "tells_the_timer_s_number": Row(
            "R-10.3.1-30", "rounds is the timer's number.", lambda timer, _: timer.number + 40
        ),
        "tells_rounds_left_undeclared": Row(
            "R-10.3.1-30",
            "rounds is what is left, although another meaning is declared.",
            _left,
            (),
            {"rounds-attribute": "done"},
        ),
        "tells_rounds_left_of_some": Row(
            "R-10.3.1-30",
            "rounds is what is left of timers with more than two rounds, and what was asked for of others.",
            lambda timer, waiting: _left(timer, waiting) if timer.max_rounds > 2 else timer.max_rounds,
            (),
            {"rounds-attribute": "observed"},
        ),
    },
    TRIGGERED,
)


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_never_cancelled_of_objects(_self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled gives false."""
    return False


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_always_cancelled_of_objects(_self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled gives true."""
    return True


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_whether_objects_wait(self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled tells whether the timer waits."""
    return self.timer.number in self.triggers._waiting


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_cancelled_of_all_objects(self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled gives true when any timer was cancelled."""
    return bool(self.triggers._cancelled)


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED, readings={"object-is-cancelled": "cancelled"})
def says_cancelled_of_expired_objects(self: ScheduledTimer, _own: bool) -> bool:
    """is_cancelled gives true for timers that have expired, although the other reading is declared."""
    return self.timer.number not in self.triggers._waiting


class _OwnCopy(ScheduledTimer):
    """Remembers in the object, not in the timer, that it was cancelled."""

    was_cancelled = False

    def cancel(self) -> None:
        super().cancel()
        self.was_cancelled = True


@breaks("R-10.3.1-33", clauses=TRIGGERED, readings={"repeated-result": "timer"}, also=("R-10.3.1-31", "R-10.3.1-17"))
class forgets_that_objects_were_cancelled(_OwnCopy):
    """is_cancelled gives true once."""

    def is_cancelled(self) -> bool:
        answer, self.was_cancelled = self.was_cancelled, False
        return answer


@alters("is_cancelled", "R-10.3.1-33", clauses=TRIGGERED)
def says_never_cancelled_of_repeated_objects(self: ScheduledTimer, own: bool) -> bool:
    """is_cancelled of a repeated timer gives false."""
    return own and self.timer.rate is None


@alters("id", "R-10.3.1-29", clauses=TRIGGERED, also=ANY_TRIGGER)
def renames_cancelled_timers(self: ScheduledTimer, own: str) -> str:
    """The identifier changes when the timer is cancelled."""
    return f"cancelled {own}" if self.is_cancelled() else own


@breaks("R-10.3.1-33", clauses=TRIGGERED)
class remembers_cancellation_by_reference(ScheduledTimer):
    """is_cancelled gives true for the reference through which the timer was cancelled only."""

    was_cancelled = False

    def cancel(self) -> None:
        super().cancel()
        self.was_cancelled = super().is_cancelled()

    def is_cancelled(self) -> bool:
        return self.was_cancelled
