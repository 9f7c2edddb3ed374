"""What users type about certificates, and what they get when it is wrong: one line, and exit status 2."""

from __future__ import annotations

import base64
import os
import stat
from pathlib import Path

import msgspec
import pytest
from command_line import ucm_cts
from forging import ADAPTER, LIBRARY, commitment_to, forger_of, intact, key_of, made_report

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.challenges import committed
from ucm_cts.harness.certificates.contents import descriptors
from ucm_cts.harness.certificates.envelopes import encoded
from ucm_cts.harness.certificates.keys import signer_of, trust_in
from ucm_cts.harness.cli.certificate_run import unlike
from ucm_cts.harness.cli.toolchain_command import ToolChainRun, prepare
from ucm_cts.harness.hosting.sandbox import why_none


def _wrong(text: str, *arguments: str | Path) -> None:
    outcome = ucm_cts(*arguments)
    assert outcome.status == 2, outcome
    assert text in outcome.err, outcome.err
    assert outcome.err.count("\n") == 1


@pytest.fixture
def keys(tmp_path: Path) -> Path:
    folder = tmp_path / "keys"
    assert ucm_cts("key", "acme", "--out", folder).status == 0
    (folder / "acme.pem").rename(tmp_path / "acme.pem")
    return folder


def test_a_private_key_is_its_owners_alone(tmp_path: Path) -> None:
    outcome = ucm_cts("key", "acme", "--out", tmp_path)
    assert outcome.status == 0
    assert stat.S_IMODE((tmp_path / "acme.pem").stat().st_mode) == 0o600
    assert "PRIVATE" not in (tmp_path / "acme.pub").read_text()
    _wrong("is there already", "key", "acme", "--out", tmp_path)
    _wrong("is no name of a key", "key", "../acme", "--out", tmp_path)


def test_wrong_keys_are_said(tmp_path: Path, keys: Path) -> None:
    def certify(key: Path) -> tuple[str | Path, ...]:
        return "certify", "reference-py", "--key", key, "--out", tmp_path / "x.ucmcert"

    private = tmp_path / "acme.pem"
    _wrong("a lost key cannot be had again", *certify(tmp_path / "lost.pem"))
    _wrong("is a public key", *certify(keys / "acme.pub"))
    private.chmod(0o644)
    _wrong("can be read by others", *certify(private))
    text = tmp_path / "text.pem"
    text.write_text("hello")
    text.chmod(0o600)
    _wrong("is no private key in PEM", *certify(text))
    pipe = tmp_path / "pipe.pem"
    os.mkfifo(pipe)
    _wrong("is no plain file", *certify(pipe))


