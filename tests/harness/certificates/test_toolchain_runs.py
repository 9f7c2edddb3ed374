"""Certificates of tool chains: made by the same command, verified without the tool chain."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from command_line import ucm_cts
from files import ROOT
from forging import forger_of, trust
from workshop import Workshop

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.judging import judged_again
from ucm_cts.harness.certificates.keys import NOBODY
from ucm_cts.harness.certificates.verifying import Verifier

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("certificates of tool chains")]

DESCRIPTION = ROOT / "adapters" / "reference" / "toolchain" / "toolchain.toml"


def test_the_reference_tool_chain_is_certified_and_verified(tmp_path: Path) -> None:
    place = Workshop(tmp_path)
    out = tmp_path / "idl.ucmcert"
    made = ucm_cts(
        *("certify", "--toolchain", DESCRIPTION, "--profile", "idl", "--key", tmp_path / "acme.pem"),
        *("--out", out, "--report", tmp_path / "report"),
    )
    assert made.status == 0, made
    told = place.verify(out)
    assert told.status == 0, told
    assert told.out.startswith("STANDS ")
    assert "description/toolchain.toml" in told.out

    forger = forger_of(out.read_bytes())
    first = next(entry for entry in forger.said.requirements if entry.verdict == "pass")
    forger.requirement(first.id, exercised=first.exercised + 1)
    problems = Verifier(trust("acme"), judged_again).verify(forger.resigned()).problems
    assert [problem.check for problem in problems] == ["counts"]

    record = archive.unpacked(forger_of(out.read_bytes()).members[archive.RECORD])
    forger = forger_of(out.read_bytes())
    document = msgspec.json.decode(record)
    document["seed"] += 1
    forger.record(msgspec.json.encode(document))
    checks = {problem.check for problem in Verifier(trust("acme"), judged_again).verify(forger.resigned()).problems}
    assert "record" in checks

    nobody = Verifier(NOBODY, judged_again).verify(out.read_bytes())
    assert {"key", "record"} <= {problem.check for problem in nobody.problems}


def test_wrong_uses_are_said(tmp_path: Path) -> None:
    Workshop(tmp_path)
    certify = ("certify", "--key", tmp_path / "acme.pem", "--out", tmp_path / "x.ucmcert", "--report", tmp_path / "r")
    for arguments, text in (
        (("reference-py", "--toolchain", DESCRIPTION), "leave one out"),
        (("--toolchain", DESCRIPTION, "--profile", "core"), "is of frameworks"),
        (("reference-py", "--profile", "pim"), "is of tool chains"),
    ):
        outcome = ucm_cts(*certify, *arguments)
        assert outcome.status == 2, outcome
        assert text in outcome.err
