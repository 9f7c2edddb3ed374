"""Defines what a campaign has measured so far, as a value: an interrupted run goes on from it."""

from __future__ import annotations

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.results.tally import Causes
from ucm_cts.harness.results.values import FrameworkReport


class CampaignState(Value, frozen=True):
    """The state of a campaign, or of a part of one.

    ``report``: all verdicts so far.
    ``done``: the ids of the test purposes that need not be run again; one that lost a scenario is not among them.
    ``timed``: a scenario that kept each requirement that depends on time, with its name; they are confirmed at the end.
    ``took``: how many nanoseconds each of them took.
    ``causes``: of the failures in ``report``, in the order in which they were met.
    """

    report: FrameworkReport
    done: tuple[str, ...]
    timed: dict[str, tuple[str, Scenario]]
    took: dict[str, float] = {}
    causes: Causes = ()
