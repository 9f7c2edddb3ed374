"""Trends as lines for people."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.harness.history.trends import Broken, Trend
from ucm_cts.harness.report.order import SEALS, SYMBOLS
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Verdict

SHOWN = 10
"""The number of runs that are listed; all of them count."""

_ORDER: tuple[Verdict, ...] = ("fail", "error", "inconclusive", "pass", "not applicable")


def told(trend: Trend) -> Iterator[str]:
    """The last runs of a product in a profile, what is not passed and since when, and what costs more than it did."""
    number = f"{len(trend.runs)} run{'' if len(trend.runs) == 1 else 's'}"
    yield f"{one_line(trend.product, 60)}, profile {one_line(trend.profile, 40)}: {number}"
    if len(trend.runs) > SHOWN:
        yield f"  the last {SHOWN}:"
    width = max(len(_version(run.version)) for run in trend.runs[-SHOWN:])
    for run, counts in zip(trend.runs[-SHOWN:], trend.counts[-SHOWN:], strict=True):
        verdicts = "  ".join(f"{SYMBOLS[verdict]} {counts[verdict]}" for verdict in _ORDER if counts.get(verdict))
        verdicts = f"{SEALS[run.verdict]} {run.verdict}: {verdicts}"
        cost = f"{run.seconds:.1f} s, {run.scenarios:,} scenarios"
        yield f"  {run.started[:16].replace('T', ' ')}  {_version(run.version):<{width}}  {verdicts}  {cost}"
    for broken in trend.broken:
        yield f"  {_broken(broken)}"
    if trend.before is not None:
        now = trend.runs[-1].seconds
        yield f"  the last run took {now:.1f} s, those before {trend.before:.1f} s (median)"
    for dearer in trend.dearer:
        yield f"  clause {one_line(dearer.clause, 20)}: {dearer.seconds:.1f} s instead of {dearer.before:.1f} s"


def _broken(broken: Broken) -> str:
    first = f"first bad version {_version(broken.since.version)} ({broken.since.started[:10]})"
    good = broken.last_good
    since = f"{first}, last good {_version(good.version)} ({good.started[:10]})" if good else f"{first}, never passed"
    flips = f", changed {broken.flips} times" if broken.flips > 1 else ""
    known = ", known" if broken.known else ""
    return f"{SYMBOLS[broken.verdict]} {broken.requirement}  {broken.verdict}{known}: {since}{flips}  {one_line(broken.title, 80)}"


def _version(version: str) -> str:
    return one_line(version, 24) or "none"
