"""Judges a framework's run again from its record, without the product: the same campaign, with recorded answers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.recording import Departure, Record, Replay
from ucm_cts.harness.exploring.in_runs import draw_scenarios
from ucm_cts.harness.hosting.host_watch import Limits
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import Effort, FrameworkReport
from ucm_cts.harness.statement.applicability import purposes_for


class RunPlan(Value, frozen=True):
    """All that decides which scenarios a run has: one run of a whole profile, from its begin to its end.

    Runs with ``-k``, ``--repeat`` or ``--resume``, and interrupted ones, have no plan and no record.

    ``seed``: names, payloads and drawn scenarios come from it.
    ``statement``: the vendor's.
    ``known``: the failures that are known.
    ``systematic``: for so many additional states systematic suites are made.
    ``drawn``: how many scenarios are drawn after the test purposes.
    ``seconds``, ``memory`` and ``incident_seconds``: the limits of hosts, as in ``Limits``.
    """

    profile: str
    seed: int
    statement: Statement
    known: tuple[KnownFailure, ...] = ()
    systematic: int = 0
    drawn: Annotated[int, msgspec.Meta(ge=0, le=100_000)] = 0
    seconds: float = Limits.seconds
    memory: int = Limits.memory
    incident_seconds: float = Limits.incident_seconds

    @property
    def limits(self) -> Limits:
        """The limits of hosts."""
        return Limits(seconds=self.seconds, memory=self.memory, incident_seconds=self.incident_seconds)


@dataclass(frozen=True)
class Judged:
    """``report``: what the record shows; if there are ``problems``, a line each, it may be of a part of the run."""

    report: FrameworkReport
    problems: tuple[str, ...]


def judge_again(record: Record, plan: RunPlan) -> Judged:
    """Derive the scenarios of ``plan`` again, compare them with the record, and judge all its traces."""
    replay = Replay(record, plan.seed, plan.limits)
    campaign = Campaign(replay, plan.profile, plan.known, plan.statement)
    problems: list[str] = []
    if record.heading.seed != plan.seed:
        problems.append(f"the record is of seed {record.heading.seed}, and seed {plan.seed} is due")
    try:
        _judge(campaign, replay, plan)
    except (Departure, WrongUse) as problem:
        problems.append(one_line(str(problem), 400))
    problems += replay.problems
    report = campaign.report("the record cannot be judged to its end" if problems else "")
    return Judged(msgspec.structs.replace(report, started=replay.started), tuple(problems))


def _judge(campaign: Campaign, replay: Replay, plan: RunPlan) -> None:
    """What a run does, step by step. Raises ``Departure``."""
    for _ in campaign.check(purposes_for(plan.statement, plan.profile, plan.systematic)):
        pass
    draw_scenarios(campaign, plan.seed, plan.drawn)
    campaign.confirm()
    for cause, answer in replay.shorter():
        problem = campaign.take_shorter(cause, answer)
        if problem:
            raise Departure(
                f"'{one_line(answer.name, 80)}' cannot show the failure of {one_line(cause[0], 40)}: {problem}"
            )
    replay.end()


def without_clock(report: FrameworkReport) -> FrameworkReport:
    """``report`` without what a clock showed and no record has: two reports of one run are then equal."""
    requirements = tuple(msgspec.structs.replace(one, seconds=0.0) for one in report.requirements)
    effort = Effort(report.effort.measures)
    return msgspec.structs.replace(report, requirements=requirements, effort=effort, seconds=0.0, started="")
