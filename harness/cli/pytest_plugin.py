"""``pytest --pyargs ucm_cts.suite --iut ADAPTER``: the options, and checks of their use before anything runs.

Installed as a pytest plugin; it loads nothing else. The suite's test module loads ``pytest_suite``, which does the rest.
"""

from __future__ import annotations

import argparse
import math

import pytest

_PROFILE = "container"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Options of the suite."""
    group = parser.getgroup("ucm-cts", "UCM conformance")
    group.addoption("--iut", metavar="ADAPTER", help="implementation under test, as for 'ucm-cts run'")
    group.addoption("--iut-profile", default=_PROFILE, help="conformance profile (default: container)")
    group.addoption("--iut-seed", type=int, help="repeat a run: names and payloads are drawn from it")
    group.addoption("--iut-out", metavar="DIR", help="write report.html, report.json and junit.xml there")
    group.addoption("--iut-known-failures", metavar="FILE", help="failures expected for now; they count as xfailed")
    group.addoption("--iut-ics", metavar="FILE", help="the vendor's statement, as for 'ucm-cts run'")
    group.addoption("--iut-timeout", type=_seconds, metavar="SECONDS", help="how long a scenario may take (default: 5)")
    group.addoption("--iut-memory", type=int, metavar="MIB", help="how much memory a host may use (default: 1024)")
    group.addoption(
        "--iut-incident-time",
        type=_seconds,
        metavar="SECONDS",
        help="how long crashes and hangs may take (default: 60)",
    )
    group.addoption(
        "--iut-explore",
        default="2s",
        metavar="BUDGET",
        help="how long to draw random scenarios after those of the suite, or how many: 3s, 500scenarios, 0s (default: 2s)",
    )
    group.addoption("--iut-in-process", action="store_true", help="no host process: for debuggers and sanitizers")
    group.addoption("--iut-no-sandbox", action="store_true", help="hosts run as you do, without a sandbox")


def _seconds(text: str) -> float:
    seconds = float(text)
    if not 0 < seconds < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is no number of seconds")
    return seconds


def pytest_configure(config: pytest.Config) -> None:
    """Report wrong use before anything runs."""
    profile = config.getoption("--iut-profile")
    if profile != _PROFILE:
        from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES
        from ucm_cts.harness.catalogue.requirements import in_the_making

        if profile not in FRAMEWORK_PROFILES:
            problem = in_the_making(profile) or f"there is no profile '{profile}'"
            raise pytest.UsageError(f"{problem}; there is {', '.join(FRAMEWORK_PROFILES)}")
    if config.getoption("--iut-ics"):
        from ucm_cts.harness.cli.pytest_suite import statement_of

        statement_of(config)
