"""Commit, then seed: the vendor commits to a product, an auditor answers with a nonce, and the seed follows from both.

The commitment names digests, statement and profile before the vendor knows what will be run. The auditor's ledger, a file beside
the auditor's key, counts the challenges for each product: a vendor who asks often may be looking for a seed that pleases.
"""

from __future__ import annotations

import datetime
import fcntl
import hashlib
import os
import secrets
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import msgspec
from securesystemslib.signer import CryptoSigner

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import without_waiting
from ucm_cts.harness.certificates.contents import Descriptor, digest
from ucm_cts.harness.certificates.envelopes import Opened, decoded, encoded, opened, signed
from ucm_cts.harness.certificates.keys import NOBODY, Trust
from ucm_cts.harness.certificates.problems import Unreadable, unreadable
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.foreign import one_line

COMMITMENT_TYPE = "application/vnd.ucm-cts.commitment+json"
CHALLENGE_TYPE = "application/vnd.ucm-cts.challenge+json"

LEDGER = ".ledger"
"""How the file of an auditor's ledger ends, beside the key."""

LARGEST = 1 << 20
NONCE = 32
"""Bytes of a nonce."""


class Commitment(Value, frozen=True):
    """What a vendor commits to: product and profile, the digests of the product's files, of the statement and of the waivers,
    and the build of the suite. ``made``: when, ISO 8601 in UTC.
    """

    product: str
    version: str
    profile: str
    subjects: tuple[Descriptor, ...]
    statement: str
    waivers: str
    suite: str
    systematic: int
    made: str


class Challenge(Value, frozen=True):
    """An auditor's answer. ``commitment``: the digest of the commitment's envelope. ``number``: the auditor has given so many
    challenges for this product, version and profile, this one included. ``nonce``: hexadecimal, drawn by the auditor.
    """

    commitment: str
    nonce: str
    number: int
    issued: str


