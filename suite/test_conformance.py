"""The suite under pytest: one node a test purpose. ``ucm_cts.harness.cli.pytest_suite`` gives the purposes, named by clause."""

from __future__ import annotations

from typing import Any

pytest_plugins = ["ucm_cts.harness.cli.pytest_suite"]


def test_clause(purpose: Any, check: Any) -> None:
    """The implementation under test has no failure in any scenario of the purpose."""
    check(purpose)


def test_drawn_scenarios(check_drawn: Any) -> None:
    """Nor in scenarios that are drawn for this run, or failed in the last one."""
    check_drawn()
