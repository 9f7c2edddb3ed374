"""One run from its first test purpose to the shortest scenarios of its failures, with progress shown."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from ucm_cts.harness.cli.terminal import Output, progress_of
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.foreign import one_line


def carry_out(
    campaign: Campaign,
    purposes: Sequence[TestPurpose],
    draw: Callable[[], int] | None,
    console: Output,
    which: str = "",
    done: Collection[str] = (),
    between: Callable[[], None] = lambda: None,
) -> None:
    """Check ``purposes``, ``draw`` scenarios, confirm failures and shorten their scenarios.

    ``draw`` returns how many causes of failure drawn scenarios show. ``which`` run it is goes before each line of progress; the purposes
    with the ids ``done`` were checked before. ``between`` is called after each purpose, and may raise.
    """
    total = sum(len(purpose.scenarios) for purpose in purposes)
    completed = sum(len(purpose.scenarios) for purpose in purposes if purpose.id in done)
    with progress_of(console) as progress:
        task = progress.add_task(f"{which}checking", total=total, completed=completed)
        failing = 0
        for checked in campaign.check(purposes):
            failing += bool(checked.failures)
            text = f"{which}{failing} failing, {one_line(checked.purpose.id, 50)}"
            progress.update(task, advance=checked.executions, description=text)
            between()
        if draw is not None:
            progress.update(task, description=f"{which}drawing scenarios")
            failing += draw()
        progress.update(task, description=f"{which}confirming failures")
        campaign.confirm()
        if failing:
            progress.update(task, description=f"{which}shortening scenarios of failures")
            for _ in campaign.shorten():
                pass
