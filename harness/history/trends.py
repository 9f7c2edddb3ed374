"""How verdicts and costs changed from run to run, and since which version a requirement is not passed any more."""

from __future__ import annotations

import itertools
import statistics
from collections import defaultdict
from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.history.store import History, Result, Run
from ucm_cts.harness.results.values import Verdict

COMPARED = 10
"""The number of earlier runs that a cost is compared with."""

DEARER, AT_LEAST = 1.5, 0.5
"""A clause is told if it costs so many times what it did, and so many seconds more."""


class Broken(Value, frozen=True):
    """A requirement that the last run did not pass.

    ``since``: the first run of those without a pass up to the last. ``last_good``: the run before, which passed it; None if none did.
    ``known``: its failures are known. ``flips``: how often its verdict changed in all runs.
    """

    requirement: str
    title: str
    verdict: Verdict
    known: bool
    since: Run
    last_good: Run | None
    flips: int


class Dearer(Value, frozen=True):
    """A clause whose cost grew: ``seconds`` in the last run, ``before`` in the median of the runs before it."""

    clause: str
    seconds: float
    before: float


class Trend(Value, frozen=True):
    """The runs of one product and profile, the last one last; ``counts`` are the verdicts of each.

    ``before``: the median of the seconds of up to ``COMPARED`` runs before the last, None if there are none.
    """

    product: str
    profile: str
    runs: tuple[Run, ...]
    counts: tuple[dict[Verdict, int], ...]
    broken: tuple[Broken, ...]
    before: float | None
    dearer: tuple[Dearer, ...]


def trends(history: History) -> list[Trend]:
    """The trends of each product and profile in ``history``."""
    results: dict[str, dict[str, Result]] = defaultdict(dict)
    for result in history.results:
        results[result.run][result.requirement] = result
    costs: dict[str, dict[str, float]] = defaultdict(dict)
    for cost in history.clauses:
        costs[cost.run][cost.clause] = cost.seconds
    runs: dict[tuple[str, str], list[Run]] = defaultdict(list)
    for run in history.runs:
        runs[run.product, run.profile].append(run)
    return [_trend(subject, found, results, costs) for subject, found in sorted(runs.items())]


def _trend(
    subject: tuple[str, str],
    runs: Sequence[Run],
    results: Mapping[str, Mapping[str, Result]],
    costs: Mapping[str, Mapping[str, float]],
) -> Trend:
    last, earlier = runs[-1], runs[:-1][-COMPARED:]
    counts = []
    for run in runs:
        verdicts = [result.verdict for result in results.get(run.id, {}).values()]
        counts.append({verdict: verdicts.count(verdict) for verdict in dict.fromkeys(verdicts)})
    bad = [r for r in results.get(last.id, {}).values() if r.verdict not in ("pass", "not applicable") and r.decides]
    dearer = []
    for clause, seconds in costs.get(last.id, {}).items():
        known = [costs[run.id][clause] for run in earlier if clause in costs.get(run.id, {})]
        before = statistics.median(known) if known else seconds
        if seconds > DEARER * before and seconds - before > AT_LEAST:
            dearer.append(Dearer(clause, seconds, before))
    return Trend(
        *subject,
        tuple(runs),
        tuple(counts),
        tuple(_broken(result, runs, results) for result in bad),
        statistics.median(run.seconds for run in earlier) if earlier else None,
        tuple(sorted(dearer, key=lambda cost: cost.before - cost.seconds)),
    )


def _broken(result: Result, runs: Sequence[Run], results: Mapping[str, Mapping[str, Result]]) -> Broken:
    """Runs that did not ask the requirement say nothing of it."""
    asked = [
        (run, found.verdict)
        for run in runs
        if (found := results.get(run.id, {}).get(result.requirement)) and found.verdict != "not applicable"
    ]
    since, last_good = asked[-1][0], None
    for run, verdict in reversed(asked):
        if verdict == "pass":
            last_good = run
            break
        since = run
    flips = sum(one[1] != other[1] for one, other in itertools.pairwise(asked))
    return Broken(result.requirement, result.title, result.verdict, result.known, since, last_good, flips)
