"""Does destroy free what a runtime took (11.2.2.2)? Counts threads and files of a host that makes and destroys many runtimes.

One runtime proves nothing: a framework may keep a pool of threads for the next one. What grows with each of dozens is a leak.
"""

from __future__ import annotations

import itertools
from contextlib import closing

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Return
from ucm_cts.harness.execution.driving import Answer, Driving
from ucm_cts.harness.hosting.host_watch import Usage
from ucm_cts.reference_models.findings import Finding

FREED = "R-11.2.2.2-07"

HOST_CHECKS: dict[str, str] = {
    "destroy_frees": "Threads and open files of the host do not grow with the runtimes that it has destroyed."
}
"""Checks that rest on what a host's process holds and not on a trace: their names, and what they say."""

_WARMING_UP = 2
_SERIES = (8, 8, 24)
"""Runtimes in a row. Each series must leave as many threads, or files, as runtimes; a pool is full before."""

_STILL_ENDING = 4
"""How many threads, or files, fewer the first series may leave: those of the last warm-up may be ending when it is counted."""


class NotCounted(Exception):
    """What the host's process holds cannot be counted."""


def examine(driver: Driving, name: str, scenario: Scenario, patience: float) -> tuple[Answer, Finding | None] | None:
    """The last run of ``scenario`` and the finding, if destroy leaves something behind; None if a run did not end.

    What is left may go within ``patience`` seconds. Raises ``NotCounted``.
    """
    with closing(driver.many_times(name, scenario)) as runs:
        answer: Answer | None = None
        before: Usage | None = None
        after: Usage | None = None
        for _ in range(_WARMING_UP):
            answer, before = next(runs, (None, None))
        leaking = {"threads", "files"}
        for series, spared in zip(_SERIES, (_STILL_ENDING, 0, 0), strict=True):
            for _ in range(series):
                answer, after = next(runs, (None, None))
            if answer is None:
                return None
            if before is None or after is None:
                raise NotCounted
            leaking_now = leaking
            for usage in itertools.chain((after,), driver.usages(patience)):
                after = usage
                leaking_now = leaking & _grown(before, after, series - spared)
                if not leaking_now:
                    break
            leaking, before = leaking_now, after
            if not leaking:
                return answer, None
        assert answer is not None
        return answer, _finding(answer, min(leaking))


def _grown(before: Usage, after: Usage, by: int) -> set[str]:
    grown = {"threads": after.threads - before.threads, "files": after.files - before.files}
    return {what for what, more in grown.items() if more >= by}


def _finding(answer: Answer, what: str) -> Finding:
    destroy = [n for n, step in enumerate(answer.scenario.steps) if isinstance(step, s.Destroy)]
    ends = [e for e in answer.trace if isinstance(e, Return) and e.step in destroy]
    return Finding(
        FREED,
        "destroy_frees",
        what,
        f"destroy frees the {what} of its runtime",
        f"each of {sum(_SERIES)} runtimes left at least one of its {what} behind when it had been destroyed",
        tuple(event.n for event in ends),
        destroy[-1] if destroy else None,
    )