def test_nothing_is_written_over(tmp_path: Path, keys: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    for command in ("certify", "commit"):
        _wrong(
            "never written over",
            command,
            "reference-py",
            "--key",
            tmp_path / "acme.pem",
            "--out",
            tmp_path / "mine.txt",
        )
    assert (tmp_path / "mine.txt").read_text() == "mine"


def test_wrong_arguments_are_said_before_anything_runs(tmp_path: Path, keys: Path) -> None:
    certify = ("certify", "reference-py", "--key", tmp_path / "acme.pem", "--out", tmp_path / "x.ucmcert")
    _wrong("cannot be read", *certify, "--artifact", tmp_path / "missing.so")
    os.mkfifo(tmp_path / "pipe")
    _wrong("is no plain file", *certify, "--artifact", tmp_path / "pipe")
    _wrong("cannot be read", *certify, "--challenge", tmp_path / "missing.json")
    (tmp_path / "no.json").write_text("{}")
    _wrong("the challenge cannot be read", *certify, "--challenge", tmp_path / "no.json")
    _wrong("leave out --seed", *certify, "--challenge", tmp_path / "no.json", "--seed", "1")
    _wrong(
        "the commitment cannot be read",
        "challenge",
        tmp_path / "no.json",
        "--key",
        tmp_path / "acme.pem",
        "--out",
        tmp_path / "c.json",
    )


def test_verify_wants_keys_of_its_user(tmp_path: Path, keys: Path) -> None:
    file = tmp_path / "x.ucmcert"
    file.write_bytes(intact())
    _wrong("whose keys do you trust?", "verify", file)
    _wrong("cannot be read", "verify", file, "--trust", tmp_path / "missing")
    _wrong("has no public keys", "verify", file, "--trust", _folder(tmp_path / "empty"))
    _wrong("is a private key", "verify", file, "--trust", tmp_path / "acme.pem")
    _wrong("cannot be read", "verify", tmp_path / "missing.ucmcert", "--trust", keys)
    _wrong("Is a directory", "verify", tmp_path, "--trust", keys)
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    _wrong("is no plain file", "verify", pipe, "--trust", keys)


def _folder(path: Path) -> Path:
    path.mkdir()
    return path


def test_rules_of_a_trust_folder_are_checked(tmp_path: Path, keys: Path) -> None:
    rules = keys / "trust.toml"
    file = tmp_path / "x.ucmcert"
    file.write_bytes(intact())
    for text, problem in (
        ("[acme\n", "trust.toml:1: not TOML"),
        ("[acme]\nlost = 'soon'\n", "trust.toml:2: 'soon' is no date"),
        ("[acme]\nproduct = 'x'\n", "product"),
        ("[other]\nlost = '2026-01-01'\n", "'other' is no key of this folder"),
    ):
        rules.write_text(text)
        _wrong(problem, "verify", file, "--trust", keys)
    rules.write_text("[acme]\nproducts = ['Acme *']\nlost = '2026-01-01'\n")
    (key,) = trust_in(keys).keys.values()
    assert (key.name, key.vouches_for("Acme UCM"), key.rule.lost) == ("acme", True, "2026-01-01")


def test_a_certificate_of_a_stranger_does_not_stand(tmp_path: Path, keys: Path) -> None:
    file = tmp_path / "x.ucmcert"
    file.write_bytes(intact())
    outcome = ucm_cts("verify", file, "--trust", keys)
    assert outcome.status == 1
    assert outcome.out.startswith("DOES NOT STAND")
    assert "key: none of the keys that you trust" in outcome.out


def test_hostile_texts_do_not_reach_the_terminal(tmp_path: Path, keys: Path) -> None:
    forger = forger_of(intact())
    forger.report(product="Evil\x1b[2J\u202e\nSTANDS")
    file = tmp_path / "x.ucmcert"
    file.write_bytes(forger.resigned())
    outcome = ucm_cts("verify", file, "--trust", keys)
    assert outcome.status == 1
    assert "\x1b" not in outcome.out
    assert "\u202e" not in outcome.out
    assert not any(line.startswith("STANDS") for line in outcome.out.splitlines())


def test_a_damaged_ledger_gives_no_challenge(tmp_path: Path, keys: Path) -> None:
    commitment = tmp_path / "commitment.json"
    commitment.write_bytes(committed(commitment_to(made_report()), [key_of("acme")]))
    (tmp_path / "acme.ledger").write_text("torn\n")
    _wrong("is no ledger", "challenge", commitment, "--key", tmp_path / "acme.pem", "--out", tmp_path / "c.json")
    assert not (tmp_path / "c.json").exists()


def test_an_auditor_answers_only_whom_the_auditor_trusts(tmp_path: Path, keys: Path) -> None:
    vendor, out = signer_of(tmp_path / "acme.pem"), tmp_path / "c.json"
    challenge = ("challenge", tmp_path / "commitment.json", "--key", tmp_path / "acme.pem", "--out", out)
    made = committed(commitment_to(made_report()), [vendor])
    changed = msgspec.json.decode(made)
    changed["payload"] = base64.b64encode(base64.b64decode(changed["payload"]).replace(b"1.2", b"1.3")).decode()
    for content, rules, problem in (
        (committed(commitment_to(made_report()), [key_of("stranger")]), "", "none of the keys that you trust"),
        (encoded(changed), "", "changed after it was signed"),
        (made, "lost = '2026-01-01'", "was lost on 2026-01-01"),
        (made, "products = ['Other']", "does not vouch for 'Acme UCM'"),
    ):
        (keys / "trust.toml").write_text(f"[acme]\n{rules}\n")
        (tmp_path / "commitment.json").write_bytes(content)
        _wrong(problem, *challenge, "--trust", keys)
        assert not (tmp_path / "acme.ledger").exists(), "no challenge was given, and none is counted"
    (keys / "trust.toml").unlink()
    told = ucm_cts(*challenge, "--trust", keys).out
    assert "the commitment is signed by acme" in told
    out.unlink()
    assert "nobody checked who signed the commitment: --trust KEYS" in ucm_cts(*challenge).out


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"product": "Other UCM"}, "committed to product 'Other UCM', and this is 'Acme UCM'; name the adapter"),
        ({"statement": "0" * 64}, "another statement; give the same file with --ics"),
        ({"waivers": "0" * 64}, "other known failures; give the same file with --known-failures"),
        ({"suite": "0" * 64}, "another build of ucm-cts; run that one"),
        ({"systematic": 2}, "--systematic 2; give the same"),
        ({"subjects": descriptors({ADAPTER.name: "0" * 64, LIBRARY.name: LIBRARY.sha256})}, "'adapter/acme.py' is not the file"),
        ({"subjects": descriptors({"artifact/x": "0" * 64})}, "'artifact/x', which takes no part in this run; name it with --artifact"),
    ],
)  # fmt: skip
def test_what_differs_from_a_commitment_is_named_with_its_remedy(change: dict[str, object], told: str) -> None:
    ours = commitment_to(made_report())
    assert told in next(unlike(msgspec.structs.replace(ours, **change), ours))
    assert not list(unlike(ours, ours))


