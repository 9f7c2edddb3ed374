"""Checks whether what a record says can be true: each trace by itself, the times from answer to answer, and what was left out for time.

Who shifts all times of a record alike, and keeps to all rules, is not found out.
"""

from __future__ import annotations

import math
from typing import Literal

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.harness.execution.driving import Answer
from ucm_cts.harness.execution.integrity import believable, contradiction
from ucm_cts.harness.hosting.host_watch import Limits
from ucm_cts.harness.hosting.hosts import LONGEST
from ucm_cts.harness.hosting.pace import Pace, waits
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.incidents import IncidentTime
from ucm_cts.harness.results.unanswered_calls import is_left_open
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, Execution, Incident, Isolation

MOST_SHOWN = 20
"""How many problems are told one by one."""

_MILLISECOND = 1_000_000

_Source = Literal["run", "again", "series"]


class Plausibility:
    """Takes the entries of a record in order. ``problems``: what cannot be true, a line each."""

    def __init__(self, isolation: Isolation, limits: Limits) -> None:
        self._is_near = isolation != "remote"
        self._limits = limits
        self._pace = Pace()
        self._found: list[str] = []
        self._more = 0
        self._at = 0
        self._clock: int | None = None
        self._source: _Source = "run"
        self._unoffered = IncidentTime(float("inf"))
        self._for_incidents = 0.0
        self.spent = 0.0
        """Milliseconds that the entries so far can account for."""

    @property
    def problems(self) -> list[str]:
        """What cannot be true; the first ones, and how many more there are."""
        return [*self._found, *([f"{self._more} more of this kind"] if self._more else [])]

    def take_answer(self, at: int, answer: Answer) -> bool:
        """The answer to a scenario of the run. Is it to be taken as it is?"""
        took = self._pass(at, answer)
        self._change_host("run")
        incident = answer.incident
        problem = self._problem_of(answer) or self._out_of_order(answer)
        if incident is None:
            self._unoffered.note_skips(answer.disguised, answer.trace if problem is None else ())
        elif incident.kind == "untried":
            problem = problem or self._tried_too_little(answer.scenario, incident)
        else:
            self._for_incidents += took
        if not self._is_near and (answer.stuck or incident is not None):
            self._clock = None  # another host follows
        return self._is_clean(answer, problem)

    def take_further(self, at: int, answer: Answer, source: _Source) -> bool:
        """A second look, or a run of a series on one host. Is it to be believed?"""
        self._pass(at, answer)
        self._change_host(source)
        if not answer.trace:
            return True
        problem = contradiction(answer.disguised, answer.trace, answer.stuck)
        return self._is_clean(answer, problem or self._out_of_order(answer))

    def take_used_up(self, at: int, since: float, seconds: float) -> None:
        """The time of so many ``seconds`` is said to be used up since ``spent`` was ``since``."""
        last = min(max(at - self._at, 0), self._limits.welcome_seconds * 1000)
        possible = (self.spent - since + last) / 1000
        if possible < seconds:
            self.tell(
                f"second looks are missing: {seconds:g} s for them cannot have been used up, at most {possible:.1f} s were"
            )

    def _problem_of(self, answer: Answer) -> str | None:
        incident = answer.incident
        if incident is None:
            allowed = set(answer.stuck) <= set(answer.scenario.may_stay)
            if not allowed and not is_left_open(Execution("", answer.disguised, answer.trace)):
                return f"{answer.stuck[0]} never came back, and that is no incident"
        elif incident.kind == "contradiction":
            return None  # what contradicts itself is not judged
        elif incident.kind not in FRAMEWORK_INCIDENTS:
            return f"{incident.kind} with a trace" if answer.trace else None
        elif not answer.is_whole:
            is_true = believable(answer.disguised, answer.trace) == answer.trace
            return None if is_true else "the part of the trace before the incident contradicts itself"
        elif incident.kind != "hang" or not answer.stuck:
            return f"{incident.kind} with a whole trace, in which nothing is stuck"
        return contradiction(answer.disguised, answer.trace, answer.stuck)

    def _out_of_order(self, answer: Answer) -> str | None:
        """Times go on from answer to answer, within one host or, on one machine, over the whole record."""
        if not answer.trace or (answer.incident is not None and answer.incident.kind == "contradiction"):
            return None
        before, first = self._clock, answer.trace[0].t
        self._clock = max(event.t for event in answer.trace)
        if before is not None and first < before:
            return f"it begins {before - first} ns before the end of the one before it"
        return None

    def _change_host(self, source: _Source) -> None:
        if not self._is_near and (source != self._source or source == "again"):
            self._clock = None
        self._source = source

    def _pass(self, at: int, answer: Answer) -> float:
        """Time passes. Returns how many milliseconds of it the answer accounts for."""
        if at < self._at:
            self.tell(f"'{one_line(answer.name, 80)}': its answer came {self._at - at} ms before the one before it")
        took = min(max(at - self._at, 0), self._longest(answer))
        self._pace.note(answer.disguised, answer.trace if answer.incident is None else (), math.inf)
        self._at = max(at, self._at)
        self.spent += took
        return took

    def _longest(self, answer: Answer) -> float:
        """Milliseconds that ``answer`` may have taken at most, with the start of its host."""
        start = self._limits.welcome_seconds * 1000
        if answer.trace and answer.incident is None:
            return start + max(0, answer.trace[-1].t - answer.trace[0].t) / 1e6
        more = self._pace.more_for(len(answer.disguised.steps))
        return start + 2000 * LONGEST * (self._limits.seconds + waits(answer.disguised) + more)

    def _tried_too_little(self, scenario: Scenario, incident: Incident) -> str | None:
        """Why the scenario cannot have been left out; None if it can."""
        if self._unoffered.not_tried(scenario) == incident:
            return None
        if self._for_incidents < self._limits.incident_seconds * 1000:
            return f"it was left out, and incidents cannot have taken {self._limits.incident_seconds:g} s before"
        return None

    def _is_clean(self, answer: Answer, problem: str | None) -> bool:
        if problem is not None:
            self.tell(f"the trace of '{one_line(answer.name, 80)}' cannot be true: {one_line(problem)}")
        return problem is None

    def take_contention(self, milliseconds: int, trace: Trace) -> None:
        """For so long threads waited for a processor while ``trace`` came about."""
        times = [event.t for event in trace]
        if milliseconds and milliseconds > (max(times) - min(times)) // _MILLISECOND:
            self.tell(f"threads cannot have waited {milliseconds} ms for a processor: the trace is shorter")

    def tell(self, problem: str) -> None:
        """Add a line about what cannot be true."""
        if len(self._found) < MOST_SHOWN:
            self._found.append(problem)
        else:
            self._more += 1