class Challenged(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The file of a challenge, and the member of a certificate: both envelopes as they are."""

    commitment: str
    challenge: str


@dataclass(frozen=True)
class Answered:
    """A challenge that was read; the signatures are still to be checked."""

    commitment: Commitment
    challenge: Challenge
    by_vendor: Opened
    by_auditor: Opened

    @property
    def seed(self) -> int:
        """The seed of the run, which follows from commitment and nonce."""
        drawn = hashlib.sha256(bytes.fromhex(self.challenge.commitment) + bytes.fromhex(self.challenge.nonce)).digest()
        return int.from_bytes(drawn[:4], "big")


def now() -> str:
    """The present time, ISO 8601 in UTC."""
    return datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")


def committed(commitment: Commitment, signers: Sequence[CryptoSigner]) -> bytes:
    """The signed commitment, for the auditor."""
    return signed(encoded(commitment), COMMITMENT_TYPE, signers)


def challenged(
    commitment: bytes, signer: CryptoSigner, key: Path, trust: Trust = NOBODY
) -> tuple[bytes, Challenge, tuple[str, ...]]:
    """The auditor's answer to ``commitment``, with its entry in the ledger beside ``key``, and the names of who signed the commitment.

    Unless ``trust`` is empty, one of its keys must have signed it. Raises ``Unreadable`` and ``WrongUse``.
    """
    what, envelope = _commitment(commitment)
    vendors = _vendors(what, envelope, trust) if trust else ()
    with _ledger(key) as (entries, add):
        same = [e for e in entries if (e.product, e.version, e.profile) == (what.product, what.version, what.profile)]
        challenge = Challenge(digest(commitment), secrets.token_hex(NONCE), len(same) + 1, now())
        answer = signed(encoded(challenge), CHALLENGE_TYPE, [signer])
        add(_Entry(what.product, what.version, what.profile, challenge))
    return encoded(Challenged(commitment.decode(), answer.decode())), challenge, vendors


def _vendors(what: Commitment, envelope: Opened, trust: Trust) -> tuple[str, ...]:
    """Whose keys of ``trust`` signed the commitment. Raises ``Unreadable`` if nobody's did that may speak for the product."""
    signed, problems = envelope.who(trust, "the commitment")
    if problems:
        raise Unreadable(*problems)
    if not signed:
        raise unreadable(
            "commitment",
            f"none of the keys that you trust in '{trust.source}' signed the commitment; ask the vendor, by another way, which key is theirs",
        )
    for key in signed:
        if key.rule.lost:
            raise unreadable(
                "commitment", f"key '{key.name}', which signed the commitment, was lost on {key.rule.lost}"
            )
        if not key.vouches_for(what.product):
            raise unreadable(
                "commitment",
                f"key '{key.name}', which signed the commitment, does not vouch for '{one_line(what.product, 80)}'",
            )
    return tuple(key.name for key in signed)


def answered(content: bytes) -> Answered:
    """The challenge in ``content``. Raises ``Unreadable``."""
    both = decoded(content, Challenged, "challenge", "the challenge")
    commitment, by_vendor = _commitment(both.commitment.encode())
    by_auditor = opened(both.challenge.encode(), "challenge", "the auditor's answer")
    if by_auditor.kind != CHALLENGE_TYPE:
        raise unreadable("challenge", "the auditor's answer is signed as something else than a challenge")
    challenge = decoded(by_auditor.payload, Challenge, "challenge", "the auditor's answer")
    if challenge.commitment != digest(both.commitment.encode()):
        raise unreadable("challenge", "the auditor's answer is to another commitment")
    if len(challenge.nonce) != 2 * NONCE or not set(challenge.nonce) <= set("0123456789abcdef"):
        raise unreadable("challenge", "the auditor's nonce is none")
    if challenge.number < 1:
        raise unreadable("challenge", "the auditor's challenges are counted from 1")
    return Answered(commitment, challenge, by_vendor, by_auditor)


def _commitment(content: bytes) -> tuple[Commitment, Opened]:
    envelope = opened(content, "challenge", "the commitment")
    if envelope.kind != COMMITMENT_TYPE:
        raise unreadable("challenge", "the commitment is signed as something else; 'ucm-cts commit' writes one")
    return decoded(envelope.payload, Commitment, "challenge", "the commitment"), envelope


def read_small(path: Path, what: str) -> bytes:
    """The content of the file at ``path``, which is to be ``what``. Raises ``WrongUse``."""
    try:
        with open(path, "rb", opener=without_waiting) as stream:
            if not path.is_file():
                raise WrongUse(f"'{path}' is no plain file; it is to be {what}")
            content = stream.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        raise WrongUse(
            f"'{path}' cannot be read: {getattr(error, 'strerror', None) or error}; it is to be {what}"
        ) from None
    if len(content) > LARGEST:
        raise WrongUse(f"'{path}' is too large for {what}")
    return content


class _Entry(Value, frozen=True):
    """One line of a ledger."""

    product: str
    version: str
    profile: str
    challenge: Challenge


@contextmanager
def _ledger(key: Path) -> Iterator[tuple[list[_Entry], Callable[[_Entry], None]]]:
    """The entries of the ledger beside ``key``, which nobody else changes meanwhile, and what adds one."""
    path = key.with_suffix(LEDGER)
    try:
        with open(
            os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600), "r+b"
        ) as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            lines = file.read().splitlines()
            try:
                entries = [msgspec.json.decode(line, type=_Entry) for line in lines]
            except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
                raise WrongUse(
                    f"'{path}' is no ledger, or was damaged; restore it, or begin a new one elsewhere"
                ) from None

            def add(entry: _Entry) -> None:
                file.write(msgspec.json.encode(entry) + b"\n")
                file.flush()
                os.fsync(file.fileno())

            yield entries, add
    except OSError as error:
        raise WrongUse(
            f"the ledger '{path}' cannot be written: {error.strerror}; without it no challenge is given"
        ) from None
