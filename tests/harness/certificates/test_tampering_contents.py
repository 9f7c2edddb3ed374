"""Forged certificates: by a stranger, who cannot sign, and by a vendor who signs lies. Each way is refused with its own line."""

from __future__ import annotations

import base64
from collections.abc import Callable
from typing import Any

import msgspec
import pytest
from forging import (
    ADAPTER,
    Forger,
    challenge_to,
    commitment_to,
    failing,
    fake_judge,
    forger_of,
    intact,
    key_of,
    made_report,
    run_of,
    seed_of,
    trust,
    verify,
)

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.certifying import certificate
from ucm_cts.harness.certificates.envelopes import encoded, opened, signed
from ucm_cts.harness.certificates.keys import Rule
from ucm_cts.harness.certificates.verified import Subject, Verified

FIRST = made_report().requirements[0].id
SECOND = made_report().requirements[1].id
AUDITORS = trust("tuev")


def _stranger(name: str, change: Callable[[Any], Any]) -> bytes:
    """A member is changed, and the signature is left as it was."""
    forger = forger_of(intact())
    forger.change(name, change)
    return forger.unsigned()


def _vendor(change: Callable[[Forger], object], kind: str = "plain") -> bytes:
    """The vendor changes what is to be signed, and signs it again."""
    forger = forger_of(intact(kind))
    change(forger)
    return forger.resigned()


def _claimed(**changes: Any) -> Callable[[Forger], None]:
    def change(forger: Forger) -> None:
        forger.claims = msgspec.structs.replace(forger.claims, **changes)

    return change


def _set(*path: str, to: Any) -> Callable[[Any], Any]:
    """Sets one place of a JSON document."""

    def change(document: Any) -> Any:
        inner = document
        for key in path[:-1]:
            inner = inner[key]
        inner[path[-1]] = to
        return document

    return change


def _payload(change: Callable[[Any], Any]) -> bytes:
    return forger_of(intact()).signed_statement(change)


def _reencoded(name: str, content: Callable[[bytes], bytes]) -> bytes:
    forger = forger_of(intact())
    forger.members[name] = content(forger.members[name])
    return forger.resigned() if name not in (archive.ENVELOPE,) else forger.unsigned()


def _deep(depth: int = 100_000) -> bytes:
    return b"[" * depth + b"]" * depth


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


def _flipped_verdict(forger: Forger) -> None:
    forger.requirement(FIRST, verdict="pass", findings=())
    forger.report(verdict="conformant")


def _waiver(**fields: str) -> Callable[[Forger], None]:
    def change(forger: Forger) -> None:
        entry = {"requirement": FIRST, "observed": "no *", "reason": "soon", "expires": "2099-01-01", **fields}
        forger.change(archive.WAIVERS, lambda _: [entry])

    return change


def _models(models: dict[str, str]) -> Callable[[Forger], None]:
    def change(forger: Forger) -> None:
        forger.members[archive.MODELS] = encoded(models)

    return change


def _record_of(report_change: Callable[[Any], Any]) -> Callable[[Forger], None]:
    def change(forger: Forger) -> None:
        forger.record(msgspec.json.encode(report_change(forger.said)))

    return change


def _first_missing(forger: Forger) -> None:
    forger.report(requirements=forger.said.requirements[1:])


def _first_only(forger: Forger) -> None:
    forger.report(requirements=forger.said.requirements[:1])


def _surplus(forger: Forger) -> None:
    extra = msgspec.structs.replace(forger.said.requirements[0], id="R-99-01")
    forger.report(requirements=(*forger.said.requirements, extra))


def _twice(forger: Forger) -> None:
    forger.report(requirements=(*forger.said.requirements, forger.said.requirements[0]))


def _environment(name: str, value: Any) -> Callable[[Forger], None]:
    return lambda forger: forger.change(archive.ENVIRONMENT, _set(name, to=value))


def _setting(name: str, value: Any) -> Callable[[Forger], None]:
    return lambda forger: forger.change(archive.ENVIRONMENT, _set("settings", name, to=value))


