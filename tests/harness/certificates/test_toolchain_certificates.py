"""Certificates of tool chains that nobody vouches for, or that nobody could judge."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import msgspec
import pytest
from command_line import Outcome, ucm_cts
from forging import forger_of
from workshop import Workshop

from ucm_cts.adapters.reference import toolchain
from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.challenges import answered
from ucm_cts.harness.certificates.verified import decoded as verified_of
from ucm_cts.harness.toolchains.recorded_form import decoded, encoded

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("certificates of tool chains"), pytest.mark.usefixtures("here")]

DESCRIPTION = Path(toolchain.__file__).parent / "toolchain.toml"


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    """With a certificate of the reference tool chain for profile idl."""
    made = Workshop(tmp_path_factory.mktemp("workshop"))
    outcome = certify(made, "idl.ucmcert", "--profile", "idl")
    assert outcome.status == 0, outcome
    return made


def certify(workshop: Workshop, out: str, *more: str | Path) -> Outcome:
    folder = workshop.folder
    given = ("--key", folder / "acme.pem", "--out", folder / out, "--report", folder / f"{out}-report")
    return ucm_cts("certify", "--toolchain", DESCRIPTION, *given, *more)


def test_it_is_small(workshop: Workshop) -> None:
    assert (workshop.folder / "idl.ucmcert").stat().st_size < 300_000


def test_a_changed_answer_is_told_whoever_looks(workshop: Workshop) -> None:
    forger = forger_of((workshop.folder / "idl.ucmcert").read_bytes())
    record = decoded(archive.unpacked(forger.members[archive.RECORD]))
    call, *others = record.calls
    said = msgspec.structs.replace(call.said[0], model="0" * 16)
    changed = msgspec.structs.replace(record, calls=(msgspec.structs.replace(call, said=(said,)), *others))
    members = {**forger.members, archive.RECORD: archive.packed(encoded(changed))}
    (workshop.folder / "changed.ucmcert").write_bytes(archive.written(members))
    outcome = workshop.verify(workshop.folder / "changed.ucmcert", "--all")
    assert outcome.status == 1
    assert f"'{archive.RECORD}' is not the one that was signed" in outcome.out
    assert "models are not those that this suite makes with this seed" in outcome.out
    assert "because the signature is not trusted" in outcome.out


def test_a_stranger_is_told_that_no_compiler_has_read_it(workshop: Workshop) -> None:
    folder = workshop.folder / "nobody"
    folder.mkdir()
    ucm_cts("key", "somebody", "--out", workshop.folder)
    (workshop.folder / "somebody.pub").rename(folder / "somebody.pub")
    outcome = ucm_cts("verify", workshop.folder / "idl.ucmcert", "--trust", folder)
    assert outcome.status == 1
    assert "was read by no compiler, because the signature is not trusted" in outcome.out


def test_code_that_nobody_could_judge_is_not_certified(here: Path, workshop: Workshop) -> None:
    words = json.dumps(
        [sys.executable, "-m", "ucm_cts.adapters.reference.toolchain", "cpp11", "{model}", "--out", "{out}"]
    )
    text = f'product = "ours"\nversion = "1"\n[cpp11]\ncommand = {words}\nlibraries = ["lib/libours.a"]\n'
    (here / "ours.toml").write_text(text)
    key = ("--key", workshop.folder / "acme.pem")
    outcome = ucm_cts("certify", "--toolchain", "ours.toml", "--profile", "cpp11", *key, "--out", "ours.ucmcert")
    assert outcome.status == 2
    assert "nobody could verify the certificate: it needs '" in outcome.err
    assert not (here / "ours.ucmcert").exists()


def test_commit_challenge_certify(workshop: Workshop) -> None:
    folder = workshop.folder
    commitment, challenge, out = folder / "commitment.json", folder / "challenge.json", folder / "challenged.ucmcert"
    profile = ("--toolchain", DESCRIPTION, "--profile", "idl")
    assert ucm_cts("commit", *profile, "--key", folder / "acme.pem", "--out", commitment).status == 0
    assert ucm_cts("challenge", commitment, "--key", folder / "auditor.pem", "--out", challenge).status == 0
    other = certify(workshop, out.name, *profile, "--challenge", challenge, "--artifact", commitment)
    assert other.status == 2
    assert "the vendor did not commit to it" in other.err
    assert certify(workshop, out.name, *profile, "--challenge", challenge, "--no-sandbox").status == 0
    told = workshop.verify(out, "--auditor", folder / "auditors", "--json")
    assert told.status == 0
    verified = verified_of(told.out.encode())
    assert (verified.assurance, verified.challenges, verified.isolation) == ("challenged", 1, "process")
    assert verified.report is not None
    assert verified.report.seed == answered(challenge.read_bytes()).seed


def test_options_of_frameworks_are_refused(workshop: Workshop) -> None:
    for command, option, value in (("certify", "--memory", "99"), ("commit", "--systematic", "1")):
        key = ("--key", workshop.folder / "acme.pem", "--out", workshop.folder / "none")
        outcome = ucm_cts(command, "--toolchain", DESCRIPTION, *key, option, value)
        assert outcome.status == 2
        assert f"{option} is for frameworks behind adapters" in outcome.err
