"""Conformant variants that deliver messages and report errors in their own way (10.1.2, 10.1.6)."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from ucm_cts.adapters.contract.adapter import NotOffered
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR
from ucm_cts.adapters.mutants.python.methods import refuses_if
from ucm_cts.adapters.mutants.python.registry import Base, variant_of
from ucm_cts.adapters.reference.python.connectors import COMM_ERROR, INTERNAL_ERROR, OK, Link, LinkElement, Taker
from ucm_cts.adapters.reference.python.members import Failures, Member

_FEW, _FULL = 20, 500
_CLAUSES = ("10.1.2", "10.1.6")


class _Codes(Link):
    """Push returns ``unready`` if a receiver is not operational, ``alone`` if there is no receiver."""

    unready = OK
    alone = OK

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        unready = any(not taker.entrance.is_open for taker in self.takers)
        code = self._deliver_to_all(method, arguments)
        if code != OK:
            return code
        return self.alone if not self.takers else self.unready if unready else OK

    def _deliver_to_all(self, method: str, arguments: Sequence[Datum]) -> str:
        return super()._emit(method, arguments)


class _Synchronous(_Codes):
    """Messages are delivered by the emitter's thread."""

    def _deliver_to_all(self, method: str, arguments: Sequence[Datum]) -> str:
        if self.broken:
            return super()._deliver_to_all(method, arguments)
        codes = [self._ask(taker, method, arguments) for taker in self.takers if taker.entrance.is_open]
        return self._sum_up(codes)

    def _ask(self, taker: Taker, method: str, arguments: Sequence[Datum]) -> str:
        try:
            return str(taker.enter(method, self._copied(arguments))[0])
        except Exception:  # noqa: BLE001 - a body may raise anything
            return COMM_ERROR

    def _sum_up(self, codes: list[str]) -> str:
        return OK


@variant_of(
    *_CLAUSES,
    readings={
        "message-delivery": "synchronous",
        "receiver-not-ready": "error",
        "pending-at-stop": "deliver",
        "message-order": "fifo",
        "slow-receiver": "shared",
        "comm-error": "at-once",
    },
)
class delivers_on_the_emitters_thread(_Synchronous):
    """Push returns when all receivers have got the message; it is refused if one is not operational."""

    unready = INTERNAL_ERROR


@variant_of(
    *_CLAUSES,
    readings={
        "receiver-code": "passed",
        "push-without-receiver": "refused",
        "service-failure": "wait",
        "message-delivery": "synchronous",
    },
)
class passes_codes_on(Base):
    """Push returns the last code of a receiver that is not ok. A call waits while its connection is broken. Emitters
    without receivers are not started."""

    class link_class(_Synchronous):
        def _sum_up(self, codes: list[str]) -> str:
            return next((code for code in reversed(codes) if code != OK), OK)

        def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
            while self.broken:
                time.sleep(0.001)
            return super()._request(method, arguments)

    def _check_startable(self) -> None:
        super()._check_startable()
        for member in self.members.values():
            for connection in self._connections_from(member):
                if isinstance(connection.target, LinkElement) and not connection.target.link.takers:
                    raise UcmError("there is no receiver")


@refuses_if("_attach_sender", clauses=_CLAUSES, readings={"push-without-receiver": "refused"})
def attaches_emitters_where_somebody_receives(self: Link, *_: object) -> bool:
    """An emitter can be attached only to a connection that has a receiver."""
    return self.connector == MESSAGE_CONNECTOR and not self.takers


class Holding(_Codes):
    """Messages to a receiver that is not operational arrive when it is started."""

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        for taker in self.takers if not self.broken else ():
            if not taker.entrance.is_open:
                taker.__dict__.setdefault("kept", []).append((method, self._copied(arguments)))
        return super()._emit(method, arguments)

    def release(self, taker: Taker) -> None:
        """Deliver the messages held for ``taker``, which is operational now."""
        for method, arguments in taker.__dict__.pop("kept", ()):
            self._post(taker, method, arguments)


