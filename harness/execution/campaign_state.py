"""Defines what a campaign has measured so far, as a value: an interrupted run goes on from it."""

from __future__ import annotations

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.results.values import FrameworkReport


class CampaignState(Value, frozen=True):
    """The state of a campaign.

    ``report``: all verdicts so far.
    ``done``: the ids of the test purposes that need not be run again; one that lost a scenario is not among them.
    ``timed``: a scenario that kept each requirement that depends on time, with its name; they are confirmed at the end.
    """

    report: FrameworkReport
    done: tuple[str, ...]
    timed: dict[str, tuple[str, Scenario]]
