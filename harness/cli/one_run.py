"""One run from its first test purpose to the shortest scenarios of its failures, with progress shown."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from rich.progress import TextColumn, TimeElapsedColumn, TimeRemainingColumn

from ucm_cts.harness.cli.terminal import Output, progress_of
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.hosting.pace import lasts
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.foreign import one_line

_MILLISECONDS_A_SCENARIO = 3
"""What a scenario takes that does not wait, so that the time that is left can be estimated from what is done and what waits."""


def carry_out(
    campaign: Campaign,
    purposes: Sequence[TestPurpose],
    draw: Callable[[], int] | None,
    console: Output,
    which: str = "",
    done: Collection[str] = (),
    between: Callable[[], None] = lambda: None,
    hosts: int = 1,
) -> None:
    """Check ``purposes``, ``draw`` scenarios, confirm failures and shorten their scenarios.

    ``draw`` returns how many causes of failure drawn scenarios show. ``which`` run it is goes before each line of progress; the purposes
    with the ids ``done`` were checked before. ``between`` is called after each purpose, and may raise. ``hosts`` is how many wait side by
    side, 0 if waits take no time.
    """
    efforts = {purpose.id: _effort(purpose, hosts) for purpose in purposes}
    number = sum(len(purpose.scenarios) for purpose in purposes)
    finished = sum(len(purpose.scenarios) for purpose in purposes if purpose.id in done)
    with progress_of(console, TextColumn("{task.fields[far]}"), TimeElapsedColumn(), TimeRemainingColumn()) as progress:
        task = progress.add_task(
            f"{which}checking",
            total=sum(efforts.values()),
            completed=sum(efforts[purpose.id] for purpose in purposes if purpose.id in done),
            far=f"{finished} of {number}",
        )
        failing = 0
        for checked in campaign.check(purposes):
            failing += bool(checked.failures)
            finished += checked.executions
            text = f"{which}{failing} failing, {one_line(checked.purpose.id, 50)}"
            far = f"{finished} of {number}"
            progress.update(task, advance=efforts[checked.purpose.id], description=text, far=far)
            between()
        if draw is not None:
            progress.update(task, description=f"{which}drawing scenarios")
            campaign.begin_to_confirm()
            failing += draw()
        progress.update(task, description=f"{which}confirming failures")
        campaign.confirm()
        if failing:
            progress.update(task, description=f"{which}shortening scenarios of failures")
            for _ in campaign.shorten():
                pass


def _effort(purpose: TestPurpose, hosts: int) -> int:
    """About how many milliseconds ``purpose`` takes; only the proportions count."""
    waiting = sum(lasts(scenario) for _, scenario in purpose.scenarios)
    return len(purpose.scenarios) * _MILLISECONDS_A_SCENARIO + (waiting // hosts if hosts else 0)
