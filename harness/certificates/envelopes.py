"""DSSE envelopes: a payload, its type, and the signatures of both. securesystemslib signs and checks them."""

from __future__ import annotations

import base64
import binascii
from collections.abc import Sequence
from typing import TypeVar

import msgspec
from securesystemslib.dsse import Envelope
from securesystemslib.exceptions import UnverifiedSignatureError, VerificationError
from securesystemslib.signer import CryptoSigner, Signature

from ucm_cts.harness.certificates.keys import Trust, TrustedKey
from ucm_cts.harness.certificates.problems import Problem, unreadable
from ucm_cts.harness.results.foreign import one_line

T = TypeVar("T")

MOST_SIGNATURES = 16
"""Signatures that an envelope may have."""


class _Signature(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    keyid: str
    sig: str


class _Envelope(msgspec.Struct, frozen=True, forbid_unknown_fields=True, rename="camel"):
    payload: str
    payload_type: str
    signatures: tuple[_Signature, ...]


def encoded(value: object, indent: int = 1) -> bytes:
    """``value`` as the JSON that certificates hold: one value has one form only."""
    return msgspec.json.format(msgspec.json.encode(value), indent=indent) + b"\n"


def decoded(content: bytes, type_: type[T], check: str, what: str, indent: int = 1) -> T:
    """The ``type_`` in ``content``. Raises ``Unreadable`` unless ``content`` is exactly what ``encoded`` makes of it."""
    try:
        value = msgspec.json.decode(content, type=type_)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        why = "it nests too deep" if isinstance(error, RecursionError) else one_line(str(error))
        raise unreadable(check, f"{what} cannot be read: {why}") from None
    try:
        again = encoded(value, indent)
    except (msgspec.MsgspecError, UnicodeEncodeError, RecursionError):
        again = b""
    if again != content:
        raise unreadable(check, f"{what} is written otherwise than ucm-cts writes it; another program wrote it anew")
    return value


def signed(payload: bytes, kind: str, signers: Sequence[CryptoSigner]) -> bytes:
    """The envelope of ``payload``, which is of the type ``kind``, with a signature of each of ``signers``."""
    envelope = Envelope(payload, kind, {})
    for signer in signers:
        envelope.sign(signer)
    signatures = tuple(_Signature(s.keyid, _base64(bytes.fromhex(s.signature))) for s in envelope.signatures.values())
    return encoded(_Envelope(_base64(payload), kind, signatures))


class Opened(msgspec.Struct, frozen=True):
    """An envelope that was read. ``signatures`` are not checked yet; ``who`` checks them."""

    payload: bytes
    kind: str
    signatures: dict[str, str]
    """The signature of each key, hexadecimal, by the key's id."""

    def who(self, trust: Trust, what: str) -> tuple[tuple[TrustedKey, ...], tuple[Problem, ...]]:
        """Which keys of ``trust`` signed, and what is wrong with the signatures of ``what``."""
        envelope = Envelope(
            self.payload, self.kind, {id_: Signature(id_, signature) for id_, signature in self.signatures.items()}
        )
        good: list[TrustedKey] = []
        problems: list[Problem] = []
        for id_ in self.signatures:
            trusted = trust.keys.get(id_)
            if trusted is None:
                continue
            try:
                trusted.key.verify_signature(envelope.signatures[id_], envelope.pae())
                good.append(trusted)
            except (UnverifiedSignatureError, VerificationError):
                problems.append(
                    Problem(
                        "signature",
                        f"the signature of key '{trusted.name}' does not fit {what}: it was changed after it was signed",
                    )
                )
        return tuple(good), tuple(problems)


def opened(content: bytes, check: str, what: str) -> Opened:
    """The envelope in ``content``. Raises ``Unreadable``."""
    envelope = decoded(content, _Envelope, check, what)
    if len(envelope.signatures) > MOST_SIGNATURES:
        raise unreadable(check, f"{what} has {len(envelope.signatures)} signatures; it has at most {MOST_SIGNATURES}")
    ids = [signature.keyid for signature in envelope.signatures]
    if len(set(ids)) != len(ids):
        raise unreadable(check, f"{what} has two signatures of one key")
    return Opened(
        _bytes(envelope.payload, check, what),
        envelope.payload_type,
        {s.keyid: _bytes(s.sig, check, what).hex() for s in envelope.signatures},
    )


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode()


def _bytes(text: str, check: str, what: str) -> bytes:
    try:
        content = base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise unreadable(check, f"{what} has a field that is no base64") from None
    if _base64(content) != text:
        raise unreadable(check, f"{what} has a field of base64 that is written otherwise than ucm-cts writes it")
    return content
