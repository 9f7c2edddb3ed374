"""Wrong frameworks, clause 10.1.2: return codes that are unknown or wrong."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from contextlib import suppress

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.reference.python.connectors import COMM_ERROR, INTERNAL_ERROR, OK, Link, LinkElement, Taker
from ucm_cts.adapters.reference.python.members import Member

_CODES = ("10.1.2",)
_MESSAGES = ("10.1.6",)


class _Answering(Link):
    """Push returns what ``answer`` makes of the code, and ``broken_answer`` while the connection is broken."""

    def answer(self, code: str) -> str:
        return code

    def broken_answer(self, where: str, code: str) -> str:
        return code

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        where = self.broken
        code = super()._emit(method, arguments)
        return self.broken_answer(where, code) if where else self.answer(code)


# codes


@replaces("answer", "R-10.1.2-02", clauses=_MESSAGES, also=("R-10.1.2-09",))
def answers_something_else(_self: _Answering, *_: object) -> str:
    """Push returns a code that the specification does not know."""
    return "queued"


@alters("send", "R-10.1.2-02", clauses=_MESSAGES, also=("R-10.1.2-09",))
def answers_nothing(_self: Link, results: Sequence[Datum], method: str, *_: object) -> Sequence[Datum]:
    """Push has no result."""
    return [] if method == "push" else results


@replaces("_post", "R-10.1.2-02", clauses=_CODES)
def passes_exceptions_on(_self: Link, taker: Taker, method: str, arguments: list[Datum]) -> None:
    """A receiver's exception comes back to the emitter."""
    taker.enter(method, arguments)


@breaks("R-10.1.2-02", clauses=_CODES, readings={"push-without-receiver": "comm_error"})
class does_not_tell_that_nobody_is_there(Base):
    """The vendor declares comm_error for push without receivers; push returns ok."""


@replaces("_check_startable", "R-10.1.2-02", clauses=_CODES, readings={"push-without-receiver": "ok"})
def refuses_connections_without_receivers(self: Base) -> None:
    """The vendor declares ok for push without receivers; such emitters are not started."""
    Base._check_startable(self)
    for member in self.members.values():
        for connection in self._connections_from(member):
            if isinstance(connection.target, LinkElement) and not connection.target.link.takers:
                raise UcmError("there is no receiver")


@refuses_if("_attach_sender", "R-10.1.2-02", clauses=_CODES, readings={"push-without-receiver": "ok"})
def refuses_emitters_that_come_first(self: Link, *_: object) -> bool:
    """The vendor declares ok for push without receivers; such emitters cannot be attached."""
    return self.connector == MESSAGE_CONNECTOR and not self.takers


@breaks("R-10.1.2-09", clauses=_MESSAGES)
class tells_of_errors_now_and_then(_Answering):
    """Every third push returns comm_error although nothing is broken."""

    pushed = 0

    def answer(self, code: str) -> str:
        self.pushed += 1
        return COMM_ERROR if self.pushed % 3 == 0 else code


@breaks("R-10.1.2-09", clauses=_MESSAGES)
class never_answers(_Answering):
    """Every fourth push waits for ever."""

    pushed = 0

    def answer(self, code: str) -> str:
        self.pushed += 1
        if self.pushed % 4 == 0 and threading.current_thread() is not threading.main_thread():
            threading.Event().wait()
        return code


class _Passing(Link):
    """Messages are delivered by the emitter's thread, and the worst of the receivers' codes is passed on."""

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        if self.broken:
            return super()._emit(method, arguments)
        worst = OK
        for taker in self.takers:
            if taker.entrance.is_open:
                code = INTERNAL_ERROR
                with suppress(Exception):
                    code = str(taker.enter(method, self._copied(arguments))[0])
                worst = code if code != OK else worst
        return worst


@alters("_emit", "R-10.1.2-09", clauses=_CODES)
def confuses_the_receivers_code(self: _Passing, code: str, *_: object) -> str:
    """Push returns another code than the receiver returned."""
    swapped = {INTERNAL_ERROR: COMM_ERROR, COMM_ERROR: INTERNAL_ERROR}
    return code if self.broken else swapped.get(code, code)


@breaks("R-10.1.2-09", clauses=_CODES, readings={"receiver-code": "passed"})
class drops_the_code_it_said_it_passes(Base):
    """The vendor declares that push returns the receiver's code; push returns ok."""


@breaks("R-10.1.2-09", clauses=_CODES, readings={"receiver-code": "dropped"})
class passes_the_code_it_said_it_drops(_Passing):
    """The vendor declares that the receiver's code is dropped; push returns it."""


@breaks("R-10.1.2-09", clauses=_CODES, readings={"message-overflow": "block"})
class refuses_where_it_said_it_waits(Link):
    """The vendor declares that push waits until there is room; push returns internal_error."""

    limit = 1000

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        if not self.broken and any(taker.messages.qsize() > self.limit for taker in self.takers):
            return INTERNAL_ERROR
        return super()._emit(method, arguments)


# ok


class _Losing(Link):
    each = 3

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        self.__dict__["posted"] = self.__dict__.get("posted", 0) + 1
        if self.__dict__["posted"] % self.each:
            super()._post(taker, method, arguments)


