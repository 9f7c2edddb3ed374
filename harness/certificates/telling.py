"""What verification found out, in lines for people."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ucm_cts.harness.certificates.verified import Change, Verified
from ucm_cts.harness.report.order import SEALS
from ucm_cts.harness.results.foreign import clean

_ASSURED = {
    "self-declared": "the vendor chose the seed and ran it",
    "challenged": "an auditor drew the seed after the vendor had committed to the product",
    "witnessed": "an auditor ran it",
}
_FEW = 8
_WIDTH = 20


def told(verified: Verified, name: str, everything: bool = False) -> Iterator[str]:
    """The lines about ``verified``, the certificate in the file ``name``; ``everything`` cuts no list."""
    yield from _headline(verified, name)
    if not verified.product:
        return
    yield _row("profile", f"{verified.profile} of {verified.specification}")
    yield _row("suite", f"ucm-cts {verified.suite_version}")
    yield _row("signed by", ", ".join(verified.signers) or "nobody whom you trust", f"at {verified.issued}")
    yield _row("assurance", verified.assurance, f"({_ASSURED[verified.assurance]})")
    yield _row("isolation", verified.isolation, "(as the signer says)")
    yield _row("sha256", verified.digest)
    for remark in verified.remarks:
        yield _row("note", remark)
    yield _row("subjects", f"{len(verified.subjects)}, with their SHA-256:")
    subjects = [f"{one.sha256[:16]}  {one.name}" for one in verified.subjects]
    yield from _listed(subjects, everything)
    if verified.is_delta:
        yield from _delta(verified, everything)
    yield from _not_covered(verified, everything)
    if verified.word:
        yield "Rests on the signer's word:"
        yield from (f"  - {word}" for word in verified.word)


def _headline(verified: Verified, name: str) -> Iterator[str]:
    what = f"{verified.product} {verified.version}".strip()
    if verified.problems:
        yield f"DOES NOT STAND  {name}" + (f": {what}" if what else "")
        for problem in verified.problems:
            yield f"  {problem.check}: {problem.detail}"
    elif verified.is_delta:
        yield f"STANDS AS SIGNED, JUDGED BY OTHER RULES  {name}: {what}"
        yield f"  today's verdict would be '{verified.verdict}'; this is no certificate of this suite ({verified.judged_by})"
    else:
        yield f"STANDS  {name}: {what}"
        yield f"  {SEALS[verified.verdict]} {verified.verdict.upper()}"


def _delta(verified: Verified, everything: bool) -> Iterator[str]:
    new = [c for c in verified.changes if not c.old]
    gone = [c for c in verified.changes if not c.new]
    other = [c for c in verified.changes if c.old and c.new]
    for changes, what in ((other, "requirements would change"), (new, "are new"), (gone, "are gone")):
        if changes:
            yield f"By today's rules {len(changes)} {what}:"
            yield from _listed([_change(c) for c in changes], everything)
    if not verified.changes:
        yield "No requirement would change by today's rules."
    open_ = [c.requirement for c in verified.changes if c.new == "inconclusive"]
    yield "This suite does not decide:"
    yield "  - whether the record has all scenarios and second looks of its run, and whether its traces can be true: the suite that made it does"
    yield "  - what scenarios, or models, would show that this suite has and the old one had not"
    if open_:
        yield f"  - {len(open_)} requirements that the old traces do not show: {', '.join(open_ if everything else open_[:_FEW])}"


def _change(change: Change) -> str:
    if not change.old or not change.new:
        return f"{change.requirement}: {change.new or 'it was ' + change.old}"
    return f"{change.requirement}: {change.old} -> {change.new}"


def _not_covered(verified: Verified, everything: bool) -> Iterator[str]:
    uncovered = verified.uncovered
    yield "Not covered:"
    for what, ids in (
        ("not testable", uncovered.untestable),
        ("not applicable", uncovered.not_applicable),
        ("readings not declared", uncovered.undeclared),
    ):
        shown = list(ids) if everything else list(ids[:_FEW])
        more = f", and {len(ids) - len(shown)} more (--all)" if len(ids) > len(shown) else ""
        yield _row(what, f"{len(ids)}: {', '.join(shown)}{more}" if ids else "none", width=24)
    for waiver in uncovered.waivers:
        yield _row("known failure", f"{waiver.requirement} until {waiver.expires}: {waiver.reason}", width=24)


def _listed(lines: list[str], everything: bool) -> Iterator[str]:
    shown = lines if everything else lines[:_FEW]
    yield from (f"      {line}" for line in shown)
    if len(lines) > len(shown):
        yield f"      and {len(lines) - len(shown)} more (--all)"


def _row(what: str, *texts: str, width: int = _WIDTH - 8) -> str:
    return f"  {what:<{width}}{' '.join(texts)}"


def safe(lines: Iterable[str]) -> Iterator[str]:
    """The lines, each bounded and printable whatever a certificate holds."""
    return (clean(line).replace("\n", " ") for line in lines)
