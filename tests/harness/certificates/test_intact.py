"""Certificates that nobody touched stand, and say what they are."""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest
from forging import INTACT, FakeJudged, fake_judge, forger_of, intact, key_of, trust, verify

AUDITORS = trust("tuev")


@pytest.mark.parametrize("kind", INTACT)
def test_no_intact_certificate_is_refused(kind: str) -> None:
    verified = verify(intact(kind), auditors=AUDITORS)
    assert verified.problems == ()
    assert verified.product == "Acme UCM"
    assert verified.report is not None
    assert verified.uncovered.untestable


@pytest.mark.parametrize("kind", INTACT)
def test_what_no_trace_shows_is_named_as_the_signers_word(kind: str) -> None:
    def judge(*given: object) -> object:
        return dataclasses.replace(fake_judge(*given), unshown=("that a second look gave no trace",))  # type: ignore[arg-type]

    verified = verify(intact(kind), auditors=AUDITORS, judge=judge)
    words = " / ".join(verified.word)
    assert "that a second look gave no trace" in words
    is_vendors = kind != "witnessed"
    for word in ("product and version", "the dates", "no more than 40 scenarios were drawn"):
        assert (word in words) == is_vendors
    assert ("seed was not chosen" in words) == (verified.assurance == "self-declared")
    assert ("how often it ran" in words) == (verified.assurance == "challenged")


def test_a_signature_that_a_stranger_adds_is_remarked() -> None:
    def add(envelope: Any) -> Any:
        envelope["signatures"].append({"keyid": key_of("stranger").public_key.keyid, "sig": "AAAA"})
        return envelope

    verified = verify(forger_of(intact()).envelope(add))
    assert verified.stands
    assert verified.signers == ("acme",)
    (remark,) = verified.remarks
    assert remark.startswith("1 of its signatures are of keys that you do not trust")
    assert verify(intact("twice signed"), "acme", "lab").remarks == ()


@pytest.mark.parametrize(
    ("product", "told"),
    [
        ("\u0410cme UCM", ("U+0410 CYRILLIC CAPITAL LETTER A",)),
        ("M\u00fcller", ()),
        ("\u03a9\u03bc\u03ad\u03b3\u03b1 1", ()),
    ],
)
def test_letters_that_look_alike_are_remarked(product: str, told: tuple[str, ...]) -> None:
    forger = forger_of(intact())
    forger.report(product=product)
    remarks = verify(forger.resigned(), judge=lambda *_: FakeJudged(forger.said)).remarks
    assert len(remarks) == len(told)
    assert all(word in remark for word, remark in zip(told, remarks, strict=True))
