"""What changed from a baseline to a newer report of the same product and profile: what ``ucm-cts compare --baseline`` says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.comparison import Column, first_finding
from ucm_cts.harness.report.json_report import RequirementEntry
from ucm_cts.harness.report.order import Shown, clause_key, shown
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.tally import overall
from ucm_cts.harness.results.values import Overall

Change = Literal["regressed", "unstable", "new", "gone", "fixed", "known", "still", "same"]
"""What became of a requirement; ``MEANINGS`` explains each."""

MEANINGS: dict[Change, str] = {
    "regressed": "worse than in the baseline, or missing from the report though the suite asks it",
    "unstable": "its verdict flips in one of the two reports, so that neither is a change",
    "new": "asked now and not in the baseline",
    "gone": "asked in the baseline, and now left out by the statement, the suite or -k",
    "fixed": "passed now and not in the baseline",
    "known": "fails, and is a known failure",
    "still": "not passed, and not in the baseline either",
    "same": "passed both times",
}
"""Each change in words, in the order in which they are told."""

_RANKS: dict[Shown, int] = {"fail": 0, "error": 1, "inconclusive": 1, "not followed": 2, "pass": 3}
_OVERALL: dict[Overall, int] = {"not conformant": 0, "inconclusive": 1, "conformant": 2}


class Difference(Value, frozen=True):
    """One requirement in both reports.

    ``before`` and ``after`` are its verdicts, empty where a report does not ask it. ``detail`` is what was seen, or why it is so.
    ``decides``: whether it decides verdicts; a recommendation does not, and is never a regression that counts.
    """

    id: str
    clause: str
    title: str
    change: Change
    before: Shown | Literal[""]
    after: Shown | Literal[""]
    detail: str
    decides: bool
    seconds: float

    @property
    def counts(self) -> bool:
        """Does it make the comparison fail?"""
        return self.change == "regressed" and self.decides


@dataclass(frozen=True)
class Baseline:
    """Two reports of one product and profile; ``differences`` has the requirements in the order of clauses, those that ``-k`` selected
    if it did.
    """

    old: Column
    new: Column
    differences: tuple[Difference, ...]

    def of(self, change: Change) -> list[Difference]:
        """The requirements with that change."""
        return [difference for difference in self.differences if difference.change == change]

    @property
    def is_worse(self) -> bool:
        """The verdict of the whole is worse, and not for what is new, known or unstable: incidents decide verdicts as well."""
        report = self.new.report
        excused = {d.id for d in self.differences if d.change in ("known", "new", "unstable")}
        rest = [entry for entry in report.requirements if entry.id not in excused]
        verdict = overall(rest, report.incidents, "") if rest else report.verdict
        return _OVERALL[verdict] < _OVERALL[self.old.report.verdict]

    @property
    def has_regressed(self) -> bool:
        """A requirement that decides has regressed, or the verdict of the whole."""
        return self.is_worse or any(difference.counts for difference in self.differences)

    @property
    def is_backwards(self) -> bool:
        """The baseline was run after the report that is compared with it."""
        return self.old.report.started > self.new.report.started


def pairs(old: Sequence[Column], new: Sequence[Column]) -> list[tuple[Column, Column]]:
    """The reports in ``new``, each with that of its product and profile in ``old``. Raises ``WrongUse`` if one has none."""
    baselines = _by_subject(old)
    by_subject = _by_subject(new)
    for subject, column in by_subject.items():
        if subject not in baselines:
            there = "; ".join(_words(*known) for known in baselines)
            raise WrongUse(
                f"'{column.path}' is of {_words(*subject)}, and the baseline has no report of that, but of: {there}"
            )
    return [(baselines[subject], column) for subject, column in by_subject.items()]


def changes(old: Column, new: Column) -> Baseline:
    """What changed from ``old`` to ``new``. Raises ``WrongUse`` for runs that did not end."""
    for column in (old, new):
        if column.report.incomplete:
            why = one_line(column.report.incomplete)
            raise WrongUse(
                f"'{column.path}' cannot be compared: its run is incomplete ({why}); run it again to its end"
            )
    before = {entry.id: entry for entry in old.report.requirements}
    after = {entry.id: entry for entry in new.report.requirements}
    asked = set[str]()
    if not new.report.selection:
        parts = PARTS.get(new.report.profile, ())
        asked = {r.id for r in load_requirements() if r.profile in parts and not r.untestable}
    compared = before.keys() | after.keys()
    if new.report.selection:
        compared &= after.keys()
    if old.report.selection:
        compared &= before.keys()
    if not compared:
        raise WrongUse(f"'{new.path}' has no requirement in common with its baseline '{old.path}'")
    ids = sorted(compared, key=lambda id_: (clause_key((after.get(id_) or before[id_]).clause), id_))
    return Baseline(old, new, tuple(_difference(before.get(id_), after.get(id_), id_ in asked) for id_ in ids))


def _by_subject(columns: Sequence[Column]) -> dict[tuple[str, str], Column]:
    found: dict[tuple[str, str], Column] = {}
    for column in columns:
        subject = (column.report.product, column.report.profile)
        if subject in found:
            raise WrongUse(
                f"'{found[subject].path}' and '{column.path}' are both of {_words(*subject)}; name one of them, not their folder"
            )
        found[subject] = column
    return found


def _words(product: str, profile: str) -> str:
    return f"{one_line(product, 60)}, profile {one_line(profile, 40)}"


def _difference(before: RequirementEntry | None, after: RequirementEntry | None, is_asked: bool) -> Difference:
    entry = after or before
    assert entry is not None
    change, detail = _change(before, after, is_asked)
    return Difference(
        entry.id,
        entry.clause,
        entry.title,
        change,
        shown(before) if before is not None else "",
        shown(after) if after is not None else "",
        detail,
        entry.decides,
        after.seconds if after is not None else 0.0,
    )


def _change(before: RequirementEntry | None, after: RequirementEntry | None, is_asked: bool) -> tuple[Change, str]:
    if after is None:
        missing = "it is not in the report, though the suite asks it"
        return ("regressed", missing) if is_asked else ("gone", "it is not in the report")
    detail = _detail(after)
    if after.verdict == "not applicable":
        asked_before = before is not None and before.verdict != "not applicable"
        return ("gone" if asked_before else "same", detail)
    if after.verdict == "fail" and all(finding.waived for finding in after.findings if not finding.unstable):
        return "known", detail
    if before is None or before.verdict == "not applicable":
        return "new", detail
    flips = [finding.unstable for entry in (after, before) for finding in entry.findings if finding.unstable]
    rank, earlier = _RANKS[shown(after)], _RANKS[shown(before)]
    if flips and rank != earlier:
        return "unstable", flips[0]
    if rank < earlier:
        return "regressed", detail
    if after.verdict == "pass":
        return ("same" if before.verdict == "pass" else "fixed"), detail
    return "still", detail


def _detail(entry: RequirementEntry) -> str:
    finding = first_finding(entry) if entry.verdict == "fail" else None
    return finding.observed if finding is not None else entry.reason
