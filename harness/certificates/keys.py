"""Keys: Ed25519, in PEM files. Private ones sign, and a trust folder has the public ones that a verifier relies on.

A trust folder is the verifier's own: nothing in a certificate adds to it. ``trust.toml`` in it may say what a key vouches for::

    [acme]                        # of acme.pub
    products = ["Acme *"]         # the key vouches for these; * is any text
    lost = "2026-11-01"           # since then somebody else may sign with it
"""

from __future__ import annotations

import datetime
import fnmatch
import os
import stat
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from cryptography.exceptions import UnsupportedAlgorithm
from cryptography.hazmat.primitives import serialization
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey
from securesystemslib.signer import CryptoSigner, SSlibKey

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, convert, read_toml, without_waiting
from ucm_cts.harness.hosting.locate import WrongUse

PRIVATE, PUBLIC = ".pem", ".pub"
"""How the files of a key end."""

RULES = "trust.toml"
"""The file of a trust folder that says what its keys vouch for."""

LARGEST_KEY = 16 * 1024
MOST_KEYS = 10_000


class Rule(Value, frozen=True):
    """What one key vouches for. ``products``: patterns of names of products, ``*`` for any text. ``lost``: since that day, ISO 8601."""

    products: tuple[str, ...] = ("*",)
    lost: str = ""


@dataclass(frozen=True)
class TrustedKey:
    """A public key that the verifier relies on, under the name of its file."""

    name: str
    key: SSlibKey
    rule: Rule = field(default_factory=Rule)

    def vouches_for(self, product: str) -> bool:
        """Whether the verifier takes this key's word on ``product``."""
        return any(
            fnmatch.fnmatchcase(product, pattern.replace("[", "[[]").replace("?", "[?]"))
            for pattern in self.rule.products
        )


@dataclass(frozen=True)
class Trust:
    """The keys that a verifier relies on, by their ids. ``source``: where they are from."""

    keys: Mapping[str, TrustedKey]
    source: str = ""

    def __bool__(self) -> bool:
        return bool(self.keys)


NOBODY = Trust({})
"""No key at all."""


def make_key(name: str, folder: Path) -> tuple[Path, Path]:
    """A new key: its private file, which only its owner can read, and its public file. Raises ``WrongUse``."""
    if not name or name != os.path.basename(name) or name.startswith(".") or "\0" in name:
        raise WrongUse(
            f"'{name}' is no name of a key; write one without folders, such as acme, and --out for the folder"
        )
    private, public = folder / (name + PRIVATE), folder / (name + PUBLIC)
    for path in (private, public):
        if os.path.lexists(path):
            raise WrongUse(f"'{path}' is there already; a key is never written over: choose another name")
    signer = CryptoSigner.generate_ed25519()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for path, content, mode in ((private, signer.private_bytes, 0o600), (public, _public_bytes(signer), 0o644)):
            handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, mode)
            with os.fdopen(handle, "wb") as file:
                file.write(content)
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise WrongUse(f"the key cannot be written to '{folder}': {why}; choose another --out") from None
    return private, public


def _public_bytes(signer: CryptoSigner) -> bytes:
    key = Ed25519PublicKey.from_public_bytes(bytes.fromhex(str(signer.public_key.keyval["public"])))
    return key.public_bytes(serialization.Encoding.PEM, serialization.PublicFormat.SubjectPublicKeyInfo)


def signer_of(path: Path) -> CryptoSigner:
    """The private key in the file at ``path``. Raises ``WrongUse``."""
    hint = f"ucm-cts key NAME makes one; a lost key cannot be had again: make a new one, and tell who trusts '{path.stem}{PUBLIC}'"
    content, mode = _content(path, hint)
    if mode & 0o077 and b"PRIVATE KEY" in content:
        raise WrongUse(f"'{path}' can be read by others, so that they can sign in your name: chmod 600 '{path}'")
    try:
        key = serialization.load_pem_private_key(content, None)
    except TypeError:
        raise WrongUse(f"'{path}' is protected by a password; give a key without one") from None
    except (ValueError, UnsupportedAlgorithm):
        what = "is a public key; the private one signs" if b"PUBLIC KEY" in content else "is no private key in PEM"
        raise WrongUse(f"'{path}' {what}; {hint}") from None
    if not isinstance(key, Ed25519PrivateKey):
        raise WrongUse(f"'{path}' is no Ed25519 key; {hint}")
    return CryptoSigner(key)


