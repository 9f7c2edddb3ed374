"""Judges a framework's run again from its record, without the product: the same campaign, with recorded answers."""

from __future__ import annotations

from collections.abc import Iterator
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
    """``report``: what the record shows; if there are ``problems``, a line each, it may be of a part of the run.

    ``unshown``: what the record says and no trace shows.
    """

    report: FrameworkReport
    problems: tuple[str, ...]
    unshown: tuple[str, ...] = ()


def judge_again(record: Record, plan: RunPlan) -> Judged:
    """Derive the scenarios of ``plan`` again, compare them with the record, and judge all its traces."""
    replay = Replay(record, plan.seed, plan.limits)
    campaign = Campaign(replay, plan.profile, plan.known, plan.statement)
    problems: list[str] = []
    if record.heading.seed != plan.seed:
        problems.append(f"the record is of seed {record.heading.seed}, and seed {plan.seed} is due")
    departures = tuple(_judge(campaign, replay, plan))
    problems += (*replay.problems, *departures)
    report = campaign.report("the record cannot be judged to its end" if problems else "")
    return Judged(msgspec.structs.replace(report, started=replay.started), tuple(problems), replay.unshown)


def _judge(campaign: Campaign, replay: Replay, plan: RunPlan) -> Iterator[str]:
    """What a run does, step by step. Yields why a step could not be taken to its end.

    What is drawn, and which scenarios are looked at again, follows from the traces before: with a problem there, nothing is drawn, and of
    second looks only those are compared that are asked for and there.
    """
    try:
        for _ in campaign.check(purposes_for(plan.statement, plan.profile, plan.systematic)):
            pass
        if replay.problems:
            if plan.drawn:
                yield f"none of the {plan.drawn} drawn scenarios was compared: they follow from the traces before"
        else:
            replay.is_drawing = True
            draw_scenarios(campaign, plan.seed, plan.drawn)
    except (Departure, WrongUse) as problem:
        yield one_line(str(problem), 400)
    try:
        campaign.confirm()
        if replay.problems:
            return
        for cause, answer in replay.shorter():
            wrong = campaign.take_shorter(cause, answer)
            if wrong:
                raise Departure(
                    f"'{one_line(answer.name, 80)}' cannot show the failure of {one_line(cause[0], 40)}: {wrong}"
                )
        replay.end()
    except (Departure, WrongUse) as problem:
        yield one_line(str(problem), 400)


def without_clock(report: FrameworkReport) -> FrameworkReport:
    """``report`` without what a clock showed and no record has: two reports of one run are then equal."""
    requirements = tuple(msgspec.structs.replace(one, seconds=0.0) for one in report.requirements)
    effort = Effort(report.effort.measures)
    return msgspec.structs.replace(report, requirements=requirements, effort=effort, seconds=0.0, started="")
