"""The results of a certificate in EARL 1.0, as JSON-LD whose context is in the file. Names of things are links within the site."""

from __future__ import annotations

import msgspec

from ucm_cts.harness.publishing.certificate import Certificate
from ucm_cts.harness.report.order import Shown, shown
from ucm_cts.harness.results.foreign import clean

OUTCOMES: dict[Shown, str] = {
    "pass": "earl:passed",
    "fail": "earl:failed",
    "not followed": "earl:failed",
    "inconclusive": "earl:cantTell",
    "error": "earl:cantTell",
    "not applicable": "earl:inapplicable",
}

_CONTEXT = {
    "earl": "http://www.w3.org/ns/earl#",
    "dct": "http://purl.org/dc/terms/",
    "foaf": "http://xmlns.com/foaf/0.1/",
    "doap": "http://usefulinc.com/ns/doap#",
    "xsd": "http://www.w3.org/2001/XMLSchema#",
    "id": "@id",
    "type": "@type",
    "title": "dct:title",
    "description": "dct:description",
    "version": "doap:revision",
    "identifier": "dct:identifier",
    "name": "foaf:name",
    "date": {"@id": "dct:date", "@type": "xsd:dateTime"},
    "partOf": {"@id": "dct:isPartOf", "@type": "@id"},
    "mainAssertor": {"@id": "earl:mainAssertor", "@type": "@id"},
    "member": {"@id": "foaf:member", "@type": "@id"},
    "by": {"@id": "earl:assertedBy", "@type": "@id"},
    "subject": {"@id": "earl:subject", "@type": "@id"},
    "test": {"@id": "earl:test", "@type": "@id"},
    "mode": {"@id": "earl:mode", "@type": "@id"},
    "outcome": {"@id": "earl:outcome", "@type": "@id"},
    "result": "earl:result",
}


def earl(one: Certificate) -> bytes:
    """``certificates/DIGEST.jsonld``: an assertion for each requirement that was asked or cannot be tested."""
    suite = {"id": "#suite", "type": "earl:Software", "title": "UCM-CTS", "version": one.suite_version}
    signers = [
        {"id": f"#signer-{number}", "type": "foaf:Agent", "name": clean(name, 200)}
        for number, name in enumerate(one.signers, 1)
    ]
    assertor = {
        "id": "#assertor", "type": ["earl:Assertor", "foaf:Group"], "mainAssertor": "#suite",
        "member": ["#suite", *(signer["id"] for signer in signers)],
    }  # fmt: skip
    subject = {
        "id": "#subject", "type": "earl:TestSubject", "title": clean(one.product, 200), "version": clean(one.version, 200),
    }  # fmt: skip
    profile = {"id": "#profile", "type": "earl:TestCriterion", "title": f"profile {one.profile}"}
    graph: list[object] = [suite, *signers, assertor, subject, profile]
    for entry in one.result.requirements:
        result = {"type": "earl:TestResult", "outcome": OUTCOMES[shown(entry)]}
        if entry.reason:
            result["description"] = clean(entry.reason, 400)
        graph.append(_assertion(one, entry.id, result))
    asked = {entry.id for entry in one.result.requirements}
    graph += [
        _assertion(one, id_, {"type": "earl:TestResult", "outcome": "earl:untested"})
        for id_ in one.uncovered.untestable
        if id_ not in asked
    ]
    return msgspec.json.encode({"@context": _CONTEXT, "@graph": graph}) + b"\n"


def _assertion(one: Certificate, id_: str, result: dict[str, str]) -> dict[str, object]:
    return {
        "id": f"#{id_}",
        "type": "earl:Assertion",
        "by": "#assertor",
        "subject": "#subject",
        "mode": "earl:automatic",
        "date": one.issued,
        "test": {
            "id": f"../requirements/{id_}.html",
            "type": "earl:TestRequirement",
            "identifier": id_,
            "partOf": "#profile",
        },
        "result": result,
    }