def trust_in(path: Path) -> Trust:
    """The public keys in the folder, or the file, at ``path``. Raises ``WrongUse`` and ``DocumentError``."""
    try:
        is_folder = path.is_dir()
        files = sorted(p for p in path.iterdir() if p.suffix in (PRIVATE, PUBLIC)) if is_folder else [path]
    except (OSError, ValueError) as error:
        raise WrongUse(f"the keys in '{path}' cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if not files:
        raise WrongUse(f"'{path}' has no public keys; put those you rely on there, as NAME{PUBLIC}")
    if len(files) > MOST_KEYS:
        raise WrongUse(f"'{path}' has more than {MOST_KEYS} keys; split it")
    rules = _rules(path) if is_folder else {}
    keys: dict[str, TrustedKey] = {}
    for file in files:
        key = _public_key(file)
        known = keys.get(key.keyid)
        if known is not None:
            raise WrongUse(f"'{file}' is the same key as '{known.name}{PUBLIC}'; keep one of them")
        keys[key.keyid] = TrustedKey(file.stem, key, rules.get(file.stem, Rule()))
    for name in rules:
        if name not in (trusted.name for trusted in keys.values()):
            raise DocumentError(
                path / RULES, None, f"'{name}' is no key of this folder; there is no file {name}{PUBLIC}"
            )
    return Trust(keys, str(path))


def _public_key(path: Path) -> SSlibKey:
    content, _ = _content(path, "give a file or a folder of public keys")
    if b"PRIVATE KEY" in content:
        raise WrongUse(
            f"'{path}' is a private key; trust takes public ones only (NAME{PUBLIC}), and a private one has no place here"
        )
    try:
        key = serialization.load_pem_public_key(content)
    except (ValueError, UnsupportedAlgorithm):
        raise WrongUse(f"'{path}' is no public key in PEM; ucm-cts key NAME makes a pair") from None
    if not isinstance(key, Ed25519PublicKey):
        raise WrongUse(f"'{path}' is no Ed25519 key; ucm-cts key NAME makes a pair")
    return SSlibKey.from_crypto(key)


def _rules(folder: Path) -> dict[str, Rule]:
    path = folder / RULES
    if not os.path.lexists(path):
        return {}
    document, lines = read_toml(path, LARGEST_KEY * 64)
    rules = convert(path, document, dict[str, Rule], {f"$.{place}": line for place, line in lines.items()})
    for name, rule in rules.items():
        if rule.lost and not _is_day(rule.lost):
            raise DocumentError(path, lines.get(f"{name}.lost"), f"'{rule.lost}' is no date; write it as 2027-01-31")
    return rules


def _is_day(text: str) -> bool:
    try:
        datetime.date.fromisoformat(text)
    except ValueError:
        return False
    return True


def _content(path: Path, hint: str) -> tuple[bytes, int]:
    """What the plain file at ``path`` holds, and its mode."""
    try:
        with open(path, "rb", opener=without_waiting) as stream:
            found = os.fstat(stream.fileno())
            if not stat.S_ISREG(found.st_mode):
                raise WrongUse(f"'{path}' is no plain file; {hint}")
            content = stream.read(LARGEST_KEY + 1)
    except (OSError, ValueError) as error:
        raise WrongUse(f"'{path}' cannot be read: {getattr(error, 'strerror', None) or error}; {hint}") from None
    if len(content) > LARGEST_KEY:
        raise WrongUse(f"'{path}' is too large for a key; {hint}")
    return content, found.st_mode
