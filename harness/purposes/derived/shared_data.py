"""Scenarios of shared data (10.4.2): writers and readers, steps of writing, freezes, notifications, and what goes wrong.

The test calls a component with a number that says which method it is to call. Readers pass an open gate at each notification, so
that a scenario waits for notifications and never sleeps; that something does not come shows when something comes that was published
later.
"""

from __future__ import annotations

import itertools

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.platform_interfaces import FREEZE, READ
from ucm_cts.adapters.contract.scenario import Policy
from ucm_cts.harness.purposes.derived.shared_data_configuration import (
    BRIEF,
    ELSEWHERE,
    QUIET,
    Configuration,
    joined,
    purpose_about,
)
from ucm_cts.harness.purposes.derived.shared_data_freezes import freeze_purposes
from ucm_cts.harness.purposes.derived.through_components import through_components
from ucm_cts.harness.purposes.scripts import TestPurpose

_RECORD = d.Structure(
    "reading", {"number": d.Integer("LONGLONG"), "name": d.String("CHAR8"), "levels": d.Sequence(d.Integer("SHORT"))}
)
_TYPES: dict[str, tuple[d.AnyType, d.Datum, d.Datum]] = {
    "ULONGLONG": (d.Integer("ULONGLONG"), 2**64 - 1, 2**63),
    "DOUBLE": (d.Float("DOUBLE"), "400921fb54442d18", "3ff0000000000000"),
    "BOOLEAN": (d.Boolean(), True, False),
    "CHAR32": (d.Char("CHAR32"), 0x1F600, 0xE9),
    "string": (d.String("CHAR32"), "donnée", "long enough to be cut"),
    "structure": (_RECORD, [-(2**40), "level", [1, -1, 300]], [2**40, "other", []]),
    "array": (d.Array(d.Integer("USHORT"), (2, 2)), [[1, 2], [3, 65535]], [[5, 6], [7, 8]]),
    "sequence": (d.Sequence(d.Integer("LONG")), [1, 2, 3], list(range(100))),
    "enumeration": (d.Enumeration("mode", "ULONG", {"off": 0, "on": 7}), "on", "off"),
}
"""Types of shared data, each with two values."""


def shared_data_purposes() -> list[TestPurpose]:
    """Writers and readers, steps, freezes, notifications, types, faults, phases."""
    return [
        _returning(),
        _participants(),
        _steps(),
        _cancelling(),
        *freeze_purposes(),
        _writers(),
        _notifications(),
        _protected(),
        through_components(_protected()),
        _types(),
        _apart(),
        _ports(),
        _faults(),
        _phases(),
    ]


def _returning() -> TestPurpose:
    """Readers and writers are called on threads of their own, as a call may not come back."""
    made = joined(1, 2).start().update().apart(("read", 0)).apart(("read", 0), ("read", 1))
    scenarios = [("read twice", made.end())]
    made = joined(1, 2).start().update().freeze(0).write().apart(("publish", 0)).release(0).update(of=(1,))
    scenarios.append(("published to a frozen reader", made.end()))
    made = joined(1, 2).start().update().freeze(0, 1).write().apart(("publish", 0)).apart(("read", 0), ("read", 1))
    scenarios.append(("published to frozen readers only", made.release(0, 1).end()))
    text = "Readers read twice, and writers publish while readers are frozen."
    return purpose_about("returning", text, ".2-03 2-11 2-14", scenarios)


def _participants() -> TestPurpose:
    """Each writer publishes, each reader reads, before and after a restart."""
    scenarios = []
    for writers, readers, elsewhere in itertools.product((1, 2), (1, 3), (False, True)):
        made = joined(writers, readers, elsewhere).start()
        for writer in range(writers):
            made.update(writer).read().read()
        made.freeze().read().release().cancel().stop().start()
        for writer in reversed(range(writers)):
            made.write(writer).publish(writer).pause(QUIET).update(writer).read()
        where = ", readers in two containers" if elsewhere else ""
        scenarios.append((f"{writers} writers, {readers} readers{where}", made.end()))
    made = joined(3, 4).start()
    for writer in range(3):
        made.update(writer).read()
    made.write(0).write(1).write(2).publish(2).pause(QUIET).read()
    scenarios.append(("3 writers, 4 readers", made.end()))
    made = joined(1, 2).start()
    for _ in range(24):
        made.update().read()
    scenarios.append(("24 publications", made.end()))
    made = Configuration().container().connection().writer(ELSEWHERE).reader().reader(ELSEWHERE).start()
    made.update().read().write().cancel().publish().update().read()
    scenarios.append(("writer elsewhere", made.end()))
    made = Configuration().connection().reader().writer().reader().start().update().read().update().read()
    scenarios.append(("reader attached first", made.end()))
    text = "Each writer publishes, and each reader reads, twice, before and after a restart."
    ids = ".2-01 .2-02 .2-03 .2-05 1-21 1-22 2-01 2-02 2-06 2-07 2-14 2-17"
    return purpose_about("participants", text, ids, scenarios)


