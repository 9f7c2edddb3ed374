"""The results of generated mutants as a page: figures, survivors and the reasons why they survive."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS
from ucm_cts.harness.selftest.generated.mutants import GENERATED, NO_PROGRAM, SAME
from ucm_cts.harness.selftest.generated.record import Result
from ucm_cts.harness.selftest.generated.trial import Fate

_KILLED: tuple[Fate, ...] = ("failed", "incident", "not loaded")
_ALIVE: tuple[Fate, ...] = ("survived", "not certified", "open")


@dataclass(frozen=True)
class Tally:
    """The figures of one framework: ``drawn`` mutants of all that could be run, with their fates."""

    census: Mapping[str, int]
    candidates: int
    results: Sequence[Result]
    reasons: Mapping[str, str]

    @property
    def killed(self) -> list[Result]:
        """A requirement failed, the framework crashed or hung, or it could not even be loaded."""
        return [r for r in self.results if r.outcome.fate in _KILLED]

    @property
    def equivalent(self) -> list[Result]:
        """Survivors that no clause distinguishes from the original."""
        return [r for r in self.results if r.outcome.fate in _ALIVE and r.mutant.key in self.reasons]

    @property
    def open(self) -> list[Result]:
        """Survivors without an explanation."""
        return [r for r in self.results if r.outcome.fate in _ALIVE and r.mutant.key not in self.reasons]

    @property
    def wrongly_listed(self) -> list[Result]:
        """Said to be equivalent, and killed: the reason is wrong, or the rule is."""
        return [r for r in self.results if r.outcome.fate in _KILLED and r.mutant.key in self.reasons]

    @property
    def rate(self) -> float:
        """Killed ones of those that are not equivalent, in percent."""
        judged = len(self.killed) + len(self.open)
        return 100 * len(self.killed) / judged if judged else 0.0


def page(title: str, intro: str, tally: Tally) -> str:
    """The page, in Markdown."""
    lines = [f"# {title}", "", *intro.strip().splitlines(), "", *_figures(tally)]
    lines += ["", "## Survivors that no clause distinguishes from the original", ""]
    by_reason: dict[str, list[Result]] = {}
    for result in tally.equivalent:
        by_reason.setdefault(tally.reasons[result.mutant.key], []).append(result)
    for reason, results in sorted(by_reason.items(), key=lambda item: -len(item[1])):
        lines += [f"**{reason}**", "", *_listed(results), ""]
    lines += ["## Survivors that are open", "", *(_listed(tally.open) or ["None."]), ""]
    if tally.wrongly_listed:
        lines += ["## Listed as equivalent, and killed", "", *_listed(tally.wrongly_listed), ""]
    return "\n".join(lines)


def _figures(tally: Tally) -> list[str]:
    fates = Counter(result.outcome.fate for result in tally.results)
    incidents = [result for result in tally.results if result.outcome.fate == "incident"]
    nonsense = [result for result in incidents if result.outcome.by not in FRAMEWORK_INCIDENTS]
    rows: list[tuple[str, object]] = [(GENERATED, tally.census[GENERATED])]
    rows += [(f"of these {what}", n) for what, n in tally.census.items() if what != GENERATED]
    rows += [("that can be run", tally.candidates), ("drawn and tried", len(tally.results))]
    rows += [(f"of these {NO_PROGRAM}", fates["not compiled"]), (f"of these {SAME}", fates["same program"])]
    rows += [
        ("killed: a requirement failed", fates["failed"]),
        ("killed: it crashed or hung", fates["incident"] - len(nonsense)),
        ("killed: what it answered was no answer, so that it was not certified", len(nonsense)),
        ("killed: it could not be loaded", fates["not loaded"]),
        ("survived, equivalent", len(tally.equivalent)),
        ("survived, open", len(tally.open)),
        ("killed of those that are not equivalent", f"{tally.rate:.1f} %"),
    ]
    shown = [f"| {what} | {figure} |" for what, figure in rows if figure or not what.startswith("of these")]
    return ["| | |", "|---|---:|", *shown]


def _listed(results: Iterable[Result]) -> list[str]:
    found = sorted(results, key=lambda r: (r.mutant.file, r.mutant.number, r.mutant.becomes))
    return [f"- `{_plain(r.mutant.key)}`{_how(r)}" for r in found]


def _how(result: Result) -> str:
    shown = f"{result.outcome.by} {result.outcome.detail}".strip()
    return f" ({result.outcome.fate}: {_plain(shown)[:200]})" if shown and result.outcome.fate != "open" else ""


def _plain(text: str) -> str:
    return text.replace("`", "'").replace("\n", " ⏎ ")
