"""A degree of assurance that no auditor bears out is refused. Each way has its own line."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
import pytest
from forging import (
    ADAPTER,
    Forger,
    challenge_to,
    commitment_to,
    forger_of,
    intact,
    key_of,
    made_report,
    run_of,
    seed_of,
    trust,
    verify,
)
from tampering import assert_refused, claimed, vendor

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.certifying import certificate
from ucm_cts.harness.certificates.verified import Subject

AUDITORS = trust("tuev")


def _challenged(make: Callable[[], bytes], **claims: Any) -> bytes:
    """A certificate that answers the challenge of ``make``, with the right seed for it unless ``claims`` have another."""
    answer = make()
    report = msgspec.structs.replace(made_report(), seed=claims.pop("seed", seed_of(answer)))
    forger = forger_of(certificate(run_of(report, assurance="challenged", challenge=answer), [key_of("acme")]))
    forger.claims = msgspec.structs.replace(forger.claims, **claims)
    return forger.resigned()


def _committed(**changes: Any) -> Callable[[], bytes]:
    return lambda: _challenged(lambda: challenge_to(commitment_to(made_report(), **changes)))


def _answer(**changes: Any) -> Callable[[], bytes]:
    def make() -> bytes:
        return challenge_to(commitment_to(made_report()), **changes)

    return lambda: _challenged(make)


def _garbled(**changes: Any) -> bytes:
    """A challenge that cannot be read takes the place of a good one."""
    forger = forger_of(intact("challenged"))
    forger.members[archive.CHALLENGE] = challenge_to(commitment_to(made_report()), **changes)
    return forger.resigned()


def _as_plain(forger: Forger) -> None:
    claimed(assurance="challenged")(forger)


def _answer_in_place_of_commitment() -> bytes:
    forger = forger_of(intact("challenged"))
    both = msgspec.json.decode(forger.members[archive.CHALLENGE])
    both["commitment"] = both["challenge"]
    forger.members[archive.CHALLENGE] = msgspec.json.format(msgspec.json.encode(both), indent=1) + b"\n"
    return forger.resigned()


CHALLENGES: dict[str, tuple[Callable[[], bytes], str, str]] = {
    "seed of the vendor's own": (lambda: _challenged(lambda: challenge_to(commitment_to(made_report())), seed=7), "seed", "the run had seed 7, and commitment and challenge give"),
    "no challenge at all": (lambda: vendor(_as_plain), "challenge", "and has no challenge"),
    "nonce drawn by the vendor": (_answer(auditor="acme"), "auditor", "no auditor whom you rely on signed the challenge"),
    "nonce drawn by a stranger": (_answer(auditor="stranger"), "auditor", "no auditor whom you rely on signed the challenge"),
    "commitment of another vendor": (_answer(vendor="other"), "commitment", "not signed with a key that signed the certificate"),
    "commitment to another product": (_committed(product="Old UCM"), "commitment", "committed to product 'Old UCM'"),
    "commitment to another version": (_committed(version="1.1"), "commitment", "committed to version '1.1'"),
    "commitment to another profile": (_committed(profile="core"), "commitment", "committed to profile 'core'"),
    "commitment to another statement": (_committed(statement="0" * 64), "commitment", "another statement"),
    "commitment to other waivers": (_committed(waivers="0" * 64), "commitment", "another waivers"),
    "commitment to another build of the suite": (_committed(suite="0" * 64), "commitment", "another build of the suite"),
    "commitment to other systematic suites": (_committed(systematic=2), "commitment", "other systematic suites"),
    "commitment to no file": (_committed(subjects=()), "commitment", "no file of the product"),
    "library exchanged after the commitment": (lambda: _exchanged(), "commitment", "another 'adapter/acme.py' than the one that ran"),
    "challenge after the certificate": (_answer(issued="2198-01-01T00:00:00+00:00"), "challenge", "not made in this order"),
    "commitment after the challenge": (_committed(made="2026-10-31T11:00:00+00:00"), "challenge", "not made in this order"),
    "challenge at no time": (_answer(issued="soon"), "challenge", "no moment"),
    "challenge to another commitment": (lambda: _garbled(commitment="0" * 64), "challenge", "to another commitment"),
    "nonce of the vendor's format": (lambda: _garbled(nonce="00"), "challenge", "nonce is none"),
    "challenge number nought": (lambda: _garbled(number=0), "challenge", "counted from 1"),
    "answer in place of the commitment": (_answer_in_place_of_commitment, "challenge", "signed as something else"),
    "witnessed by the vendor": (lambda: vendor(claimed(assurance="witnessed")), "witness", "no auditor whom you rely on signed it"),
}  # fmt: skip


def _exchanged() -> bytes:
    forger = forger_of(intact("challenged"))
    forger.subjects[0] = Subject(ADAPTER.name, "c" * 64)
    return forger.resigned()


@pytest.mark.parametrize("way", CHALLENGES)
def test_what_no_auditor_bears_out_is_refused(way: str) -> None:
    make, check, detail = CHALLENGES[way]
    verified = verify(make(), auditors=AUDITORS)
    assert_refused(verified, check, detail)
    assert verified.assurance == "self-declared"


def test_a_key_in_both_roles_makes_nothing_challenged_or_witnessed() -> None:
    challenged = verify(intact("challenged"), "acme", "tuev", auditors=AUDITORS)
    witnessed = verify(intact("witnessed"), "acme", "tuev", auditors=AUDITORS)
    assert_refused(challenged, "auditor", "nobody challenges himself")
    assert_refused(witnessed, "witness", "nobody witnesses for himself")
    assert challenged.assurance == witnessed.assurance == "self-declared"
