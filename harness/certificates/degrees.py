"""Degrees of assurance: what a certificate claims, and what the verifier's keys of auditors bear out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.challenges import Answered
from ucm_cts.harness.certificates.contents import Claims, digest
from ucm_cts.harness.certificates.keys import Trust, TrustedKey
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.reading import Contents, moment_of
from ucm_cts.harness.certificates.verified import Assurance
from ucm_cts.harness.results.foreign import one_line


@dataclass(frozen=True)
class Assured:
    """The degree that is borne out, with the problems of what is claimed. ``number``: of the challenge; 0 without one."""

    assurance: Assurance
    problems: tuple[Problem, ...] = ()
    number: int = 0
    remarks: tuple[str, ...] = ()


def assured(
    contents: Contents, claims: Claims, signers: tuple[TrustedKey, ...], trust: Trust, auditors: Trust
) -> Assured:
    """What the certificate is worth to somebody who relies on ``trust`` for products and on ``auditors`` for audits."""
    answer = contents.challenge
    if claims.assurance == "self-declared":
        if archive.CHALLENGE in contents.members:
            problem = Problem("challenge", "the certificate has a challenge, and says that it is self-declared")
            return Assured("self-declared", (problem,))
        return Assured("self-declared")
    if not auditors:
        told = f"it says that it is {claims.assurance}; --auditor KEYS, with the auditor's public key, would check that"
        return Assured("self-declared", remarks=(told,))
    if claims.assurance == "witnessed":
        return _witnessed(signers, trust, auditors)
    if answer is None:
        absent = archive.CHALLENGE not in contents.members
        lacking = Problem("challenge", "it says that it is challenged, and has no challenge")
        return Assured("self-declared", (lacking,) if absent else ())
    problems = tuple(_wrong(contents, claims, answer, signers, trust, auditors))
    if problems:
        return Assured("self-declared", problems, answer.challenge.number)
    number = answer.challenge.number
    asked = f"it answers the auditor's challenge number {number} for this product, version and profile, given at {answer.challenge.issued}"
    often = "; the vendor asked more than once: ask the auditor for the others" if number > 1 else ""
    return Assured("challenged", (), number, (asked + often,))


def _witnessed(signers: tuple[TrustedKey, ...], trust: Trust, auditors: Trust) -> Assured:
    witnesses = [key for key in signers if key.key.keyid in auditors.keys]
    if not witnesses:
        return Assured(
            "self-declared",
            (Problem("witness", "it says that it is witnessed, and no auditor whom you rely on signed it"),),
        )
    both = [key.name for key in witnesses if key.key.keyid in trust.keys]
    if len(both) == len(witnesses):
        return Assured(
            "self-declared",
            (
                Problem(
                    "witness",
                    f"key '{both[0]}' is trusted for products and as an auditor; nobody witnesses for himself",
                ),
            ),
        )
    return Assured("witnessed")


def _wrong(
    contents: Contents,
    claims: Claims,
    answer: Answered,
    signers: tuple[TrustedKey, ...],
    trust: Trust,
    auditors: Trust,
) -> Iterator[Problem]:
    by_auditor, wrong = answer.by_auditor.who(auditors, "the auditor's answer")
    yield from wrong
    if not by_auditor and not wrong:
        yield Problem("auditor", "no auditor whom you rely on signed the challenge")
    for key in by_auditor:
        if key.rule.lost:
            yield Problem("auditor", f"the auditor's key '{key.name}' was lost on {key.rule.lost}")
        if key.key.keyid in trust.keys:
            yield Problem(
                "auditor", f"key '{key.name}' is trusted for products and as an auditor; nobody challenges himself"
            )
    by_vendor, wrong = answer.by_vendor.who(trust, "the commitment")
    yield from wrong
    if not wrong and not {key.key.keyid for key in by_vendor} & {key.key.keyid for key in signers}:
        yield Problem(
            "commitment",
            "the commitment was not signed with a key that signed the certificate, or not with one that you trust",
        )
    yield from _unlike_commitment(contents, claims, answer)
    if claims.seed != answer.seed:
        yield Problem("seed", f"the run had seed {claims.seed}, and commitment and challenge give {answer.seed}")
    moments = [moment_of(text) for text in (answer.commitment.made, answer.challenge.issued, claims.issued)]
    made, asked, issued = moments
    if made is None or asked is None:
        yield Problem("challenge", "the commitment or the challenge has no moment at which it was made")
    elif made > asked or (issued is not None and asked > issued):
        yield Problem("challenge", "commitment, challenge and certificate were not made in this order")


def _unlike_commitment(contents: Contents, claims: Claims, answer: Answered) -> Iterator[Problem]:
    """What the vendor ran otherwise than committed to."""
    commitment = answer.commitment
    for what in ("product", "version", "profile"):
        if getattr(commitment, what) != getattr(claims, what):
            yield Problem(
                "commitment",
                f"the vendor committed to {what} '{one_line(getattr(commitment, what), 60)}', and the certificate is of '{one_line(getattr(claims, what), 60)}'",
            )
    for member, committed in ((archive.STATEMENT, commitment.statement), (archive.WAIVERS, commitment.waivers)):
        if member in contents.members and digest(contents.members[member]) != committed:
            yield Problem(
                "commitment",
                f"the vendor committed to another {member.partition('.')[0]} than the one in the certificate",
            )
    if contents.environment is not None:
        if contents.environment.suite != commitment.suite:
            yield Problem("commitment", "the vendor committed to another build of the suite than the one that ran")
        if contents.environment.settings.systematic != commitment.systematic:
            yield Problem("commitment", "the vendor committed to other systematic suites than those that ran")
    assert contents.signed is not None
    ran = {one.name: one.digest for one in contents.signed.subject}
    if not commitment.subjects:
        yield Problem("commitment", "the vendor committed to no file of the product")
    for one in commitment.subjects:
        if ran.get(one.name) != one.digest:
            yield Problem(
                "commitment", f"the vendor committed to another '{one_line(one.name, 60)}' than the one that ran"
            )