class ReleasesHeld(Base):
    """A component that becomes operational gets the messages held for it."""

    def _open_entrances(self, member: Member) -> None:
        super()._open_entrances(member)
        for link, taker in self._takers_of(member):
            if isinstance(link, Holding):
                link.release(taker)


class _SharedThread(Holding):
    """One thread delivers all messages of the runtime."""

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        shared: Taker = self.manager.__dict__.setdefault("deliverer", Taker(taker.member, taker.port))
        shared.messages.put([taker, taker.__dict__.get("phases", 0), method, arguments])
        if shared.thread is None:
            shared.thread = threading.Thread(target=self._deliver, args=(shared, ""), daemon=True)
            shared.thread.start()

    def _deliver(self, taker: Taker, method: str) -> None:
        while (posted := taker.messages.get()) is not None:
            assert isinstance(posted, list)
            receiver, phase, of, arguments = posted
            with suppress(Exception):
                receiver.entrance.visit(lambda r=receiver, p=phase, m=of, a=arguments: _enter_in_phase(r, p, m, a))


def _enter_in_phase(taker: Taker, phase: int, method: str, arguments: list[Datum]) -> Sequence[Datum]:
    """Call the body, unless its component has been stopped since that phase."""
    return taker.enter(method, arguments) if taker.__dict__.get("phases", 0) == phase else ()


@variant_of(*_CLAUSES, readings={"receiver-not-ready": "hold", "message-order": "fifo", "pending-at-stop": "drop"})
class delivers_all_on_one_thread(ReleasesHeld):
    """Receivers wait for each other, and messages for receivers that are not operational for their start."""

    link_class = _SharedThread

    def _close_entrances(self, member: Member) -> None:
        super()._close_entrances(member)
        for _, taker in self._takers_of(member):
            taker.__dict__["phases"] = taker.__dict__.get("phases", 0) + 1

    def _remove_members(self, failures: Failures) -> None:
        super()._remove_members(failures)
        if (deliverer := self.__dict__.pop("deliverer", None)) is not None:  # the application is destroyed
            deliverer.messages.put(None)


