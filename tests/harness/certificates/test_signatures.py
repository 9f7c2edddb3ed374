"""What a signature vouches for, and what is told of several lies."""

from __future__ import annotations

import base64
from typing import Any

import msgspec
from forging import (
    fake_judge,
    forger_of,
    intact,
    key_of,
    made_report,
    run_of,
    trust,
    verify,
)
from tampering import FIRST, SECOND, assert_refused, flipped_verdict, set_place

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.certifying import certificate
from ucm_cts.harness.certificates.envelopes import opened, signed
from ucm_cts.harness.certificates.keys import Rule


def test_several_lies_are_told_together() -> None:
    forger = forger_of(intact("failing"))
    flipped_verdict(forger)
    forger.requirement(SECOND, exercised=99)
    forger.claims = msgspec.structs.replace(forger.claims, product="Better UCM", issued="never")
    forger.change(archive.ENVIRONMENT, set_place("suite_version", to="7"))
    data = forger_of(forger.resigned()).envelope(lambda e: {**e, "signatures": [{"keyid": "00", "sig": "AAAA"}]})
    checks = {problem.check for problem in verify(data).problems}
    assert {"key", "verdict", "findings", "counts", "claims", "time"} <= checks


def test_a_lost_key_vouches_for_nothing() -> None:
    verified = verify(intact(), acme=Rule(lost="2026-11-02"))
    assert_refused(verified, "lost key", "key 'acme' was lost on 2026-11-02")
    assert verified.signers == ()


def test_a_key_vouches_for_its_own_products_only() -> None:
    assert verify(intact(), acme=Rule(products=("Acme *",))).stands
    other = verify(intact(), acme=Rule(products=("Other [1]",)))
    assert_refused(other, "key of another product", "vouches for Other [1]")


def test_one_bad_signature_beside_a_good_one_is_told() -> None:
    def spoil(envelope: Any) -> Any:
        raw = bytearray(base64.b64decode(envelope["signatures"][1]["sig"]))
        raw[0] ^= 1
        envelope["signatures"][1]["sig"] = base64.b64encode(raw).decode()
        return envelope

    data = forger_of(intact("twice signed")).envelope(spoil)
    assert_refused(verify(data, "acme", "lab"), "signature", "key 'lab'")
    assert verify(data).stands, "a key that the verifier does not know says nothing"


def test_an_expired_waiver_is_told() -> None:
    import datetime

    from ucm_cts.harness.certificates.verifying import Verifier

    later = datetime.datetime(2101, 1, 1, tzinfo=datetime.UTC)
    verified = Verifier(trust("acme"), fake_judge, today=later).verify(intact("waived"))
    assert_refused(verified, "waiver expired", "expired on 2099-12-31; ask for a new certificate")


def test_only_a_record_that_a_trusted_key_has_signed_is_vouched_for() -> None:
    vouched: list[bool] = []

    def judge(contents: Any, *others: Any) -> Any:
        vouched.append(contents.is_vouched_for)
        return fake_judge(contents, *others)

    made = run_of(made_report())
    verify(certificate(made, [key_of("acme")]), judge=judge)
    verify(certificate(made, [key_of("stranger")]), judge=judge)
    other = forger_of(certificate(made, [key_of("acme")]))
    record = archive.packed(msgspec.json.encode(made_report(seed=99)))
    verify(archive.written({**other.members, archive.RECORD: record}), judge=judge)
    assert vouched == [True, False, False]


def test_the_envelope_is_one_that_other_tools_read() -> None:
    from securesystemslib.dsse import Envelope

    content = forger_of(intact()).members[archive.ENVELOPE]
    envelope = Envelope.from_dict(msgspec.json.decode(content))
    assert envelope.verify([key_of("acme").public_key], 1)
    statement = msgspec.json.decode(envelope.payload)
    assert statement["_type"] == "https://in-toto.io/Statement/v1"
    assert statement["predicate"]["result"] == "PASSED"
    assert FIRST in statement["predicate"]["passedTests"]
    assert opened(content, "", "").payload == envelope.payload
    assert signed(envelope.payload, envelope.payload_type, [key_of("acme")]) == content
