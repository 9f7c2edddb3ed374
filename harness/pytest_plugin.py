"""``pytest --pyargs ucm_cts.suite --iut ADAPTER``: the same pipeline, one node a test purpose.

Installed as a pytest plugin; it does nothing unless ``ucm_cts.suite`` is collected. The host and the verdicts live as
long as the session; each node runs its purpose's scenarios on them.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from ucm_cts.harness.campaign import Campaign
    from ucm_cts.harness.scripts import TestPurpose


def pytest_addoption(parser: pytest.Parser) -> None:
    """Options of the suite."""
    group = parser.getgroup("ucm-cts", "UCM conformance")
    group.addoption("--iut", metavar="ADAPTER", help="implementation under test, as for 'ucm-cts run'")
    group.addoption("--iut-profile", default="container", help="conformance profile (default: container)")
    group.addoption("--iut-seed", type=int, help="repeat a run: names and payloads are drawn from it")
    group.addoption("--iut-out", metavar="DIR", help="write report.html, report.json and junit.xml there")
    group.addoption("--iut-in-process", action="store_true", help="no host process: for debuggers and sanitizers")


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Each suite module asks for the purposes of its clauses: ``CLAUSES`` is a tuple of prefixes."""
    if "purpose" not in metafunc.fixturenames or not hasattr(metafunc.module, "CLAUSES"):
        return
    from ucm_cts.harness.purposes import PROFILES, load_purposes

    profile = metafunc.config.getoption("--iut-profile")
    if profile not in PROFILES:
        raise pytest.UsageError(f"there is no profile '{profile}'; there is {', '.join(PROFILES)}")
    chosen = [p for p in load_purposes(profile) if _belongs(p, metafunc.module.CLAUSES)]
    metafunc.parametrize("purpose", chosen, ids=[p.id.replace(" ", "-") for p in chosen])


def _belongs(purpose: TestPurpose, clauses: tuple[str, ...]) -> bool:
    return any(purpose.clause == c or purpose.clause.startswith(c + ".") for c in clauses)


@pytest.fixture(scope="session")
def campaign(request: pytest.FixtureRequest) -> Iterator[Campaign]:
    """The run against ``--iut``; its report is written when the session ends."""
    from contextlib import ExitStack
    from pathlib import Path

    from ucm_cts.harness.campaign import Campaign
    from ucm_cts.harness.commands import make_folder, write
    from ucm_cts.harness.driver import Driver, Limits
    from ucm_cts.harness.hosts import HostUnavailable
    from ucm_cts.harness.locate import WrongUse, locate

    config = request.config
    adapter = config.getoption("--iut")
    if not adapter:
        message = "say which implementation to test: --iut ADAPTER, for instance --iut reference-py"
        pytest.exit(f"ucm-cts: {message}", returncode=2)
    seed = config.getoption("--iut-seed")
    out = config.getoption("--iut-out")
    drawn = seed if seed is not None else random.SystemRandom().randrange(2**32)
    with ExitStack() as cleanup:
        try:
            driver = cleanup.enter_context(
                Driver(locate(adapter, config.getoption("--iut-in-process")), drawn, Limits())
            )
            _ = driver.disguise  # asks who is there
            if out:
                make_folder(Path(out))
        except (WrongUse, HostUnavailable) as error:
            pytest.exit(f"ucm-cts: {error}", returncode=2)
        running = Campaign(driver, config.getoption("--iut-profile"))
        yield running
        if out:
            for _ in running.shorten():
                pass
            write(running.report(), Path(out))


@pytest.fixture
def check(campaign: Campaign) -> object:
    """Run a purpose and fail with what was expected and what was observed."""

    def run(purpose: TestPurpose) -> None:
        from ucm_cts.harness.report.sequence_text import failure_text

        for checked in campaign.check([purpose]):
            stories = []
            for finding, execution in checked.failures[:3]:
                if finding is not None:
                    head = f"{finding.requirement}: expected {finding.expected}; observed {finding.observed}"
                    stories.append(f"{head}\n{failure_text(finding, execution)}")
                elif execution.incident is not None:
                    stories.append(
                        f"{execution.incident.kind}: {execution.incident.detail}\n{execution.incident.stacks}"
                    )
            if stories:
                more = len(checked.failures) - len(stories)
                pytest.fail("\n\n".join(stories) + (f"\n\nand {more} more" if more > 0 else ""), pytrace=False)

    return run