def test_members_can_be_read_by_any_program(tmp_path: Path) -> None:
    import zipfile

    path = tmp_path / "x.zip"
    path.write_bytes(intact())
    with zipfile.ZipFile(path) as opened:
        assert opened.testzip() is None
        assert archive.REPORT in opened.namelist()


@pytest.mark.skipif(bool(why_none()), reason=f"no sandbox here: {why_none()}")
def test_commit_and_certify_can_do_without_a_sandbox(
    tmp_path: Path, keys: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An adapter cannot see the process of the harness in a sandbox; without one, this one refuses to be loaded."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "outside.py").write_text(
        "import os\nfrom ucm_cts.adapters.reference.python.adapter import ReferenceAdapter as Mine\n"
        f"assert not os.path.exists('/proc/{os.getpid()}'), 'no sandbox'\n"
    )
    for command in ("commit", "certify"):
        words = (command, "outside:Mine", "--key", tmp_path / "acme.pem", "--out", tmp_path / command)
        _wrong("no sandbox", *words, "--no-sandbox")
    assert ucm_cts("commit", "outside:Mine", "--key", tmp_path / "acme.pem").status == 0


@pytest.mark.skipif(bool(why_none()), reason=f"no sandbox here: {why_none()}")
def test_what_is_to_be_certified_sees_no_key(tmp_path: Path, keys: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "curious.py").write_text(
        "from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter as Mine\n"
        "try:\n    Mine.version = open('acme.pem').read()[:20]\nexcept OSError:\n    Mine.version = 'nothing'\n"
    )
    outcome = ucm_cts("commit", "curious:Mine", "--key", tmp_path / "acme.pem", "--out", tmp_path / "out.json")
    assert "nothing" in outcome.out
    (tmp_path / "curious.sh").write_text("#!/bin/sh\n[ -s acme.pem ] && exit 0\nexit 3\n")
    (tmp_path / "curious.sh").chmod(0o755)
    text = 'product = "curious"\nversion = "1"\n[check]\ncommand = ["./curious.sh", "{model}"]\nrefuses = [1]\n'
    (tmp_path / "curious.toml").write_text(text)
    run = ToolChainRun(
        tmp_path / "curious.toml",
        "pim",
        "R-9.2.4.3-02",
        tmp_path / "out",
        None,
        None,
        1,
        hidden=(tmp_path / "acme.pem",),
    )
    prepared = prepare(run)
    response = prepared.processor.process("check", "m", "<Model/>")
    assert response.processed.status == 3
