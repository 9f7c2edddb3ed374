"""What people read of a certificate that another suite made, and of one whose models cannot be read."""

from __future__ import annotations

from pathlib import Path

import msgspec
from forging import FakeJudged, forger_of, intact, made_report, verify

from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.reading import Contents
from ucm_cts.harness.certificates.telling import told
from ucm_cts.harness.results.statement import Statement


def test_delta_certification_says_what_it_does_not_decide() -> None:
    forger = forger_of(intact())
    first, second, third, *rest = forger.said.requirements
    forger.change(archive.ENVIRONMENT, lambda e: {**e, "suite": "0" * 64})
    forger.report(requirements=(first, second, third, *rest[1:]))  # the old suite did not have one
    today = made_report(
        requirements=(
            msgspec.structs.replace(first, verdict="inconclusive", reason="its condition never arose"),
            msgspec.structs.replace(second, verdict="fail"),
            *rest,
        ),
        verdict="not conformant",
    )
    verified = verify(forger.resigned(), suite="newer", judge=lambda *_: FakeJudged(today))
    assert verified.stands
    lines = "\n".join(told(verified, "x.ucmcert"))
    for text in (
        "today's verdict would be 'not conformant'",
        "2 requirements would change",
        f"{first.id}: pass -> inconclusive",
        f"{second.id}: pass -> fail",
        "1 are new",
        f"{rest[0].id}: pass",
        "1 are gone",
        f"{third.id}: it was pass",
        "whether the record has all scenarios",
        "what scenarios, or models, would show",
        f"1 requirements that the old traces do not show: {first.id}",
    ):
        assert text in lines, lines


def test_models_that_cannot_be_read_are_told_as_a_problem() -> None:
    def judge(_: Contents, statement: Statement, __: bool) -> FakeJudged:
        raise DocumentError(Path(statement.folder) / "core.xml", 1, "has a document type")

    (problem,) = verify(intact("with models"), judge=judge).problems
    assert problem.check == "models"
    assert problem.detail == "a model of the certificate cannot be used: core.xml:1: has a document type"
