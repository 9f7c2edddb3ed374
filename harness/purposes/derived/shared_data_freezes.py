"""Scenarios of shared data (10.4.2) in which readers read before anything was published, freeze what they read, and release it."""

from __future__ import annotations

from ucm_cts.harness.purposes.derived.shared_data_configuration import (
    BRIEF,
    QUIET,
    Configuration,
    joined,
    purpose_about,
)
from ucm_cts.harness.purposes.scripts import TestPurpose


def freeze_purposes() -> list[TestPurpose]:
    """Reads before the first publication, freezes, and what comes after a release."""
    return [_unpublished(), _freezing(), _releasing()]


def _unpublished() -> TestPurpose:
    """Readers read, freeze and release before anything was published."""
    made = joined(1, 2).start().read().write().read().publish().await_told(0, 1).read()
    scenarios = [("read first", made.end())]
    made = joined(1, 2).start().freeze(0).read().update(but=(0,)).read().release(0).update(of=(1,)).read()
    scenarios.append(("frozen first", made.end()))
    made = joined(1, 1).start().release().update().read().release().read().update().read()
    scenarios.append(("released without a freeze", made.end()))
    text = "Readers read, freeze or release before anything was published."
    return purpose_about("unpublished", text, ".2-03 2-09 2-15 1-22", scenarios)


def _freezing() -> TestPurpose:
    """Readers are frozen while publications go on."""
    scenarios = []
    for readers, frozen in ((1, (0,)), (3, (0,)), (3, (0, 2)), (3, (0, 1, 2))):
        made = joined(1, readers).start().update().read().freeze(*frozen).read()
        for _ in range(2):
            made.update(but=frozen).read()
        made.write().cancel().publish().read().release(*frozen)
        made.update(but=frozen).pause(QUIET).read()
        scenarios.append((f"{len(frozen)} of {readers} readers frozen", made.end()))
    made = joined(1, 2).start().update().read()
    for _ in range(6):
        made.freeze(0).read(0).update(but=(0,)).read().read(0).release(0).read(0).update(but=(0,)).pause(QUIET).read()
    scenarios.append(("frozen six times", made.end()))
    made = joined(1, 2).start().update().freeze(0).freeze(0).read(0).update(but=(0,)).read().release(0).pause(QUIET)
    made.read(0).release(0).update(but=(0,)).pause(QUIET).read()
    scenarios.append(("frozen twice, released twice", made.end()))
    made = joined(2, 2).start().update(0).freeze(0).update(1, but=(0,)).update(0, but=(0,)).read()
    made.freeze(1).write(1).publish(1).read().release(0, 1).update(0, of=()).pause(QUIET).read()
    scenarios.append(("two writers, two readers frozen", made.end()))
    made = joined(1, 3).start().update().read().freeze(0, 2).read(0, 2).update(of=(1,)).release(0)
    made.update(of=(1,)).pause(QUIET).read().release(2).update(of=(1,)).pause(QUIET).read()
    scenarios.append(("one of two released", made.end()))
    made = joined(1, 2).start().update().freeze(0).read(0).update(but=(0,)).freeze(0).read(0).update(but=(0,)).read(0)
    made.release(0).release(0).update(but=(0,)).pause(QUIET).read()
    scenarios.append(("frozen again after a publication", made.end()))
    made = joined(1, 2).start().update().release(0).freeze(0).update(but=(0,)).read().release(0).release(0)
    made.freeze(0).read(0).update(but=(0,)).read(0).release(0)
    scenarios.append(("released, then frozen", made.end()))
    made = joined(1, 2).start().update().read().write().freeze(0).read().publish().await_told(1).read()
    made.write().release(0).pause(QUIET).read().publish().await_told(1).pause(QUIET).read()
    scenarios.append(("set, frozen, published; set, released, published", made.end()))
    made = Configuration().connection().writer().reader(of_writer=0).reader().start().update().read()
    made.freeze(0).read(0).update(but=(0,)).read().release(0).update(but=(0,)).pause(QUIET).read()
    scenarios.append(("the writer is a frozen reader", made.end()))
    made = joined(1, 2).start().update().freeze(0).update(but=(0,)).release(0).update(of=(1,)).pause(QUIET).read()
    made.freeze(0).read(0).release(0).pause(QUIET).read().update(of=(1,)).pause(QUIET).read()
    scenarios.append(("frozen again, and nothing is missed", made.end()))
    made = joined(1, 3).start().update().read().freeze(2).update(but=(2,)).stop().remove(2).start()
    made.update(of=(0, 1)).read(0, 1).freeze(0).update(of=(1,)).read(0, 1).release(0)
    made.update(of=(1,)).pause(QUIET).read(0, 1)
    scenarios.append(("a frozen reader is removed", made.end()))
    text = "Readers are frozen while others publish and read."
    return purpose_about("freezing", text, "2-09 2-10 2-11 2-12 2-13 1-22", scenarios)


def _releasing() -> TestPurpose:
    """What a reader gets during a freeze and after its release, if it is given time."""
    scenarios = []
    for missed in (1, 2, 4):
        made = joined(1, 2, patience=BRIEF).start().update().read().freeze(0)
        for _ in range(missed):
            made.update(but=(0,))
        made.listen(0).read().release(0).read(0).listen(0).wait_in_vain().read()
        made.update(of=(1,)).wait_in_vain().read()
        scenarios.append((f"{missed} missed", made.end()))
    made = joined(1, 2, patience=BRIEF).start().update().read().freeze(0).update(but=(0,)).write().cancel().release(0)
    made.listen(0).wait_in_vain().read()
    scenarios.append(("cancelled while frozen", made.end()))
    made = joined(2, 2, patience=BRIEF).start().update(0).read().freeze(0).update(0, but=(0,)).update(1, but=(0,))
    made.release(0).listen(0).wait_in_vain().read().read(0).read(0)
    scenarios.append(("missed of both writers", made.end()))
    made = joined(2, 2).start().update(0).freeze(0).release(0).update(0).update(1).read()
    scenarios.append(("released, then both writers", made.end()))
    text = "A reader is frozen and released, and waited for each time."
    return purpose_about("releasing", text, "2-02 2-09 2-12", scenarios)