def _another_suite(forger: Forger) -> None:
    forger.report(suite_version="0.0.9")
    forger.change(archive.ENVIRONMENT, _set("suite_version", to="0.0.9"))


def _another_specification(forger: Forger) -> None:
    _claimed(specification="OMG CCM 4.0")(forger)
    forger.change(archive.ENVIRONMENT, _set("specification", to="OMG CCM 4.0"))


STRANGERS: dict[str, tuple[Callable[[], bytes], str, str]] = {
    "report: verdict flipped": (
        lambda: _stranger(archive.REPORT, _set("verdict", to="not conformant")),
        "digest",
        "'report.json' is not the one",
    ),
    "report: product renamed": (
        lambda: _stranger(archive.REPORT, _set("product", to="Other")),
        "digest",
        "'report.json' is not the one",
    ),
    "statement: reading changed": (
        lambda: _stranger(archive.STATEMENT, _set("product", to="Other")),
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
        lambda: _stranger(archive.ENVIRONMENT, _set("isolation", to="bubblewrap")),
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
    "envelope nests deep": (lambda: _reencoded(archive.ENVELOPE, lambda _: _deep()), "envelope", "cannot be read"),
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


VENDORS: dict[str, tuple[Callable[[], bytes], str, str]] = {
    "verdict of the run flipped": (lambda: _vendor(lambda f: f.report(verdict="conformant"), "failing"), "verdict", "says 'conformant', and its record shows 'not conformant'"),
    "verdict of a requirement flipped": (lambda: _vendor(_flipped_verdict, "failing"), "verdict", f"{FIRST} is said to be 'pass', and the record shows 'fail'"),
    "counts raised": (lambda: _vendor(lambda f: f.requirement(FIRST, exercised=999)), "counts", f"{FIRST} is said to be exercised 999 times"),
    "verdict flipped with its counts": (lambda: _vendor(lambda f: f.requirement(FIRST, verdict="fail", exercised=0)), "verdict", f"{FIRST} is said to be 'fail'"),
    "failure hidden": (lambda: _vendor(lambda f: f.requirement(FIRST, findings=()), "failing"), "findings", f"the failures of {FIRST} are not those"),
    "failure told otherwise": (lambda: _vendor(lambda f: f.requirement(FIRST, findings=(msgspec.structs.replace(f.said.requirements[0].findings[0], observed="a small thing"),)), "failing"), "findings", "observed is said to be 'a small thing'"),
    "failure waived in the report only": (lambda: _vendor(lambda f: f.requirement(FIRST, findings=(msgspec.structs.replace(f.said.requirements[0].findings[0], waived="known"),)), "failing"), "findings", "waived is said to be 'known'"),
    "requirement left out": (lambda: _vendor(_first_missing), "requirements", f"{FIRST} is missing from the report"),
    "cut down to one requirement": (lambda: _vendor(_first_only), "requirements", "more of this kind"),
    "requirement invented": (lambda: _vendor(_surplus), "requirements", "R-99-01 is in the report"),
    "requirement twice": (lambda: _vendor(_twice), "requirements", "a requirement twice"),
    "requirement made a recommendation": (lambda: _vendor(lambda f: f.requirement(FIRST, decides=False)), "report", f"{FIRST} has decides"),
    "title of a requirement changed": (lambda: _vendor(lambda f: f.requirement(FIRST, title="Easy")), "report", f"{FIRST} has title 'Easy'"),
    "reason invented": (lambda: _vendor(lambda f: f.requirement(FIRST, reason="trust me")), "report", f"{FIRST} has reason 'trust me'"),
    "scenarios raised": (lambda: _vendor(lambda f: f.report(scenarios=10**6)), "report", "says scenarios 1000000"),
    "runs raised": (lambda: _vendor(lambda f: f.report(runs=50)), "report", "says runs 50"),
    "incomplete run called complete": (lambda: _vendor(_record_of(lambda r: msgspec.structs.replace(r, incomplete="interrupted"))), "report", "says incomplete ''"),
    "selection hidden": (lambda: _vendor(_record_of(lambda r: msgspec.structs.replace(r, selection="10.1.3"))), "report", "says selection ''"),
    "scope embellished": (lambda: _vendor(lambda f: f.report(scope=msgspec.structs.replace(f.said.scope, asked=5_000))), "report", "says scope"),
    "readings invented": (lambda: _vendor(lambda f: f.report(readings={"x": ("y",)})), "report", "says readings"),
    "record of another run": (lambda: _vendor(_record_of(lambda r: failing(r, SECOND))), "verdict", f"{SECOND} is said to be 'pass', and the record shows 'fail'"),
    "record of another seed": (lambda: _vendor(_record_of(lambda r: msgspec.structs.replace(r, seed=8))), "report", "says seed 7, and the record shows 8"),
    "product claimed that did not run": (lambda: _vendor(_claimed(product="Better UCM")), "claims", "says product 'Better UCM', and the report says 'Acme UCM'"),
    "version claimed that did not run": (lambda: _vendor(_claimed(version="9.9")), "claims", "says version '9.9'"),
    "profile claimed that did not run": (lambda: _vendor(_claimed(profile="core")), "claims", "says profile 'core'"),
    "verdict claimed that is not reported": (lambda: _vendor(_claimed(verdict="conformant"), "failing"), "claims", "says verdict 'conformant'"),
    "seed claimed that did not run": (lambda: _vendor(_claimed(seed=1)), "claims", "says seed 1"),
    "isolation claimed otherwise": (lambda: _vendor(_claimed(isolation="bubblewrap")), "claims", "says isolation 'bubblewrap'"),
    "suite claimed otherwise": (lambda: _vendor(_claimed(suite_version="9.0")), "claims", "says suite version '9.0'"),
    "profile that there is not": (lambda: _vendor(lambda f: f.report(profile="platinum")), "claims", "there is no profile 'platinum'"),
    "signed tests: failure called passed": (lambda: _payload(_moved_test), "tests", "passedTests of the signed statement are not those of the report"),
    "signed tests: one left out": (lambda: _payload(_dropped_test), "tests", f"passedTests of the signed statement are not those of the report: {FIRST}"),
    "result PASSED of what failed": (lambda: forger_of(intact("failing")).signed_statement(_set("predicate", "result", to="PASSED")), "result", "in-toto's result is PASSED, and the verdict is 'not conformant'"),
    "configuration without the record": (lambda: _payload(_without_configuration(archive.RECORD)), "digest", "'record.zst' is in the archive, and was not signed"),
    "configuration names a member twice": (lambda: _payload(_configuration_twice), "digest", "names a member twice"),
    "configuration names what is not there": (lambda: _payload(_configuration_surplus), "digest", "'invoice.pdf' was signed, and is not in the archive"),
    "configuration with another suite": (lambda: _payload(_configuration_suite), "digest", "the signed digest of the suite is not the one of the environment"),
    "no subjects": (lambda: _vendor(lambda f: f.subjects.clear()), "subjects", "names nothing that took part"),
    "subject twice": (lambda: _payload(lambda s: {**s, "subject": [s["subject"][0]] * 2}), "subjects", "names a subject twice"),
    "subject without SHA-256": (lambda: _payload(_set_subject({"md5": "00"})), "subjects", "is no SHA-256"),
    "subject with half a digest": (lambda: _vendor(lambda f: f.subjects.append(Subject("artifact/x", "abc"))), "subjects", "the digest of 'artifact/x' is no SHA-256"),
    "another predicate": (lambda: _payload(_set("predicateType", to="https://slsa.dev/provenance/v1")), "envelope", "predicateType is 'https://slsa.dev/provenance/v1'"),
    "another statement type": (lambda: _payload(_set("_type", to="https://in-toto.io/Statement/v0.1")), "envelope", "_type is"),
    "format of the future": (lambda: _payload(_set("predicate", "ucm", "format", to=2)), "format", "has format 2, and this ucm-cts reads 1: install a newer ucm-cts"),
    "field added to the statement": (lambda: _payload(_set("predicate", "url", to="https://x")), "envelope", "unknown field"),
    "statement as another payload type": (lambda: forger_of(intact()).signed_statement(lambda s: s, "application/json"), "envelope", "is of 'application/json'"),
    "report written anew": (lambda: _reencoded_signed(archive.REPORT, lambda c: c.replace(b"\n", b"\r\n")), "report", "written otherwise"),
    "report with a key twice": (lambda: _reencoded_signed(archive.REPORT, lambda c: c.replace(b"{\n", b'{\n  "product": "Evil",\n', 1)), "report", "written otherwise"),
    "report of another schema version": (lambda: _reencoded_signed(archive.REPORT, lambda c: c.replace(b'"schema_version": 2', b'"schema_version": 9', 1)), "format", "schema version 9"),
    "report nests deep": (lambda: _reencoded_signed(archive.REPORT, lambda _: _deep()), "report", "cannot be read"),
    "report is no UTF-8": (lambda: _reencoded_signed(archive.REPORT, lambda c: c.replace(b"Acme", b"Ac\xff\xfe")), "report", "cannot be read"),
    "statement of another product": (lambda: _vendor(lambda f: f.change(archive.STATEMENT, _set("product", to="Other"))), "statement", "the statement is about product 'Other'"),
    "statement swapped for an easier one": (lambda: _vendor(_easier_statement), "statement", "the report is of another statement"),
    "statement that does not claim the profile": (lambda: _vendor(_without_profile), "statement", "does not claim profile 'container'"),
    "statement with a reading that there is not": (lambda: _vendor(_wrong_reading), "statement", "which is no reading of it"),
    "statement without a capability": (lambda: _vendor(_without_capability), "statement", "lacks the capability"),
    "statement with endless patience": (lambda: _vendor(lambda f: f.change(archive.STATEMENT, _set("ixit", "patience", to=1e12))), "statement", "declares patience"),
    "statement with an option of its own": (lambda: _vendor(lambda f: f.change(archive.STATEMENT, _set("readings", "mercy", to="yes"))), "statement", "has the reading 'mercy', which there is not"),
    "waiver of no requirement": (lambda: _vendor(_waiver(requirement="R-0-0")), "waiver", "'R-0-0', which is no requirement"),
    "waiver without a date": (lambda: _vendor(_waiver(expires="never")), "waiver", "expires on 'never', which is no date"),
    "waiver that had expired before": (lambda: _vendor(_waiver(expires="2020-01-01")), "waiver", "had expired on 2020-01-01, before the certificate was signed"),
    "models that lead elsewhere": (lambda: _vendor(_models({"../../x.xml": "<a/>"})), "models", "'../../x.xml' is no name of a model"),
    "models with a hidden name": (lambda: _vendor(_models({".bashrc": "x"})), "models", "'.bashrc' is no name of a model"),
    "models that nobody declares": (lambda: _vendor(_models({"a.xml": "<a/>"})), "models", "models that the statement does not declare"),
    "models taken out": (lambda: _vendor(lambda f: f.members.pop(archive.MODELS), "with models"), "models", "declares models, and the certificate has none"),
    "environment of another suite": (lambda: _vendor(_environment("suite_version", "0.0.9")), "claims", "the environment says '0.0.9'"),
    "environment written anew": (lambda: _reencoded_signed(archive.ENVIRONMENT, lambda c: c + b"\n"), "environment", "written otherwise"),
    "a million scenarios drawn": (lambda: _vendor(_setting("drawn", 10**6)), "settings", "drawn = 1000000"),
    "endless systematic suites": (lambda: _vendor(_setting("systematic", 99)), "settings", "systematic = 99"),
    "hosts with endless time": (lambda: _vendor(_setting("timeout", 1e300)), "settings", "timeout = 1e+300"),
    "made with an older suite": (lambda: _vendor(_another_suite), "suite", "it was made with ucm-cts 0.0.9"),
    "made with another build": (lambda: _vendor(_environment("suite", "c" * 64)), "suite", "it was made with build cccccccccccc"),
    "made with a changed catalogue": (lambda: _vendor(_environment("catalogue", "c" * 64)), "suite", "its catalogue is not the one"),
    "of another specification": (lambda: _vendor(_another_specification), "specification", "it is about 'OMG CCM 4.0'"),
    "signed in the future": (lambda: _vendor(_claimed(issued="2199-01-01T00:00:00+00:00")), "time", "signed in the future"),
    "signed at no time": (lambda: _vendor(_claimed(issued="yesterday")), "time", "'yesterday' is no moment"),
    "signed before it ran": (lambda: _vendor(_claimed(issued="2026-10-01T10:00:00+00:00")), "time", "after the certificate was signed"),
    "signed before the run ended": (lambda: _vendor(lambda f: f.report(seconds=90 * 86_400.0)), "time", "so that it was signed before its end"),
    "run that took less than nothing": (lambda: _vendor(lambda f: f.report(seconds=-1.0)), "time", "less than nothing"),
    "clause that took less than nothing": (lambda: _vendor(lambda f: f.report(seconds_by_clause={"10": -1.0})), "time", "less than nothing"),
    "requirement that took for ever": (lambda: _vendor(lambda f: f.requirement(FIRST, seconds=1e300)), "time", "more than a year"),
    "ran at no time": (lambda: _vendor(lambda f: f.report(started="noon")), "time", "'noon' is no moment at which the run began"),
    "challenge in a self-declared one": (lambda: _vendor(_claimed(assurance="self-declared"), "challenged"), "challenge", "and says that it is self-declared"),
}  # fmt: skip


def _reencoded_signed(name: str, change: Callable[[bytes], bytes]) -> bytes:
    """A member in other bytes, with its digest signed."""
    forger = forger_of(intact())
    content = change(forger.members[name])
    forger.members[name] = content
    from ucm_cts.harness.certificates.contents import digest

    def signed_digest(statement: Any) -> Any:
        for one in statement["predicate"]["configuration"]:
            if one["name"] == name:
                one["digest"] = {"sha256": digest(content)}
        return statement

    return forger.signed_statement(signed_digest)


def _moved_test(statement: Any) -> Any:
    statement["predicate"]["warnedTests"] = [statement["predicate"]["passedTests"].pop()]
    return statement


def _dropped_test(statement: Any) -> Any:
    statement["predicate"]["passedTests"].pop(0)
    return statement


def _without_configuration(name: str) -> Callable[[Any], Any]:
    def change(statement: Any) -> Any:
        kept = [one for one in statement["predicate"]["configuration"] if one["name"] != name]
        statement["predicate"]["configuration"] = kept
        return statement

    return change


def _configuration_twice(statement: Any) -> Any:
    statement["predicate"]["configuration"].append(statement["predicate"]["configuration"][0])
    return statement


def _configuration_surplus(statement: Any) -> Any:
    statement["predicate"]["configuration"].append({"name": "invoice.pdf", "digest": {"sha256": "0" * 64}})
    return statement


def _configuration_suite(statement: Any) -> Any:
    for one in statement["predicate"]["configuration"]:
        if one["name"] == "suite":
            one["digest"] = {"sha256": "0" * 64}
    return statement


def _set_subject(digest: dict[str, str]) -> Callable[[Any], Any]:
    return lambda statement: {**statement, "subject": [{"name": "x", "digest": digest}]}


def _easier_statement(forger: Forger) -> None:
    def change(statement: Any) -> Any:
        first = next(iter(statement["capabilities"]))
        statement["capabilities"][first] = False
        return statement

    forger.change(archive.STATEMENT, change)


def _without_profile(forger: Forger) -> None:
    forger.change(archive.STATEMENT, _set("profiles", to=["core"]))


def _wrong_reading(forger: Forger) -> None:
    forger.change(archive.STATEMENT, lambda s: _set("readings", next(iter(s["readings"])), to="as I like")(s))


def _without_capability(forger: Forger) -> None:
    def change(statement: Any) -> Any:
        statement["capabilities"].pop(next(iter(statement["capabilities"])))
        return statement

    forger.change(archive.STATEMENT, change)


def _assert_refused(verified: Verified, check: str, detail: str) -> None:
    found = [problem for problem in verified.problems if problem.check == check and detail in problem.detail]
    assert found, verified.problems


@pytest.mark.parametrize("way", STRANGERS)
def test_what_a_stranger_changes_is_refused(way: str) -> None:
    make, check, detail = STRANGERS[way]
    _assert_refused(verify(make()), check, detail)


@pytest.mark.parametrize("way", VENDORS)
def test_what_a_vendor_signs_and_did_not_happen_is_refused(way: str) -> None:
    make, check, detail = VENDORS[way]
    verified = verify(make())
    _assert_refused(verified, check, detail)
    assert not {problem.check for problem in verified.problems} & {"signature", "key"}


def _challenged(make: Callable[[], bytes], **claims: Any) -> bytes:
    """A certificate that answers the challenge of ``make``, with the right seed for it unless ``claims`` have another."""
    answer = make()
    report = msgspec.structs.replace(made_report(), seed=claims.pop("seed", seed_of(answer)))
    forger = forger_of(certificate(run_of(report, assurance="challenged", challenge=answer), [key_of("acme")]))
    forger.claims = msgspec.structs.replace(forger.claims, **claims)
    return forger.resigned()


def _committed(**changes: Any) -> Callable[[], bytes]:
    return lambda: _challenged(lambda: challenge_to(commitment_to(made_report(), **changes)))


def _answer(**changes: Any) -> Callable[[], bytes]:
    def make() -> bytes:
        return challenge_to(commitment_to(made_report()), **changes)

    return lambda: _challenged(make)


def _garbled(**changes: Any) -> bytes:
    """A challenge that cannot be read takes the place of a good one."""
    forger = forger_of(intact("challenged"))
    forger.members[archive.CHALLENGE] = challenge_to(commitment_to(made_report()), **changes)
    return forger.resigned()


def _as_plain(forger: Forger) -> None:
    _claimed(assurance="challenged")(forger)


def _answer_in_place_of_commitment() -> bytes:
    forger = forger_of(intact("challenged"))
    both = msgspec.json.decode(forger.members[archive.CHALLENGE])
    both["commitment"] = both["challenge"]
    forger.members[archive.CHALLENGE] = msgspec.json.format(msgspec.json.encode(both), indent=1) + b"\n"
    return forger.resigned()


CHALLENGES: dict[str, tuple[Callable[[], bytes], str, str]] = {
    "seed of the vendor's own": (lambda: _challenged(lambda: challenge_to(commitment_to(made_report())), seed=7), "seed", "the run had seed 7, and commitment and challenge give"),
    "no challenge at all": (lambda: _vendor(_as_plain), "challenge", "and has no challenge"),
    "nonce drawn by the vendor": (_answer(auditor="acme"), "auditor", "no auditor whom you rely on signed the challenge"),
    "nonce drawn by a stranger": (_answer(auditor="stranger"), "auditor", "no auditor whom you rely on signed the challenge"),
    "commitment of another vendor": (_answer(vendor="other"), "commitment", "not signed with a key that signed the certificate"),
    "commitment to another product": (_committed(product="Old UCM"), "commitment", "committed to product 'Old UCM'"),
    "commitment to another version": (_committed(version="1.1"), "commitment", "committed to version '1.1'"),
    "commitment to another profile": (_committed(profile="core"), "commitment", "committed to profile 'core'"),
    "commitment to another statement": (_committed(statement="0" * 64), "commitment", "another statement"),
    "commitment to other waivers": (_committed(waivers="0" * 64), "commitment", "another waivers"),
    "commitment to another build of the suite": (_committed(suite="0" * 64), "commitment", "another build of the suite"),
    "commitment to other systematic suites": (_committed(systematic=2), "commitment", "other systematic suites"),
    "commitment to no file": (_committed(subjects=()), "commitment", "no file of the product"),
    "library exchanged after the commitment": (lambda: _exchanged(), "commitment", "another 'adapter/acme.py' than the one that ran"),
    "challenge after the certificate": (_answer(issued="2198-01-01T00:00:00+00:00"), "challenge", "not made in this order"),
    "commitment after the challenge": (_committed(made="2026-10-31T11:00:00+00:00"), "challenge", "not made in this order"),
    "challenge at no time": (_answer(issued="soon"), "challenge", "no moment"),
    "challenge to another commitment": (lambda: _garbled(commitment="0" * 64), "challenge", "to another commitment"),
    "nonce of the vendor's format": (lambda: _garbled(nonce="00"), "challenge", "nonce is none"),
    "challenge number nought": (lambda: _garbled(number=0), "challenge", "counted from 1"),
    "answer in place of the commitment": (_answer_in_place_of_commitment, "challenge", "signed as something else"),
    "witnessed by the vendor": (lambda: _vendor(_claimed(assurance="witnessed")), "witness", "no auditor whom you rely on signed it"),
}  # fmt: skip


def _exchanged() -> bytes:
    forger = forger_of(intact("challenged"))
    forger.subjects[0] = Subject(ADAPTER.name, "c" * 64)
    return forger.resigned()


@pytest.mark.parametrize("way", CHALLENGES)
def test_what_no_auditor_bears_out_is_refused(way: str) -> None:
    make, check, detail = CHALLENGES[way]
    verified = verify(make(), auditors=AUDITORS)
    _assert_refused(verified, check, detail)
    assert verified.assurance == "self-declared"


def test_a_key_in_both_roles_makes_nothing_challenged_or_witnessed() -> None:
    challenged = verify(intact("challenged"), "acme", "tuev", auditors=AUDITORS)
    witnessed = verify(intact("witnessed"), "acme", "tuev", auditors=AUDITORS)
    _assert_refused(challenged, "auditor", "nobody challenges himself")
    _assert_refused(witnessed, "witness", "nobody witnesses for himself")
    assert challenged.assurance == witnessed.assurance == "self-declared"


def test_several_lies_are_told_together() -> None:
    forger = forger_of(intact("failing"))
    _flipped_verdict(forger)
    forger.requirement(SECOND, exercised=99)
    forger.claims = msgspec.structs.replace(forger.claims, product="Better UCM", issued="never")
    forger.change(archive.ENVIRONMENT, _set("suite_version", to="7"))
    data = forger_of(forger.resigned()).envelope(lambda e: {**e, "signatures": [{"keyid": "00", "sig": "AAAA"}]})
    checks = {problem.check for problem in verify(data).problems}
    assert {"key", "verdict", "findings", "counts", "claims", "time"} <= checks


def test_a_lost_key_vouches_for_nothing() -> None:
    verified = verify(intact(), acme=Rule(lost="2026-11-02"))
    _assert_refused(verified, "lost key", "key 'acme' was lost on 2026-11-02")
    assert verified.signers == ()


def test_a_key_vouches_for_its_own_products_only() -> None:
    assert verify(intact(), acme=Rule(products=("Acme *",))).stands
    other = verify(intact(), acme=Rule(products=("Other [1]",)))
    _assert_refused(other, "key of another product", "vouches for Other [1]")


def test_one_bad_signature_beside_a_good_one_is_told() -> None:
    def spoil(envelope: Any) -> Any:
        raw = bytearray(base64.b64decode(envelope["signatures"][1]["sig"]))
        raw[0] ^= 1
        envelope["signatures"][1]["sig"] = base64.b64encode(raw).decode()
        return envelope

    data = forger_of(intact("twice signed")).envelope(spoil)
    _assert_refused(verify(data, "acme", "lab"), "signature", "key 'lab'")
    assert verify(data).stands, "a key that the verifier does not know says nothing"


def test_an_expired_waiver_is_told() -> None:
    import datetime

    from ucm_cts.harness.certificates.verifying import Verifier

    later = datetime.datetime(2101, 1, 1, tzinfo=datetime.UTC)
    verified = Verifier(trust("acme"), fake_judge, today=later).verify(intact("waived"))
    _assert_refused(verified, "waiver expired", "expired on 2099-12-31; ask for a new certificate")


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