class _SeveralThreads(_Codes):
    """A few threads deliver the messages of a receiver, in any order."""

    alone = COMM_ERROR

    def _post(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        with taker.lock:
            if taker.entrance.is_open:
                if taker.thread is None:
                    taker.messages = queue.SimpleQueue()
                    taker.thread = threading.Thread(
                        target=self._deliver_together, args=(taker, taker.messages, method), daemon=True
                    )
                    taker.thread.start()
                taker.messages.put(arguments[0])

    def _deliver_together(self, taker: Taker, messages: queue.SimpleQueue[Any], method: str) -> None:
        def deliver() -> None:
            while (message := messages.get()) is not None:
                with suppress(Exception):  # push has returned, so no caller gets the exception
                    taker.enter(method, [message])
            messages.put(None)  # so that the next thread ends, too

        threads = [threading.Thread(target=deliver, daemon=True) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    def wait_for(self, taker: Taker) -> None:
        """Wait until all messages have been delivered."""
        while (thread := taker.thread) is not None:
            with taker.lock:
                taker.messages.put(None)
                taker.thread = None
            thread.join()


@variant_of(
    *_CLAUSES,
    readings={"message-order": "unordered", "pending-at-stop": "deliver", "push-without-receiver": "comm_error"},
)
class delivers_in_any_order(Base):
    """Messages may pass each other. What waits when a receiver is stopped is delivered before."""

    link_class = _SeveralThreads

    def _close_entrances(self, member: Member) -> None:
        for link, taker in self._takers_of(member):
            if isinstance(link, _SeveralThreads):
                link.wait_for(taker)
        super()._close_entrances(member)


@variant_of(*_CLAUSES, readings={"comm-error": "eventually", "message-overflow": "refuse"})
class tells_late_and_refuses_much(_Codes):
    """Push returns ok until the connector notices that the transport is broken, and an error if 20 messages wait."""

    late = 0.2
    known = ""
    since = 0.0

    def break_link(self, where: str) -> None:
        super().break_link(where)
        self.since = 0.0

    def mend_link(self) -> None:
        super().mend_link()
        self.since = time.monotonic()

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        now = time.monotonic()
        self.since = self.since or now
        if self.broken == "inside" or now - self.since >= self.late:
            self.known = self.broken
        if self.known:
            return COMM_ERROR if self.known == "transport" else INTERNAL_ERROR
        distant = [taker for taker in self.takers if taker.member.container is not self.manager]
        if any(taker.messages.qsize() > _FEW for taker in distant):
            return INTERNAL_ERROR
        return OK if self.broken else super()._emit(method, arguments)


class _KeepingTaker(Taker):
    """Keeps the messages that wait at stop."""

    def forget(self) -> None:
        with suppress(queue.Empty):
            while True:
                self.__dict__.setdefault("kept", []).append(("push", [self.messages.get_nowait()]))


class _Bounded(Holding):
    """Push waits until there is room, and messages that wait at stop are kept."""

    def _attach_taker(self, member: Member, port: str) -> None:
        super()._attach_taker(member, port)
        self.takers[-1] = _KeepingTaker(member, port)
        self.takers[-1].messages = queue.Queue(_FULL)  # type: ignore[assignment]

    def _deliver(self, taker: Taker, method: str) -> None:
        while (message := taker.messages.get()) is not None:
            try:
                taker.enter(method, [message])
            except UcmError:
                taker.__dict__.setdefault("kept", []).append((method, [message]))
            except Exception:  # noqa: BLE001, S112 - a body may raise anything
                continue


@variant_of(*_CLAUSES, readings={"message-overflow": "block", "pending-at-stop": "keep", "receiver-not-ready": "hold"})
class waits_for_room_and_keeps_at_stop(ReleasesHeld):
    """Push waits while there is no room. Messages that wait at stop arrive after the next start."""

    link_class = _Bounded


@variant_of(*_CLAUSES)
class shares_what_breaks(Link):
    """What breaks one connection breaks all, and for 0.2 s after it was mended calls still fail."""

    mended_at = 0.0

    def break_link(self, where: str) -> None:
        for link in self.manager.links:
            link.broken = where

    def mend_link(self) -> None:
        for link in self.manager.links:
            link.__dict__.update(broken="", mended_at=time.monotonic())

    def _is_slow(self) -> bool:
        return not self.broken and time.monotonic() - self.mended_at < 0.2

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if self._is_slow():
            raise UcmError("the connection is not up again")
        return super()._request(method, arguments)

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        return COMM_ERROR if self._is_slow() else super()._emit(method, arguments)


@variant_of(*_CLAUSES, readings={"transport-fault": "none", "connector-fault": "none"})
class breaks_nothing(Link):
    """The adapter does not offer to break connections, and the vendor declares so."""

    def break_link(self, where: str) -> None:
        raise NotOffered

    mend_link = break_link  # type: ignore[assignment]


@variant_of(*_CLAUSES, readings={"transport-fault": "impossible", "connector-fault": "impossible"})
class cannot_break(breaks_nothing):
    """Nothing lies between the ends of a connection that could break, and the vendor declares so."""


@variant_of(*_CLAUSES, readings={"push-without-receiver": "internal_error"})
class has_no_use_for_messages_without_receiver(_Codes):
    """Push returns internal_error if there is no receiver."""

    alone = INTERNAL_ERROR


_DECLARED = {
    "comm-error": "at-once",
    "message-delivery": "asynchronous",
    "message-order": "fifo",
    "message-overflow": "block",
    "pending-at-stop": "drop",
    "push-without-receiver": "ok",
    "receiver-code": "dropped",
    "receiver-not-ready": "drop",
    "service-failure": "raise",
    "slow-receiver": "independent",
}


@variant_of(*_CLAUSES, readings=_DECLARED)
class declares_what_the_reference_does(Base):
    """The reference framework, with all its options declared."""
