"""Conducts a campaign: asks workers for the units that are missing, and keeps each result as soon as it is there."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from typing import Protocol

from ucm_cts.harness.campaigns.agenda import Agenda, Due
from ucm_cts.harness.campaigns.cluster import WorkersDied
from ucm_cts.harness.campaigns.store import Store


class Workers(Protocol):
    """Those who do units."""

    @property
    def room(self) -> int:
        """For how many more units there is room now."""

    @property
    def asked(self) -> int:
        """How many units are asked for and not answered."""

    def ask(self, due: Due, needed: Sequence[bytes]) -> None:
        """Ask for ``due``, which takes the results ``needed``."""

    def answer(self) -> tuple[Due, bytes | Exception]:
        """The next answer."""


def conduct(
    agenda: Agenda,
    begin: Iterable[Due],
    store: Store,
    workers: Workers,
    tell: Callable[[Due], None] = lambda due: None,
) -> None:
    """Have the units with which ``agenda`` can ``begin`` done, and all that follow; ``tell`` is called when one has ended.

    A worker that dies takes the blame upon all units that it had been given. So those with which workers died again and again are asked
    for once more in the end, one at a time: what kills its worker then is to blame, and is lost.
    """
    ready = deque(begin)
    suspects: deque[Due] = deque()
    while ready or suspects or workers.asked:
        is_alone = not ready and not workers.asked
        if is_alone:
            ready.append(suspects.popleft())
        while ready and workers.room > 0:
            due = ready.popleft()
            needed = [result for place in due.needs if (result := store.get(place)) is not None]
            if len(needed) == len(due.needs):
                workers.ask(due, needed)
            else:
                ready.extendleft(
                    agenda.end(due, "the result of one of its parts was damaged; give the same command again")
                )
                tell(due)
        if not workers.asked:
            continue
        due, answer = workers.answer()
        if isinstance(answer, WorkersDied) and not is_alone:
            suspects.append(due)
            continue
        if isinstance(answer, bytes):
            store.put(due.address, answer)
        # a run that can be concluded is, before others begin
        ready.extendleft(agenda.end(due, str(answer) if isinstance(answer, Exception) else ""))
        tell(due)