def _steps() -> TestPurpose:
    """A value is set, several times, and published later or not."""
    scenarios = []
    for readers in (1, 3):
        made = joined(1, readers).start()
        made.update().read().write().read().write().read().publish().await_told(*range(readers)).read()
        made.write(times=3).publish().await_told(*range(readers)).read().update().read()
        scenarios.append((f"one writer, {readers} readers", made.end()))
    made = Configuration().connection().writer().reader(of_writer=0).reader().start()
    made.update().read().write().read().publish().await_told(0, 1).read()
    made.write(times=3).read().publish().await_told(0, 1).read()
    scenarios.append(("a reader is a port of the writer", made.end()))
    made = joined(1, 2, patience=BRIEF).start().update().read().publish().listen(0).listen(1).read().update().read()
    scenarios.append(("published twice", made.end()))
    made = joined(1, 2).start().update().update().read().publish().pause(QUIET).read().update().read()
    scenarios.append(("published again after two", made.end()))
    made = Configuration(values=(7, 7, 8, 7)).connection().writer().reader().reader().start()
    for _ in range(4):
        made.update().read()
    scenarios.append(("equal values", made.end()))
    text = "A writer sets values, and publishes the last one, or none."
    return purpose_about("steps", text, ".2-04 2-15 2-16 2-17 2-03 2-06", scenarios)


def _cancelling() -> TestPurpose:
    """A value is cancelled before or after it is published."""
    scenarios = []
    for name, first in (("after a publication", True), ("first of all", False)):
        made = joined(1, 2).start()
        if first:
            made.update().read()
        made.write().cancel().publish().pause(QUIET).read().publish().pause(QUIET).read()
        made.update().read().write().cancel().write().publish().await_told(0, 1).read()
        scenarios.append((f"cancelled, {name}", made.end()))
    made = joined(1, 2).start()
    made.update().cancel().read().publish().pause(QUIET).read().update().read()
    scenarios.append(("cancelled when published", made.end()))
    made = joined(1, 1).start()
    made.cancel().publish().pause(QUIET).update().read().cancel().cancel().write().cancel().read()
    made.write(times=2).cancel().write().publish().await_told(0).read().cancel().read()
    scenarios.append(("nothing to cancel, and two values", made.end()))
    made = joined(1, 2).start().update().read().write(times=2).cancel().publish().pause(QUIET).read().update().read()
    scenarios.append(("two values cancelled, then published", made.end()))
    made = joined(1, 2).start().update().write().cancel().write(times=2).publish().await_told(0, 1).read()
    scenarios.append(("cancelled, then two values", made.end()))
    made = Configuration(values=(7, 8, 8)).connection().writer().reader().start().update().read()
    made.write().cancel().write().publish().await_told(0).read()
    scenarios.append(("cancelled, then an equal value", made.end()))
    text = "A writer cancels what it has set, or has published, or nothing."
    return purpose_about("cancelling", text, "2-18 2-19 2-20 2-21 2-03 1-22", scenarios)


def _writers() -> TestPurpose:
    """Several writers set, publish and cancel in turns, and at once."""
    scenarios = []
    made = joined(2, 2).start().update(0).update(1).read()
    made.write(0).write(1).publish(0).listen(0).listen(1).read().publish(1).pause(QUIET).read()
    scenarios.append(("both set, then both publish", made.end()))
    made = joined(2, 2).start().update(0).update(1).read()
    made.write(0).cancel(1).publish(0).listen(0).listen(1).read().update(1).read()
    scenarios.append(("one cancels what it has not set", made.end()))
    made = joined(2, 2).start().update(0).write(1).cancel(1).publish(0).publish(1).pause(QUIET).read().update(1).read()
    scenarios.append(("one cancels, both publish", made.end()))
    made = joined(2, 2).start().update(0).read().write(0).publish(1).pause(QUIET).read().publish(0).pause(QUIET).read()
    scenarios.append(("one sets, the other publishes", made.update(1).read().end()))
    for number in range(3):
        made = joined(2, 3).start().update(0).update(1).read().write(0).write(1)
        made.apart(("publish", 0), ("publish", 1), *(("read", 0),) * bool(number))
        made.await_told(0, 1, 2, times=2).read().read().read()
        scenarios.append((f"both publish at once, {number}", made.end()))
    text = "Two writers set, publish and cancel in turns, or at once."
    return purpose_about("writers", text, ".2-01 .2-05 .2-06 2-22 2-06", scenarios)


