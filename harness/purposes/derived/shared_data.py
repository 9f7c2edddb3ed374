"""Scenarios of shared data (10.4.2): writers and readers, steps of writing, freezes, notifications, and what goes wrong.

The test calls a component with a number that says which method it is to call. Readers pass an open gate at each notification, so
that a scenario waits for notifications and never sleeps; that something does not come shows when something comes that was published
later.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Policy, Scenario
from ucm_cts.harness.purposes.derived.shared_data_configuration import ELSEWHERE, Configuration
from ucm_cts.harness.purposes.scripts import TestPurpose

_CLAUSE = "10.4.2"

_BRIEF = 1000
"""Milliseconds of patience where something is waited for in vain."""

_QUIET = 50
"""Milliseconds in which nothing is to come."""

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
        _unpublished(),
        _freezing(),
        _releasing(),
        _writers(),
        _notifications(),
        _protected(),
        _types(),
        _apart(),
        _faults(),
        _phases(),
    ]


def _purpose(name: str, text: str, requirements: str, scenarios: Sequence[tuple[str, Scenario]]) -> TestPurpose:
    ids = tuple(f"R-10.4{one}" if one.startswith((".", "-")) else f"R-10.4.2.{one}" for one in requirements.split())
    cases = tuple((f"shared data/{n}", one) for n, one in scenarios)
    return TestPurpose(f"shared data/{name}", _CLAUSE, text, ids, cases)


def _with(writers: int, readers: int, elsewhere: bool = False) -> Configuration:
    """A connection with so many writers and readers; ``elsewhere``: every second reader is in another container."""
    made = Configuration()
    if elsewhere:
        made.container()
    made.connection()
    for _ in range(writers):
        made.writer()
    for number in range(readers):
        made.reader(ELSEWHERE if elsewhere and number % 2 == 0 else s.MANAGER)
    return made


def _returning() -> TestPurpose:
    """Readers and writers are called on threads of their own, as a call may not come back."""
    made = _with(1, 2).start().update().apart(("read", 0)).apart(("read", 0), ("read", 1))
    scenarios = [("read twice", made.end())]
    made = _with(1, 2).start().update().freeze(0).write().apart(("publish", 0)).release(0).update(of=(1,))
    scenarios.append(("published to a frozen reader", made.end()))
    made = _with(1, 2).start().update().freeze(0, 1).write().apart(("publish", 0)).apart(("read", 0), ("read", 1))
    scenarios.append(("published to frozen readers only", made.release(0, 1).end()))
    text = "Readers read twice, and writers publish while readers are frozen."
    return _purpose("returning", text, ".2-03 2-11 2-14", scenarios)


def _participants() -> TestPurpose:
    """Each writer publishes, each reader reads, before and after a restart."""
    scenarios = []
    for writers, readers, elsewhere in itertools.product((1, 2), (1, 3), (False, True)):
        made = _with(writers, readers, elsewhere).start()
        for writer in range(writers):
            made.update(writer).read().read()
        made.freeze().read().release().cancel().stop().start()
        for writer in reversed(range(writers)):
            made.write(writer).publish(writer).pause(_QUIET).update(writer).read()
        where = ", readers in two containers" if elsewhere else ""
        scenarios.append((f"{writers} writers, {readers} readers{where}", made.end()))
    text = "Each writer publishes, and each reader reads, twice, before and after a restart."
    ids = ".2-01 .2-02 .2-03 .2-05 1-21 1-22 2-01 2-02 2-06 2-07 2-14 2-17"
    return _purpose("participants", text, ids, scenarios)


def _steps() -> TestPurpose:
    """A value is set, several times, and published later or not."""
    scenarios = []
    for readers in (1, 3):
        made = _with(1, readers).start()
        made.update().read().write().read().write().read().publish().await_told(*range(readers)).read()
        made.write(times=3).publish().await_told(*range(readers)).read().update().read()
        scenarios.append((f"one writer, {readers} readers", made.end()))
    made = Configuration().connection().writer().reader(of_writer=0).reader().start()
    made.update().read().write().read().publish().await_told(0, 1).read()
    made.write(times=3).read().publish().await_told(0, 1).read()
    scenarios.append(("a reader is a port of the writer", made.end()))
    made = _with(1, 2)
    made.patience = _BRIEF
    made.start().update().read().publish().pause(_QUIET).read().update().listen(0).listen(1).read()
    scenarios.append(("published twice", made.end()))
    text = "A writer sets values, and publishes the last one, or none."
    return _purpose("steps", text, ".2-04 2-15 2-16 2-17 2-03 2-06", scenarios)


def _cancelling() -> TestPurpose:
    """A value is cancelled before or after it is published."""
    scenarios = []
    for name, first in (("after a publication", True), ("first of all", False)):
        made = _with(1, 2).start()
        if first:
            made.update().read()
        made.write().cancel().publish().pause(_QUIET).read().publish().pause(_QUIET).read()
        made.update().read().write().cancel().write().publish().await_told(0, 1).read()
        scenarios.append((f"cancelled, {name}", made.end()))
    made = _with(1, 2).start()
    made.update().cancel().read().publish().pause(_QUIET).read().update().read()
    scenarios.append(("cancelled when published", made.end()))
    made = _with(1, 1).start()
    made.cancel().publish().pause(_QUIET).update().read().cancel().cancel().write().cancel().read()
    made.write(times=2).cancel().write().publish().await_told(0).read().cancel().read()
    scenarios.append(("nothing to cancel, and two values", made.end()))
    text = "A writer cancels what it has set, or has published, or nothing."
    return _purpose("cancelling", text, "2-18 2-19 2-20 2-21 2-03 1-22", scenarios)


def _unpublished() -> TestPurpose:
    """Readers read, freeze and release before anything was published."""
    made = _with(1, 2).start().read().write().read().publish().await_told(0, 1).read()
    scenarios = [("read first", made.end())]
    made = _with(1, 2).start().freeze(0).read().update(but=(0,)).read().release(0).update(of=(1,)).read()
    scenarios.append(("frozen first", made.end()))
    made = _with(1, 1).start().release().update().read().release().read().update().read()
    scenarios.append(("released without a freeze", made.end()))
    text = "Readers read, freeze or release before anything was published."
    return _purpose("unpublished", text, ".2-03 2-09 2-15 1-22", scenarios)


def _freezing() -> TestPurpose:
    """Readers are frozen while publications go on."""
    scenarios = []
    for readers, frozen in ((1, (0,)), (3, (0,)), (3, (0, 2)), (3, (0, 1, 2))):
        made = _with(1, readers).start().update().read().freeze(*frozen).read()
        for _ in range(2):
            made.update(but=frozen).read()
        made.write().cancel().publish().read().release(*frozen)
        made.update(but=frozen).pause(_QUIET).read()
        scenarios.append((f"{len(frozen)} of {readers} readers frozen", made.end()))
    made = _with(1, 2).start().update().read()
    for _ in range(3):
        made.freeze(0).read(0).update(but=(0,)).read().read(0).release(0).read(0).update(but=(0,)).pause(_QUIET).read()
    scenarios.append(("frozen three times", made.end()))
    made = _with(1, 2).start().update().freeze(0).freeze(0).read(0).update(but=(0,)).read().release(0).pause(_QUIET)
    made.read(0).release(0).update(but=(0,)).pause(_QUIET).read()
    scenarios.append(("frozen twice, released twice", made.end()))
    made = _with(2, 2).start().update(0).freeze(0).update(1, but=(0,)).update(0, but=(0,)).read()
    made.freeze(1).write(1).publish(1).read().release(0, 1).update(0, of=()).pause(_QUIET).read()
    scenarios.append(("two writers, two readers frozen", made.end()))
    text = "Readers are frozen while others publish and read."
    return _purpose("freezing", text, "2-09 2-10 2-11 2-12 2-13 1-22", scenarios)


def _releasing() -> TestPurpose:
    """What a reader gets during a freeze and after its release, if it is given time."""
    scenarios = []
    for missed in (1, 2):
        made = _with(1, 2)
        made.patience = _BRIEF
        made.start().update().read().freeze(0)
        for _ in range(missed):
            made.update(but=(0,))
        made.listen(0).read().release(0).read(0).listen(0).pause(_BRIEF).read()
        made.update(of=(1,)).pause(_BRIEF).read()
        scenarios.append((f"{missed} missed", made.end()))
    text = "A reader is frozen and released, and waited for each time."
    return _purpose("releasing", text, "2-02 2-09 2-12", scenarios)


def _writers() -> TestPurpose:
    """Several writers set, publish and cancel in turns, and at once."""
    scenarios = []
    made = _with(2, 2).start().update(0).update(1).read()
    made.write(0).write(1).publish(0).listen(0).listen(1).read().publish(1).pause(_QUIET).read()
    scenarios.append(("both set, then both publish", made.end()))
    made = _with(2, 2).start().update(0).update(1).read()
    made.write(0).cancel(1).publish(0).listen(0).listen(1).read().update(1).read()
    scenarios.append(("one cancels what it has not set", made.end()))
    made = _with(2, 2).start().update(0).write(1).cancel(1).publish(0).publish(1).pause(_QUIET).read().update(1).read()
    scenarios.append(("one cancels, both publish", made.end()))
    for number in range(3):
        made = _with(2, 3).start().update(0).update(1).read().write(0).write(1)
        made.apart(("publish", 0), ("publish", 1), *(("read", 0),) * bool(number))
        made.await_told(0, 1, 2, times=2).read()
        scenarios.append((f"both publish at once, {number}", made.end()))
    text = "Two writers set, publish and cancel in turns, or at once."
    return _purpose("writers", text, ".2-01 .2-05 .2-06 2-22 2-06", scenarios)


def _notifications() -> TestPurpose:
    """Notifications are counted, read in, and end with the operational phase."""
    scenarios = []
    made = _with(1, 3).start()
    for _ in range(4):
        made.write().publish()
    made.await_told(0, 1, 2, times=4).read().update().read()
    scenarios.append(("four publications in a row", made.end()))
    made = Configuration().connection().writer().reader(reads_inside=True).reader(reads_inside=True).start()
    for _ in range(4):
        made.update()
    scenarios.append(("read inside notifications", made.end()))
    for late in (False, True):
        made = _with(1, 2, elsewhere=True)
        made.start(s.MANAGER) if late else made.start().update().stop(ELSEWHERE)
        made.update(of=(1,)).update(of=(1,)).read(1)
        made.start(ELSEWHERE).read(0).update(of=(1,)).pause(_QUIET).update(of=(1,)).pause(_QUIET).read()
        scenarios.append((f"one reader {'is started later' if late else 'is stopped meanwhile'}", made.end()))
    made = _with(1, 3).start().update().stop().remove(2)
    made.start().update(of=(0, 1)).pause(_QUIET).read(0, 1)
    scenarios.append(("one reader is removed", made.end()))
    text = "Readers are notified of several publications, read in a notification, or are not operational."
    return _purpose("notifications", text, "-04 2-02 2-03 2-04 2-08", scenarios)


def _protected() -> TestPurpose:
    """A protected reader is executed while something is published."""
    made = Configuration().connection().writer().reader(policies=(Policy(s.PROTECTED_PASSIVE),), held=True)
    made.start().enter(0).write().publish().pause(_QUIET).leave(0).await_told(0).read()
    text = "A protected reader is executed while something is published."
    return _purpose("protected", text, "2-05", [("held reader", made.end())])


def _types() -> TestPurpose:
    """Values of each type."""
    scenarios = []
    for name, (of, first, second) in _TYPES.items():
        made = Configuration(of, (first, second, first, second)).connection().writer().reader().reader()
        made.start().update().read().update().read().freeze(0).update(but=(0,)).read().release(0)
        scenarios.append((name, made.end()))
    return _purpose("types", "Values of each type are shared.", ".2-08 .2-06", scenarios)


def _apart() -> TestPurpose:
    """Two connections of one type."""
    made = Configuration().connection().writer().reader().reader()
    made.connection("second").writer().reader().reader().start()
    made.update(0, of=(0, 1)).read(0, 1).update(1, of=(2, 3)).read().write(0).write(1).publish(0).await_told(0, 1)
    made.read().freeze(2).update(0, of=(0, 1)).update(1, of=(3,)).read().release(2)
    made.update(0, of=(0, 1)).read(0, 1).cancel(0).write(1).publish(1).await_told(3).read(3)
    text = "Two connections of one type have writers and readers of their own."
    return _purpose("apart", text, ".2-07", [("two connections", made.end())])


def _faults() -> TestPurpose:
    """The connection is broken and mended."""
    scenarios = []
    places = [("transport", s.MANAGER), ("inside", s.MANAGER), ("transport", ELSEWHERE)]
    for where, place in places:
        made = _with(1, 2, elsewhere=place == ELSEWHERE).start().update().read()
        made.write().break_(where).publish().mend()  # type: ignore[arg-type]
        made.write().publish().pause(_QUIET).update(of=()).pause(_QUIET).read()
        scenarios.append((f"{where} broken{'' if place == s.MANAGER else ', one reader elsewhere'}", made.end()))
    return _purpose("faults", "The connection is broken, and mended.", "1-23", scenarios)


def _phases() -> TestPurpose:
    """All are stopped with a value that is not published, and with a reader that is frozen."""
    made = _with(1, 2).start().update().read().freeze(0).update(but=(0,)).write().stop().start()
    made.read().release(0).update(of=()).pause(_QUIET).update(of=()).pause(_QUIET).read()
    text = "All are stopped with a value that is not published, and with a reader that is frozen."
    return _purpose("phases", text, "2-04 2-06 2-11", [("stopped and started again", made.end())])
