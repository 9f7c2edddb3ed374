"""A certificate whose vendor signs what did not happen is refused. Each way has its own line."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
import pytest
from forging import (
    Forger,
    failing,
    forger_of,
    intact,
    verify,
)
from tampering import FIRST, SECOND, assert_refused, claimed, deep, flipped_verdict, set_place, vendor

from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.envelopes import encoded
from ucm_cts.harness.certificates.verified import Subject


def _payload(change: Callable[[Any], Any]) -> bytes:
    return forger_of(intact()).signed_statement(change)


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
    return lambda forger: forger.change(archive.ENVIRONMENT, set_place(name, to=value))


def _setting(name: str, value: Any) -> Callable[[Forger], None]:
    return lambda forger: forger.change(archive.ENVIRONMENT, set_place("settings", name, to=value))


def _another_suite(forger: Forger) -> None:
    forger.report(suite_version="0.0.9")
    forger.change(archive.ENVIRONMENT, set_place("suite_version", to="0.0.9"))


def _another_specification(forger: Forger) -> None:
    claimed(specification="OMG CCM 4.0")(forger)
    forger.change(archive.ENVIRONMENT, set_place("specification", to="OMG CCM 4.0"))


VENDORS: dict[str, tuple[Callable[[], bytes], str, str]] = {
    "verdict of the run flipped": (lambda: vendor(lambda f: f.report(verdict="conformant"), "failing"), "verdict", "says 'conformant', and its record shows 'not conformant'"),
    "verdict of a requirement flipped": (lambda: vendor(flipped_verdict, "failing"), "verdict", f"{FIRST} is said to be 'pass', and the record shows 'fail'"),
    "counts raised": (lambda: vendor(lambda f: f.requirement(FIRST, exercised=999)), "counts", f"{FIRST} is said to be exercised 999 times"),
    "verdict flipped with its counts": (lambda: vendor(lambda f: f.requirement(FIRST, verdict="fail", exercised=0)), "verdict", f"{FIRST} is said to be 'fail'"),
    "failure hidden": (lambda: vendor(lambda f: f.requirement(FIRST, findings=()), "failing"), "findings", f"the failures of {FIRST} are not those"),
    "failure told otherwise": (lambda: vendor(lambda f: f.requirement(FIRST, findings=(msgspec.structs.replace(f.said.requirements[0].findings[0], observed="a small thing"),)), "failing"), "findings", "observed is said to be 'a small thing'"),
    "failure waived in the report only": (lambda: vendor(lambda f: f.requirement(FIRST, findings=(msgspec.structs.replace(f.said.requirements[0].findings[0], waived="known"),)), "failing"), "findings", "waived is said to be 'known'"),
    "requirement left out": (lambda: vendor(_first_missing), "requirements", f"{FIRST} is missing from the report"),
    "cut down to one requirement": (lambda: vendor(_first_only), "requirements", "more of this kind"),
    "requirement invented": (lambda: vendor(_surplus), "requirements", "R-99-01 is in the report"),
    "requirement twice": (lambda: vendor(_twice), "requirements", "a requirement twice"),
    "requirement made a recommendation": (lambda: vendor(lambda f: f.requirement(FIRST, decides=False)), "report", f"{FIRST} has decides"),
    "title of a requirement changed": (lambda: vendor(lambda f: f.requirement(FIRST, title="Easy")), "report", f"{FIRST} has title 'Easy'"),
    "reason invented": (lambda: vendor(lambda f: f.requirement(FIRST, reason="trust me")), "report", f"{FIRST} has reason 'trust me'"),
    "scenarios raised": (lambda: vendor(lambda f: f.report(scenarios=10**6)), "report", "says scenarios 1000000"),
    "runs raised": (lambda: vendor(lambda f: f.report(runs=50)), "report", "says runs 50"),
    "incomplete run called complete": (lambda: vendor(_record_of(lambda r: msgspec.structs.replace(r, incomplete="interrupted"))), "report", "says incomplete ''"),
    "selection hidden": (lambda: vendor(_record_of(lambda r: msgspec.structs.replace(r, selection="10.1.3"))), "report", "says selection ''"),
    "scope embellished": (lambda: vendor(lambda f: f.report(scope=msgspec.structs.replace(f.said.scope, asked=5_000))), "report", "says scope"),
    "readings invented": (lambda: vendor(lambda f: f.report(readings={"x": ("y",)})), "report", "says readings"),
    "record of another run": (lambda: vendor(_record_of(lambda r: failing(r, SECOND))), "verdict", f"{SECOND} is said to be 'pass', and the record shows 'fail'"),
    "record of another seed": (lambda: vendor(_record_of(lambda r: msgspec.structs.replace(r, seed=8))), "report", "says seed 7, and the record shows 8"),
    "product claimed that did not run": (lambda: vendor(claimed(product="Better UCM")), "claims", "says product 'Better UCM', and the report says 'Acme UCM'"),
    "version claimed that did not run": (lambda: vendor(claimed(version="9.9")), "claims", "says version '9.9'"),
    "profile claimed that did not run": (lambda: vendor(claimed(profile="core")), "claims", "says profile 'core'"),
    "verdict claimed that is not reported": (lambda: vendor(claimed(verdict="conformant"), "failing"), "claims", "says verdict 'conformant'"),
    "seed claimed that did not run": (lambda: vendor(claimed(seed=1)), "claims", "says seed 1"),
    "isolation claimed otherwise": (lambda: vendor(claimed(isolation="bubblewrap")), "claims", "says isolation 'bubblewrap'"),
    "suite claimed otherwise": (lambda: vendor(claimed(suite_version="9.0")), "claims", "says suite version '9.0'"),
    "profile that there is not": (lambda: vendor(lambda f: f.report(profile="platinum")), "claims", "there is no profile 'platinum'"),
    "signed tests: failure called passed": (lambda: _payload(_moved_test), "tests", "passedTests of the signed statement are not those of the report"),
    "signed tests: one left out": (lambda: _payload(_dropped_test), "tests", f"passedTests of the signed statement are not those of the report: {FIRST}"),
    "result PASSED of what failed": (lambda: forger_of(intact("failing")).signed_statement(set_place("predicate", "result", to="PASSED")), "result", "in-toto's result is PASSED, and the verdict is 'not conformant'"),
    "configuration without the record": (lambda: _payload(_without_configuration(archive.RECORD)), "digest", "'record.zst' is in the archive, and was not signed"),
    "configuration names a member twice": (lambda: _payload(_configuration_twice), "digest", "names a member twice"),
    "configuration names what is not there": (lambda: _payload(_configuration_surplus), "digest", "'invoice.pdf' was signed, and is not in the archive"),
    "configuration with another suite": (lambda: _payload(_configuration_suite), "digest", "the signed digest of the suite is not the one of the environment"),
    "no subjects": (lambda: vendor(lambda f: f.subjects.clear()), "subjects", "names nothing that took part"),
    "subject twice": (lambda: _payload(lambda s: {**s, "subject": [s["subject"][0]] * 2}), "subjects", "names a subject twice"),
    "subject without SHA-256": (lambda: _payload(_set_subject({"md5": "00"})), "subjects", "is no SHA-256"),
    "subject with half a digest": (lambda: vendor(lambda f: f.subjects.append(Subject("artifact/x", "abc"))), "subjects", "the digest of 'artifact/x' is no SHA-256"),
    "another predicate": (lambda: _payload(set_place("predicateType", to="https://slsa.dev/provenance/v1")), "envelope", "predicateType is 'https://slsa.dev/provenance/v1'"),
    "another statement type": (lambda: _payload(set_place("_type", to="https://in-toto.io/Statement/v0.1")), "envelope", "_type is"),
    "format of the future": (lambda: _payload(set_place("predicate", "ucm", "format", to=2)), "format", "has format 2, and this ucm-cts reads 1: install a newer ucm-cts"),
    "field added to the statement": (lambda: _payload(set_place("predicate", "url", to="https://x")), "envelope", "unknown field"),
    "statement as another payload type": (lambda: forger_of(intact()).signed_statement(lambda s: s, "application/json"), "envelope", "is of 'application/json'"),
    "report written anew": (lambda: _reencoded_signed(archive.REPORT, lambda c: c.replace(b"\n", b"\r\n")), "report", "written otherwise"),
    "report with a key twice": (lambda: _reencoded_signed(archive.REPORT, lambda c: c.replace(b"{\n", b'{\n  "product": "Evil",\n', 1)), "report", "written otherwise"),
    "report of another schema version": (lambda: _reencoded_signed(archive.REPORT, lambda c: c.replace(b'"schema_version": 2', b'"schema_version": 9', 1)), "format", "schema version 9"),
    "report nests deep": (lambda: _reencoded_signed(archive.REPORT, lambda _: deep()), "report", "cannot be read"),
    "report is no UTF-8": (lambda: _reencoded_signed(archive.REPORT, lambda c: c.replace(b"Acme", b"Ac\xff\xfe")), "report", "cannot be read"),
    "statement of another product": (lambda: vendor(lambda f: f.change(archive.STATEMENT, set_place("product", to="Other"))), "statement", "the statement is about product 'Other'"),
    "statement swapped for an easier one": (lambda: vendor(_easier_statement), "statement", "the report is of another statement"),
    "statement that does not claim the profile": (lambda: vendor(_without_profile), "statement", "does not claim profile 'container'"),
    "statement with a reading that there is not": (lambda: vendor(_wrong_reading), "statement", "which is no reading of it"),
    "statement without a capability": (lambda: vendor(_without_capability), "statement", "lacks the capability"),
    "statement with endless patience": (lambda: vendor(lambda f: f.change(archive.STATEMENT, set_place("ixit", "patience", to=1e12))), "statement", "declares patience"),
    "statement with an option of its own": (lambda: vendor(lambda f: f.change(archive.STATEMENT, set_place("readings", "mercy", to="yes"))), "statement", "has the reading 'mercy', which there is not"),
    "waiver of no requirement": (lambda: vendor(_waiver(requirement="R-0-0")), "waiver", "'R-0-0', which is no requirement"),
    "waiver without a date": (lambda: vendor(_waiver(expires="never")), "waiver", "expires on 'never', which is no date"),
    "waiver that had expired before": (lambda: vendor(_waiver(expires="2020-01-01")), "waiver", "had expired on 2020-01-01, before the certificate was signed"),
    "models that lead elsewhere": (lambda: vendor(_models({"../../x.xml": "<a/>"})), "models", "'../../x.xml' is no name of a model"),
    "models with a hidden name": (lambda: vendor(_models({".bashrc": "x"})), "models", "'.bashrc' is no name of a model"),
    "models that nobody declares": (lambda: vendor(_models({"a.xml": "<a/>"})), "models", "models that the statement does not declare"),
    "models taken out": (lambda: vendor(lambda f: f.members.pop(archive.MODELS), "with models"), "models", "declares models, and the certificate has none"),
    "environment of another suite": (lambda: vendor(_environment("suite_version", "0.0.9")), "claims", "the environment says '0.0.9'"),
    "environment written anew": (lambda: _reencoded_signed(archive.ENVIRONMENT, lambda c: c + b"\n"), "environment", "written otherwise"),
    "a million scenarios drawn": (lambda: vendor(_setting("drawn", 10**6)), "settings", "drawn = 1000000"),
    "endless systematic suites": (lambda: vendor(_setting("systematic", 99)), "settings", "systematic = 99"),
    "hosts with endless time": (lambda: vendor(_setting("timeout", 1e300)), "settings", "timeout = 1e+300"),
    "made with an older suite": (lambda: vendor(_another_suite), "suite", "it was made with ucm-cts 0.0.9"),
    "made with another build": (lambda: vendor(_environment("suite", "c" * 64)), "suite", "it was made with build cccccccccccc"),
    "made with a changed catalogue": (lambda: vendor(_environment("catalogue", "c" * 64)), "suite", "its catalogue is not the one"),
    "of another specification": (lambda: vendor(_another_specification), "specification", "it is about 'OMG CCM 4.0'"),
    "signed in the future": (lambda: vendor(claimed(issued="2199-01-01T00:00:00+00:00")), "time", "signed in the future"),
    "signed at no time": (lambda: vendor(claimed(issued="yesterday")), "time", "'yesterday' is no moment"),
    "signed before it ran": (lambda: vendor(claimed(issued="2026-10-01T10:00:00+00:00")), "time", "after the certificate was signed"),
    "signed before the run ended": (lambda: vendor(lambda f: f.report(seconds=90 * 86_400.0)), "time", "so that it was signed before its end"),
    "run that took less than nothing": (lambda: vendor(lambda f: f.report(seconds=-1.0)), "time", "less than nothing"),
    "clause that took less than nothing": (lambda: vendor(lambda f: f.report(seconds_by_clause={"10": -1.0})), "time", "less than nothing"),
    "requirement that took for ever": (lambda: vendor(lambda f: f.requirement(FIRST, seconds=1e300)), "time", "more than a year"),
    "ran at no time": (lambda: vendor(lambda f: f.report(started="noon")), "time", "'noon' is no moment at which the run began"),
    "challenge in a self-declared one": (lambda: vendor(claimed(assurance="self-declared"), "challenged"), "challenge", "and says that it is self-declared"),
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
    forger.change(archive.STATEMENT, set_place("profiles", to=["core"]))


def _wrong_reading(forger: Forger) -> None:
    forger.change(archive.STATEMENT, lambda s: set_place("readings", next(iter(s["readings"])), to="as I like")(s))


def _without_capability(forger: Forger) -> None:
    def change(statement: Any) -> Any:
        statement["capabilities"].pop(next(iter(statement["capabilities"])))
        return statement

    forger.change(archive.STATEMENT, change)


@pytest.mark.parametrize("way", VENDORS)
def test_what_a_vendor_signs_and_did_not_happen_is_refused(way: str) -> None:
    make, check, detail = VENDORS[way]
    verified = verify(make())
    assert_refused(verified, check, detail)
    assert not {problem.check for problem in verified.problems} & {"signature", "key"}