def _notifications() -> TestPurpose:
    """Notifications are counted, read in, and end with the operational phase."""
    scenarios = []
    made = joined(1, 3).start()
    for _ in range(4):
        made.write().publish()
    made.await_told(0, 1, 2, times=4).read().update().read()
    scenarios.append(("four publications in a row", made.end()))
    made = Configuration().connection().writer().reader(reads_inside=True).reader(reads_inside=True).start()
    for _ in range(4):
        made.update()
    scenarios.append(("read inside notifications", made.end()))
    made = Configuration().connection().writer().reader().reader().calls_inside(0, FREEZE).calls_inside(0, READ)
    scenarios.append(("frozen inside a notification", made.start().update().read(0).update(but=(0,)).read().end()))
    for late in (False, True):
        made = joined(1, 2, elsewhere=True, patience=BRIEF)
        made.start(s.MANAGER) if late else made.start().update().stop(ELSEWHERE)
        made.update(of=(1,)).start(ELSEWHERE).read(0).update(of=(1,)).listen(0).wait_in_vain().read()
        made.update(of=(1,)).listen(0).wait_in_vain().read()
        scenarios.append((f"one reader {'is started later' if late else 'is stopped'}, and waited for", made.end()))
    for late in (False, True):
        made = joined(1, 2, elsewhere=True)
        made.start(s.MANAGER) if late else made.start().update().stop(ELSEWHERE)
        made.update(of=(1,)).update(of=(1,)).read(1)
        made.start(ELSEWHERE).read(0).update(of=(1,)).pause(QUIET).update(of=(1,)).pause(QUIET).read()
        scenarios.append((f"one reader {'is started later' if late else 'is stopped meanwhile'}", made.end()))
    made = joined(1, 3).start().update().stop().remove(2)
    made.start().update(of=(0, 1)).pause(QUIET).read(0, 1)
    scenarios.append(("one reader is removed", made.end()))
    text = "Readers are notified of several publications, read in a notification, or are not operational."
    return purpose_about("notifications", text, "-04 2-02 2-03 2-04 2-08", scenarios)


def _protected() -> TestPurpose:
    """A protected reader is executed while something is published."""
    made = Configuration().connection().writer().reader(policies=(Policy(s.PROTECTED_PASSIVE),), held=True)
    made.start().enter(0).write().publish().pause(QUIET).leave(0).await_told(0).read()
    scenarios = [("held reader", made.end())]
    made = Configuration().connection().writer().reader(policies=(Policy(s.PROTECTED_PASSIVE),), held=True).reader()
    made.start().enter(0).write().publish().await_told(1).read(1).leave(0).await_told(0).read()
    scenarios.append(("held reader and another one", made.end()))
    text = "A protected reader is executed while something is published."
    return purpose_about("protected", text, "2-05", scenarios)


def _types() -> TestPurpose:
    """Values of each type."""
    scenarios = []
    for name, (of, first, second) in _TYPES.items():
        made = Configuration(of, (first, second, first, second)).connection().writer().reader().reader()
        made.start().update().read().update().read().freeze(0).update(but=(0,)).read().release(0)
        scenarios.append((name, made.end()))
    values: tuple[d.Datum, ...]
    for name, of, values in (
        ("negative numbers", d.Integer("LONG"), (-1, -(2**31), 0)),
        ("long strings", d.String("CHAR8"), ("x" * 1000, "", "e")),
        ("long sequences", d.Sequence(d.Integer("LONG")), (list(range(1000)), [], [1])),
    ):
        made = Configuration(of, values).connection().writer().reader().start()
        scenarios.append((name, made.update().read().update().read().update().read().end()))
    records: tuple[d.Datum, ...] = tuple([n, "abcd"[n], [n]] for n in range(4))
    made = Configuration(_RECORD, records).connection().writer().writer().reader().reader().start()
    made.update(0).update(1).read().write(0).write(1).apart(("publish", 0), ("publish", 1), ("read", 0))
    scenarios.append(("structures at once", made.await_told(0, 1, times=2).read().read().read().end()))
    return purpose_about("types", "Values of each type are shared.", ".2-08 .2-06", scenarios)


