"""A certificate that was changed by somebody who cannot sign it is refused. Each way has its own line."""

from __future__ import annotations

import base64
from collections.abc import Callable
from typing import Any

import pytest
from forging import (
    challenge_to,
    commitment_to,
    forger_of,
    intact,
    key_of,
    made_report,
    verify,
)
from tampering import FIRST, assert_refused, deep, set_place

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.envelopes import encoded


def _stranger(name: str, change: Callable[[Any], Any]) -> bytes:
    """A member is changed, and the signature is left as it was."""
    forger = forger_of(intact())
    forger.change(name, change)
    return forger.unsigned()


def _reencoded(name: str, content: Callable[[bytes], bytes]) -> bytes:
    forger = forger_of(intact())
    forger.members[name] = content(forger.members[name])
    return forger.resigned() if name not in (archive.ENVELOPE,) else forger.unsigned()


def _signature(change: Callable[[dict[str, Any]], None]) -> bytes:
    def of_envelope(envelope: Any) -> Any:
        change(envelope)
        return envelope

    return forger_of(intact()).envelope(of_envelope)


def _flip(envelope: dict[str, Any]) -> None:
    raw = bytearray(base64.b64decode(envelope["signatures"][0]["sig"]))
    raw[3] ^= 1
    envelope["signatures"][0]["sig"] = base64.b64encode(raw).decode()


def _of_another_key(envelope: dict[str, Any]) -> None:
    envelope["signatures"][0]["keyid"] = key_of("stranger").public_key.keyid


def _other_payload(envelope: dict[str, Any]) -> None:
    payload = base64.b64decode(envelope["payload"]).replace(b"Acme UCM", b"Evil UCM")
    envelope["payload"] = base64.b64encode(payload).decode()


def _signed_by(name: str) -> bytes:
    forger = forger_of(intact())
    forger.signer = name
    return forger.resigned()


STRANGERS: dict[str, tuple[Callable[[], bytes], str, str]] = {
    "report: verdict flipped": (
        lambda: _stranger(archive.REPORT, set_place("verdict", to="not conformant")),
        "digest",
        "'report.json' is not the one",
    ),
    "report: product renamed": (
        lambda: _stranger(archive.REPORT, set_place("product", to="Other")),
        "digest",
        "'report.json' is not the one",
    ),
    "statement: reading changed": (
        lambda: _stranger(archive.STATEMENT, set_place("product", to="Other")),
        "digest",
        "'statement.json' is not the one",
    ),
    "waivers: one added": (
        lambda: _stranger(
            archive.WAIVERS, lambda _: [{"requirement": FIRST, "observed": "*", "reason": "x", "expires": "2099-01-01"}]
        ),
        "digest",
        "'waivers.json' is not the one",
    ),
    "models: changed": (lambda: _models_changed(), "digest", "'models.json' is not the one"),
    "waivers: stretched": (lambda: _stretched(), "digest", "'waivers.json' is not the one"),
    "environment: isolation embellished": (
        lambda: _stranger(archive.ENVIRONMENT, set_place("isolation", to="bubblewrap")),
        "digest",
        "'environment.json' is not the one",
    ),
    "record: of another run": (lambda: _swapped_record(), "digest", "'record.zst' is not the one"),
    "report: of another certificate": (lambda: _swapped(archive.REPORT), "digest", "'report.json' is not the one"),
    "models: put in": (
        lambda: _put_in(archive.MODELS, encoded({"a.xml": "<a/>"})),
        "digest",
        "'models.json' is in the archive, and was not signed",
    ),
    "challenge: put in": (
        lambda: _put_in(archive.CHALLENGE, challenge_to(commitment_to(made_report()))),
        "digest",
        "'challenge.json' is in the archive, and was not signed",
    ),
    "challenge: taken out": (
        lambda: _taken_out(archive.CHALLENGE, "challenged"),
        "digest",
        "'challenge.json' was signed, and is not in the archive",
    ),
    "payload changed": (lambda: _signature(_other_payload), "signature", "changed after it was signed"),
    "signature changed": (lambda: _signature(_flip), "signature", "changed after it was signed"),
    "signature said to be of another key": (
        lambda: _signature(_of_another_key),
        "key",
        "none of the keys that you trust",
    ),
    "signature taken out": (lambda: _signature(lambda e: e["signatures"].clear()), "signature", "not signed at all"),
    "signature twice": (
        lambda: _signature(lambda e: e["signatures"].append(e["signatures"][0])),
        "envelope",
        "two signatures of one key",
    ),
    "signatures by the hundred": (
        lambda: _signature(lambda e: e["signatures"].extend({"keyid": str(n), "sig": "AAAA"} for n in range(100))),
        "envelope",
        "has 101 signatures",
    ),
    "signature is no base64": (
        lambda: _signature(lambda e: e["signatures"][0].update(sig="%%%")),
        "envelope",
        "no base64",
    ),
    "signature in other base64": (
        lambda: _signature(lambda e: e.update(payload=e["payload"].rstrip("=") + "\n")),
        "envelope",
        "no base64",
    ),
    "payload type changed": (
        lambda: _signature(lambda e: e.update(payloadType="text/plain")),
        "envelope",
        "is of 'text/plain'",
    ),
    "field added to the envelope": (lambda: _signature(lambda e: e.update(note="x")), "envelope", "unknown field"),
    "envelope written anew": (
        lambda: _reencoded(archive.ENVELOPE, lambda c: c + b" "),
        "envelope",
        "written otherwise",
    ),
    "envelope nests deep": (lambda: _reencoded(archive.ENVELOPE, lambda _: deep()), "envelope", "cannot be read"),
    "envelope is no UTF-8": (
        lambda: _reencoded(archive.ENVELOPE, lambda _: b'"\xff\xfe"'),
        "envelope",
        "cannot be read",
    ),
    "signed by a stranger": (
        lambda: _signed_by("stranger"),
        "key",
        "none of the keys that you trust in 'keys' signed it",
    ),
}


def _stretched() -> bytes:
    forger = forger_of(intact("waived"))
    forger.change(archive.WAIVERS, lambda waivers: [{**waivers[0], "expires": "2199-12-31"}])
    return forger.unsigned()


def _models_changed() -> bytes:
    forger = forger_of(intact("with models"))
    forger.members[archive.MODELS] = encoded({"core.xml": "<b/>"})
    return forger.unsigned()


def _swapped(name: str) -> bytes:
    forger = forger_of(intact())
    forger.members[name] = forger_of(intact("failing")).members[name]
    return forger.unsigned()


def _swapped_record() -> bytes:
    return _swapped(archive.RECORD)


def _put_in(name: str, content: bytes) -> bytes:
    forger = forger_of(intact())
    forger.members[name] = content
    return forger.unsigned()


def _taken_out(name: str, kind: str) -> bytes:
    forger = forger_of(intact(kind))
    del forger.members[name]
    return forger.unsigned()


@pytest.mark.parametrize("way", STRANGERS)
def test_what_a_stranger_changes_is_refused(way: str) -> None:
    make, check, detail = STRANGERS[way]
    assert_refused(verify(make()), check, detail)
