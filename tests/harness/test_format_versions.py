"""What programs read has a number, and no other form may have the same number."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

import pytest

from ucm_cts.adapters.contract.json_schema import schemas_of
from ucm_cts.adapters.contract.messages import PROTOCOL, protocol_schema
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Event
from ucm_cts.harness.certificates import contents
from ucm_cts.harness.certificates.challenges import Challenge, Challenged, Commitment
from ucm_cts.harness.execution import record
from ucm_cts.harness.publishing import index
from ucm_cts.harness.report import json_report
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.toolchains.recording import ToolChainRecord

PUBLISHED: dict[str, dict[str, str]] = json.loads(Path(__file__).with_name("format_versions.json").read_text())
"""The digest of each form by its number. Numbers that were published stay, with their digests."""


FORMS: dict[str, tuple[int, Any]] = {
    "report.json": (json_report.SCHEMA_VERSION, json_report.schema()),
    "protocol": (PROTOCOL, protocol_schema()),
    "index.json": (index.SCHEMA_VERSION, json.loads(index.schema())),
    "record of a framework": (record.FORMAT, [*schemas_of((record.Heading, Event, Scenario, record.AnyEntry))]),
    "certificate": (
        contents.FORMAT,
        [
            *schemas_of(
                (
                    *(contents.SignedStatement, contents.Environment, Statement, tuple[KnownFailure, ...]),
                    *(Commitment, Challenge, Challenged, ToolChainRecord),
                )
            )
        ],
    ),
}


def without_texts(schema: Any) -> Any:
    """``schema`` without what is only for people, and without its own number."""
    if isinstance(schema, dict):
        texts = {k for k in ("$id", "title", "description") if isinstance(schema.get(k), str)}
        return {key: without_texts(value) for key, value in schema.items() if key not in texts}
    return [without_texts(one) for one in schema] if isinstance(schema, list) else schema


def digest_of(schema: Any) -> str:
    return hashlib.sha256(json.dumps(without_texts(schema), sort_keys=True).encode()).hexdigest()[:16]


@pytest.mark.parametrize("name", FORMS)
def test_a_form_that_changes_gets_another_number(name: str) -> None:
    version, schema = FORMS[name]
    assert PUBLISHED[name].get(str(version)) == digest_of(schema), (
        f"the form of {name} is another one than that of number {version}: raise its number, and add the digest "
        f"{digest_of(schema)} to format_versions.json; programs that read {version} must not meet it"
    )


def test_two_numbers_are_two_forms() -> None:
    for digests in PUBLISHED.values():
        assert len(set(digests.values())) == len(digests)


def test_another_field_is_another_form_and_another_word_about_it_is_not() -> None:
    schema = json_report.schema()
    entry = schema["$defs"]["ReportEntry"]
    before = digest_of(schema)
    entry["description"] = "The report, in other words."
    assert digest_of(schema) == before
    entry["required"].remove("seed")
    assert digest_of(schema) != before