def _apart() -> TestPurpose:
    """Two connections of one type."""
    made = Configuration().connection().writer().reader().reader()
    made.connection("second").writer().reader().reader().start()
    made.update(0, of=(0, 1)).read(0, 1).update(1, of=(2, 3)).read().write(0).write(1).publish(0).await_told(0, 1)
    made.read().freeze(2).update(0, of=(0, 1)).update(1, of=(3,)).read().release(2)
    made.update(0, of=(0, 1)).read(0, 1).cancel(0).write(1).publish(1).await_told(3).read(3)
    scenarios = [("two connections", made.end())]
    made = Configuration().connection().writer().reader().connection("second").writer().reader().reader().start()
    made.update(0, of=(0,)).update(1, of=(1, 2)).read().freeze(0, 1).update(1, of=(2,)).release(0).read()
    made.update(1, of=(2,)).read().release(1).write(0).write(1).cancel(0).publish(1).await_told(2).pause(QUIET).read()
    scenarios.append(("freezes and cancellations of two connections", made.end()))
    text = "Two connections of one type have writers and readers of their own."
    return purpose_about("apart", text, ".2-07", scenarios)


def _ports() -> TestPurpose:
    """A component has two ports of one connection, or one of each of two."""
    made = Configuration().connection().writer().reader().reader(of_reader=0).reader().start().update().read().freeze(0)
    made.read().update(of=(2,)).pause(QUIET).read().freeze(1).release(0).update(of=(2,)).pause(QUIET).read()
    scenarios = [("one of two ports of a reader is frozen", made.release(1).update(of=(2,)).pause(QUIET).read().end())]
    made = Configuration().connection().writer().reader().connection("second").writer().reader(of_reader=0).reader()
    made.start().update(0, of=(0,)).update(1, of=(1, 2)).read().freeze(0).update(1, of=(2,)).pause(QUIET).read()
    made.update(0, of=()).pause(QUIET).read().release(0).write(0).publish(1).publish(0).pause(QUIET).read()
    scenarios.append(("ports of two connections, one frozen", made.end()))
    made = Configuration().connection().writer().writer(of_writer=0).reader().reader().start().update(0).update(1)
    made.read().write(0).write(1).publish(1).await_told(0, 1).read().publish(0).await_told(0, 1).read()
    made.write(0).write(1).cancel(0).publish(1).await_told(0, 1).read()
    scenarios.append(("a writer has two ports", made.end()))
    text = "Readers and writers have two ports, of one connection or of two."
    return purpose_about("ports", text, ".2-06 .2-07 2-02 2-06 2-09 2-10", scenarios)


def _faults() -> TestPurpose:
    """The connection is broken and mended."""
    scenarios = []
    places = [("transport", s.MANAGER), ("inside", s.MANAGER), ("transport", ELSEWHERE)]
    for where, place in places:
        made = joined(1, 2, elsewhere=place == ELSEWHERE).start().update().read()
        made.write().break_(where).publish().mend()  # type: ignore[arg-type]
        made.write().publish().pause(QUIET).update(of=()).pause(QUIET).read()
        scenarios.append((f"{where} broken{'' if place == s.MANAGER else ', one reader elsewhere'}", made.end()))
    made = joined(1, 2, patience=BRIEF).start().update().read()
    for _ in range(2):
        made.write().break_("transport").publish().mend().write().publish().listen(0)
        made.wait_in_vain().read().update().read()
    scenarios.append(("transport broken twice", made.end()))
    return purpose_about("faults", "The connection is broken, and mended.", "1-23", scenarios)


def _phases() -> TestPurpose:
    """All are stopped with a value that is not published, and with a reader that is frozen."""
    made = joined(1, 2).start().update().read().freeze(0).update(but=(0,)).write().stop().start()
    made.read().release(0).update(of=()).pause(QUIET).update(of=()).pause(QUIET).read()
    scenarios = [("stopped and started again", made.end())]
    made = joined(1, 2, patience=BRIEF).start().update().read().freeze(0).update(but=(0,)).write().stop().start()
    made.read().release(0).update(of=(1,)).listen(0).wait_in_vain().read()
    scenarios.append(("stopped and started again, and waited for", made.end()))
    made = joined(1, 2).start().update().read()
    for _ in range(3):
        made.stop().start().update(of=()).pause(QUIET).read().update(of=()).pause(QUIET).read()
    scenarios.append(("started four times", made.end()))
    text = "All are stopped with a value that is not published, and with a reader that is frozen."
    return purpose_about("phases", text, "2-04 2-06 2-11", scenarios)