@breaks("R-10.1.2-10", clauses=_MESSAGES, also=("R-10.1.6.1-04", "R-10.1.6.1-03", "R-10.1.6.1-08"))
class loses_every_third_message(_Losing):
    """Every third message is lost, and push returns ok."""


@breaks("R-10.1.2-10", clauses=_CODES)
class loses_the_last_of_many(_Losing):
    """Every fifty-thousandth message of a connection is lost, and push returns ok."""

    each = 50_000


@does_only_if("_post", "R-10.1.2-10", clauses=_CODES)
def drops_what_it_has_no_room_for(_self: Link, taker: Taker, *_: object) -> bool:
    """If 1,000 messages wait for a receiver, further ones are lost and push returns ok."""
    return taker.messages.qsize() < 1000


@breaks("R-10.1.2-10", clauses=_MESSAGES, readings={"message-delivery": "synchronous"}, also=("R-10.1.6.1-04",))
class delivers_later_than_it_said(Link):
    """The vendor declares that push delivers before it returns; messages arrive 10 ms later."""

    def _deliver(self, taker: Taker, method: str) -> None:
        time.sleep(0.01)
        super()._deliver(taker, method)


# what is broken


@replaces("broken_answer", "R-10.1.2-01", "R-10.1.2-11", "R-10.1.2-12", clauses=_CODES)
def does_not_notice_what_is_broken(_self: _Answering, *_: object) -> str:
    """Push returns ok while the transport or the connector is broken."""
    return OK


@replaces("broken_answer", "R-10.1.2-11", "R-10.1.2-12", clauses=_CODES)
def confuses_what_is_broken(_self: _Answering, where: str, *_: object) -> str:
    """Push returns the code of the connector for an error of the transport, and the other way round."""
    return INTERNAL_ERROR if where == "transport" else COMM_ERROR


@breaks("R-10.1.2-11", "R-10.1.2-12", clauses=_CODES)
class stays_broken(_Answering):
    """Push returns the error code of a broken transport or connector after it has been mended."""

    last = ""

    def answer(self, code: str) -> str:
        return self.last or code

    def broken_answer(self, where: str, code: str) -> str:
        self.last = code
        return code


@breaks("R-10.1.2-12", clauses=_CODES, readings={"comm-error": "at-once"})
class notices_later_than_it_said(_Answering):
    """The vendor declares comm_error at once; the first push on a broken transport returns ok."""

    met = 0

    def broken_answer(self, where: str, code: str) -> str:
        self.met += 1
        return OK if self.met == 1 and where == "transport" else code


@replaces("_request", "R-10.1.5.1-01", clauses=_CODES)
def answers_for_servers_out_of_reach(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """A client whose connection is broken gets zeros, as if its server had answered."""
    return (
        [0 for _ in self.interface.methods[method].results] if self.broken else Link._request(self, method, arguments)
    )


@breaks("R-10.1.5.1-01", clauses=_CODES)
class repeats_the_last_result(Link):
    """A client whose connection is broken gets its last result again."""

    last: Sequence[Datum] = ()

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if not self.broken:
            self.last = super()._request(method, arguments)
        return self.last


@replaces("_request", "R-10.1.5.1-01", clauses=_CODES)
def returns_from_what_has_no_results(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """A client whose connection is broken calls a method without results, which returns."""
    return [] if self.broken and not self.interface.methods[method].results else Link._request(self, method, arguments)


@breaks("R-10.1.5.1-01", clauses=_CODES)
class serves_no_more_after_a_fault(Link):
    """Once a connection has been broken its calls fail, also when it has been mended."""

    failed = False

    def break_link(self, where: str) -> None:
        super().break_link(where)
        self.failed = True

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self.failed:
            raise UcmError("the connection was broken")
        return super()._request(method, arguments)


@breaks("R-10.1.5.1-01", clauses=_CODES)
class mends_what_broke_first(Link):
    """What breaks one connection breaks all of its kind, and mending mends that one only."""

    def break_link(self, where: str) -> None:
        for link in self.manager.links:
            link.broken = where if link.connector == self.connector else link.broken


@breaks("R-10.1.2-01", "R-10.1.2-11", clauses=_CODES, also=("R-10.1.2-12",))
class notices_one_fault_only(_Answering):
    """Push returns ok when the connection is broken for the second time."""

    faults = 0

    def break_link(self, where: str) -> None:
        super().break_link(where)
        self.faults += 1

    def broken_answer(self, where: str, code: str) -> str:
        return OK if self.faults > 1 else code


@breaks("R-10.1.2-01", "R-10.1.2-11", "R-10.1.2-12", clauses=_CODES)
class notices_faults_in_one_phase(Base):
    """Push returns ok while the connection is broken if a receiver has been stopped meanwhile."""

    class link_class(_Answering):
        stopped = False

        def mend_link(self) -> None:
            super().mend_link()
            self.stopped = False

        def broken_answer(self, where: str, code: str) -> str:
            return OK if self.stopped else code

    def _close_entrances(self, member: Member) -> None:
        super()._close_entrances(member)
        for link, _ in self._takers_of(member):
            link.__dict__["stopped"] = bool(link.broken)


@breaks("R-10.1.2-01", clauses=_CODES, readings={"service-failure": "wait"})
class does_not_wait_as_it_said(Base):
    """The vendor declares that a call waits while its connection is broken; the call fails at once."""
