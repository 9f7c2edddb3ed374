"""Certificates that nobody touched stand, and say what they are."""

from __future__ import annotations

import pytest
from forging import INTACT, intact, trust, verify

AUDITORS = trust("tuev")


@pytest.mark.parametrize("kind", INTACT)
def test_no_intact_certificate_is_refused(kind: str) -> None:
    verified = verify(intact(kind), auditors=AUDITORS)
    assert verified.problems == ()
    assert verified.product == "Acme UCM"
    assert verified.report is not None
    assert verified.uncovered.untestable
