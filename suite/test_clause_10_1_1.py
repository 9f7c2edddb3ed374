"""Data types (10.1.1). One node a test purpose."""

from __future__ import annotations

from typing import Any

CLAUSES = ("10.1.1",)


def test_clause(purpose: Any, check: Any) -> None:
    """The implementation under test breaks no rule in any scenario of the purpose."""
    check(purpose)
