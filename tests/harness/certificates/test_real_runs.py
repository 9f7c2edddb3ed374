"""Certificates of real runs: they stand; what a lying vendor makes of their records does not."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest
from command_line import ucm_cts
from forging import Forger, forger_of, key_of, trust
from workshop import Workshop

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.certifying import sealed
from ucm_cts.harness.certificates.contents import Environment
from ucm_cts.harness.certificates.judging import judged_again
from ucm_cts.harness.certificates.reading import read_certificate
from ucm_cts.harness.certificates.verified import Verified, decoded
from ucm_cts.harness.certificates.verifying import Verifier

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("certificates")]


def _verify(data: bytes) -> Verified:
    return Verifier(trust("acme"), judged_again).verify(data)


def test_a_certificate_of_a_run_stands(workshop: Workshop) -> None:
    outcome = workshop.verify(workshop.certificate, "--json")
    assert outcome.status == 0, outcome
    verified = decoded(outcome.out.encode())
    assert verified.stands
    assert verified.verdict == "conformant"
    assert verified.signers == ("acme",)
    assert verified.digest == hashlib.sha256(workshop.certificate.read_bytes()).hexdigest()
    assert verified.report is not None
    assert verified.report.scenarios > 1_000
    names = {subject.name: subject.sha256 for subject in verified.subjects}
    assert names["artifact/libacme.so"] == hashlib.sha256(b"a library").hexdigest()
    assert "adapter/adapter.py" in names
    assert any(name.startswith("library/libc.so") for name in names)
    assert any(name.startswith("package/") for name in names), "the modules of the product"


def test_people_read_what_it_does_not_cover(workshop: Workshop) -> None:
    out = workshop.verify(workshop.certificate).out
    assert out.startswith("STANDS ")
    for text in (
        "CONFORMANT",
        "self-declared",
        "Not covered:",
        "not testable",
        "Rests on the signer's word:",
        "libacme.so",
    ):
        assert text in out


def test_it_is_small(workshop: Workshop) -> None:
    assert workshop.certificate.stat().st_size < 2_000_000


def test_it_stands_where_the_product_is_not(workshop: Workshop, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise AssertionError("a host, or a connection, was opened")

    monkeypatch.setattr("ucm_cts.harness.hosting.hosts.Hosts._open", refuse)
    monkeypatch.setattr("socket.socket.connect", refuse)
    assert workshop.verify(workshop.certificate).status == 0


def _lines(forger: Forger) -> list[bytes]:
    return archive.unpacked(forger.members[archive.RECORD]).splitlines(keepends=True)


def _rewritten(workshop: Workshop, change: Callable[[list[bytes]], list[bytes]]) -> Verified:
    """The certificate with a ``change`` of the lines of its record, signed by the vendor."""
    forger = _forger(workshop)
    forger.record(b"".join(change(_lines(forger))))
    return _verify(_signed(forger))


def _forger(workshop: Workshop) -> Forger:
    return forger_of(workshop.certificate.read_bytes())


def _signed(forger: Forger) -> bytes:
    return forger.resigned()


def _answers(lines: list[bytes]) -> list[int]:
    return [number for number, line in enumerate(lines) if number > 2 and b'"answer"' in line]


def _left_out(lines: list[bytes]) -> list[bytes]:
    del lines[_answers(lines)[40]]
    return lines


def _cut(lines: list[bytes]) -> list[bytes]:
    return lines[: _answers(lines)[-200]]


def _twice(lines: list[bytes]) -> list[bytes]:
    number = _answers(lines)[40]
    return [*lines[:number], lines[number], *lines[number:]]


def _reordered(lines: list[bytes]) -> list[bytes]:
    first, second = _answers(lines)[40:42]
    lines[first], lines[second] = lines[second], lines[first]
    return lines


def _event_dropped(lines: list[bytes]) -> list[bytes]:
    number = _answers(lines)[40]
    entry = json.loads(lines[number])
    entry["events"].pop(len(entry["events"]) // 2)
    entry["times"].pop(len(entry["times"]) // 2)
    lines[number] = msgspec.json.encode(entry) + b"\n"
    return lines


def _other_seed(lines: list[bytes]) -> list[bytes]:
    heading = json.loads(lines[0])
    heading["seed"] = 6
    return [msgspec.json.encode(heading) + b"\n", *lines[1:]]


def _time_back(lines: list[bytes]) -> list[bytes]:
    number = _answers(lines)[40]
    entry = json.loads(lines[number])
    entry["times"][3] = -entry["times"][3] - 10**9
    lines[number] = msgspec.json.encode(entry) + b"\n"
    return lines


def _renamed(lines: list[bytes]) -> list[bytes]:
    number = _answers(lines)[40]
    entry = json.loads(lines[number])
    entry["name"] = "something else"
    lines[number] = msgspec.json.encode(entry) + b"\n"
    return lines


def _drawn(lines: list[bytes]) -> list[bytes]:
    number = _answers(lines)[40]
    entry = json.loads(lines[number])
    entry["drawn"] = 10**6
    lines[number] = msgspec.json.encode(entry) + b"\n"
    return lines


RECORDS: dict[str, Callable[[list[bytes]], list[bytes]]] = {
    "scenario left out": _left_out,
    "cut": _cut,
    "scenario twice": _twice,
    "scenarios reordered": _reordered,
    "event dropped": _event_dropped,
    "of another seed": _other_seed,
    "time runs back": _time_back,
    "scenario renamed": _renamed,
    "drawn beyond bounds": _drawn,
    "heading only": lambda lines: lines[:1],
    "other whitespace": lambda lines: [lines[0].replace(b":", b": ", 1), *lines[1:]],
    "empty": lambda lines: [],
}


@pytest.mark.parametrize("way", RECORDS)
def test_a_record_that_was_tampered_with_is_refused(workshop: Workshop, way: str) -> None:
    verified = _rewritten(workshop, RECORDS[way])
    assert "record" in {problem.check for problem in verified.problems}, verified.problems
    assert not verified.stands


def test_a_verdict_that_the_record_does_not_show_is_refused(workshop: Workshop) -> None:
    forger = _forger(workshop)
    first, second = forger.said.requirements[:2]
    forger.requirement(first.id, exercised=first.exercised + 1)
    forger.requirement(second.id, verdict="fail")
    problems = {(problem.check, problem.detail.partition(" ")[0]) for problem in _verify(_signed(forger)).problems}
    assert problems == {("counts", first.id), ("verdict", second.id)}


def test_certificates_of_two_runs_do_not_mix(workshop: Workshop) -> None:
    forger = _forger(workshop)
    forger.report(seed=6)
    problems = {problem.check for problem in _verify(_signed(forger)).problems}
    assert "record" in problems


def test_a_product_that_fails_is_certified_as_such(workshop: Workshop) -> None:
    outcome = workshop.certify("ucm_cts.adapters.mutants.python:drops_the_sign", "bad.ucmcert")
    if outcome.status == 2:
        pytest.fail(outcome.err)
    assert outcome.status == 1
    verified = workshop.verify(workshop.folder / "bad.ucmcert")
    assert verified.status == 4, verified
    assert "NOT CONFORMANT" in verified.out
    forger = forger_of((workshop.folder / "bad.ucmcert").read_bytes())
    failed = [entry for entry in forger.said.requirements if entry.verdict == "fail"]
    for entry in failed:
        forger.requirement(entry.id, verdict="pass", findings=())
    forger.report(verdict="conformant")
    checks = {problem.check for problem in _verify(_signed(forger)).problems}
    assert {"verdict", "findings"} <= checks


def test_an_older_suite_can_be_judged_by_the_rules_of_this_one(workshop: Workshop, tmp_path: Path) -> None:
    contents = read_certificate(workshop.certificate.read_bytes())
    assert contents.claims is not None
    forger = _forger(workshop)
    forger.change(archive.ENVIRONMENT, lambda e: {**e, "suite": "0" * 64})
    first = forger.said.requirements[0].id
    forger.requirement(first, verdict="fail")
    environment = msgspec.json.decode(forger.members[archive.ENVIRONMENT], type=Environment)
    members = {name: content for name, content in forger.members.items() if name != archive.ENVELOPE}
    data = sealed(members, forger.claims, forger.subjects, environment, forger.said, [key_of("acme")])
    assert [problem.check for problem in _verify(data).problems] == ["suite"]
    verified = Verifier(trust("acme"), judged_again, suite="newer").verify(data)
    assert verified.stands
    assert verified.is_delta
    assert [(change.requirement, change.old, change.new) for change in verified.changes] == [(first, "fail", "pass")]


def test_commit_challenge_certify(workshop: Workshop) -> None:
    folder = workshop.folder
    key, auditor = folder / "acme.pem", folder / "auditor.pem"
    commitment, challenge = folder / "commitment.json", folder / "challenge.json"
    assert ucm_cts("commit", "reference-py", "--key", key, "--out", commitment).status == 0
    for number in (1, 2):
        trust = ("--trust", folder / "keys")
        answer = ucm_cts(
            "challenge", commitment, "--key", auditor, *trust, "--out", folder / f"challenge-{number}.json"
        )
        assert f"challenge number {number} " in answer.out
        assert "the commitment is signed by acme" in answer.out
    (folder / "challenge-2.json").rename(challenge)
    assert workshop.certify("reference-py", "challenged.ucmcert", "--challenge", challenge).status == 0
    told = workshop.verify(folder / "challenged.ucmcert", "--auditor", folder / "auditors").out
    assert "challenge number 2" in told
    assert "asked more than once" in told
    verified = decoded(
        workshop.verify(folder / "challenged.ucmcert", "--auditor", folder / "auditors", "--json").out.encode()
    )
    assert (verified.assurance, verified.challenges) == ("challenged", 2)
    plain = workshop.verify(folder / "challenged.ucmcert")
    assert plain.status == 0
    assert "--auditor KEYS" in plain.out
    other = workshop.certify("reference-py", "x.ucmcert", "--challenge", challenge, "--artifact", folder / "libacme.so")
    assert other.status == 2
    assert (
        "'artifact/libacme.so' takes part in this run, and the vendor did not commit to it; leave it out" in other.err
    )
    assert str(challenge) in other.err
