"""Compares the trace of a mutant with that of the original framework: a finding must name one of the differences.

Both have run the same scenario. Ids in the permitted range, threads and calendars may differ, and in real time the times;
everything else is compared.
"""

from __future__ import annotations

import difflib
import itertools
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Event, Return, Trace
from ucm_cts.harness.execution.confirmation import is_timed
from ucm_cts.reference_models.findings import Finding

IDS = range(-(2**31), 2**31)
"""What an id may be (12.10)."""

_MOMENT = 1_000_000
"""Nanoseconds by which the time between two events may differ in virtual time: clocks are not read equally often."""

_MAY_DIFFER = ("n", "t", "thread", "detail", "calendar")


@dataclass(frozen=True)
class Divergence:
    """``events`` are the ``n`` of the mutant's events that the other trace has not, or not there; ``steps`` are the steps of
    the scenario during which something is there, or is missing. ``moved`` are those that come earlier or later, in virtual time.
    ``is_of_order``: both traces have the same events, perhaps in another order.
    """

    events: frozenset[int]
    steps: frozenset[int]
    step_of: tuple[int, ...]
    moved: frozenset[int]
    is_of_order: bool

    def explains(self, finding: Finding) -> bool:
        """Does ``finding`` name one of these events, or the step in which one is missing? An event that was only moved explains
        a finding that depends on time.
        """
        if is_timed(finding) and self.moved & set(finding.events):
            return True
        steps = {self.step_of[n - 1] for n in finding.events if 0 < n <= len(self.step_of)}
        if finding.step is not None:
            steps.add(finding.step)
        return bool(self.events & set(finding.events) or self.steps & steps)


def divergence(scenario: Scenario, right: Trace, wrong: Trace, virtual_time: bool = False) -> Divergence:
    """Where ``wrong`` parts from ``right``; both are in the scenario's own names. In ``virtual_time`` their times
    are compared, too.
    """
    step_of = _steps(wrong)
    events: set[int] = set()
    steps: set[int] = set()
    moved: set[int] = set()
    originals, mutated = _comparable(scenario, right), _comparable(scenario, wrong)
    compared = difflib.SequenceMatcher(None, originals, mutated, autojunk=False)
    for kind, same, _, begin, end in compared.get_opcodes():
        if kind == "equal":
            if virtual_time:
                moved.update(_at_other_times(right[same:], wrong[begin:end]))
            continue
        events.update(event.n for event in wrong[begin:end])
        around = range(max(begin - 1, 0), min(end + 1, len(wrong)))
        steps.update(step_of[place] for place in around)
    is_of_order = Counter(originals) == Counter(mutated)
    return Divergence(frozenset(events), frozenset(steps), step_of, frozenset(moved), is_of_order)


def _at_other_times(right: Trace, wrong: Trace) -> Iterator[int]:
    """The ``n`` of events that come earlier or later after the one before them. ``right`` may be longer."""
    for (before, one), (earlier, other) in zip(itertools.pairwise(right), itertools.pairwise(wrong), strict=False):
        if abs((one.t - before.t) - (other.t - earlier.t)) > _MOMENT:
            yield other.n


def _steps(trace: Trace) -> tuple[int, ...]:
    """For each event the step that began or ended last, -1 before the first."""
    steps = []
    latest = -1
    for event in trace:
        latest = getattr(event, "step", latest)
        steps.append(latest)
    return tuple(steps)


def _comparable(scenario: Scenario, trace: Trace) -> Sequence[bytes]:
    """Each event without the fields that may differ; ids are replaced by their order."""
    ids: dict[int, int] = {}
    return [_plain(scenario, event, ids) for event in trace]


def _plain(scenario: Scenario, event: Event, ids: dict[int, int]) -> bytes:
    fields = msgspec.to_builtins(event)
    for field in _MAY_DIFFER:
        fields.pop(field, None)
    if isinstance(event, Return) and 0 <= event.step < len(scenario.steps):
        step = scenario.steps[event.step]
        if isinstance(event.value, int) and isinstance(step, s.AddComponent | s.Connect):
            fields["value"] = ids.setdefault(event.value, len(ids)), event.value in IDS
        elif isinstance(event.value, tuple):
            fields["value"] = sorted(ids.get(each, -1) for each in event.value)
    return msgspec.json.encode(fields)
