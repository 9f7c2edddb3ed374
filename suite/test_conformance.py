"""The pytest door: one node a test purpose. The plugin of ``ucm_cts.harness.cli`` fills in the purposes, named by clause."""

from __future__ import annotations

from typing import Any


def test_clause(purpose: Any, check: Any) -> None:
    """The implementation under test has no failure in any scenario of the purpose."""
    check(purpose)
