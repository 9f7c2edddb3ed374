"""What the sandbox costs: ``python -m ucm_cts.harness.bench.isolation``. With and without it in turns, so that both meet the same machine."""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

from rich.console import Console
from rich.table import Table

from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.hosts import Hosts
from ucm_cts.harness.hosting.locate import Endpoint, locate
from ucm_cts.harness.hosting.sandbox import why_none
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.statement.applicability import purposes_for

_FRESH = 20
"""How many hosts one template gives for a measurement."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--adapter", default="reference-py")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    console = Console()
    if why_none():
        console.print(f"nothing to measure: {why_none()}")
        return
    table = Table("what", "without, ms", "in the sandbox, ms", "more, ms", "more, %")
    for what, measured in (("first host", _first_host), ("fresh host", _fresh_host), ("run, container", _run)):
        without, within = _in_turns(measured, options.adapter, options.rounds)
        more = within - without
        table.add_row(what, f"{without:.1f}", f"{within:.1f}", f"{more:.1f}", f"{100 * more / without:.1f}")
    console.print(table)


def _in_turns(measured: Callable[[Endpoint], float], adapter: str, rounds: int) -> tuple[float, float]:
    """The medians in milliseconds, without and with the sandbox. Each comes first in every other round."""
    seconds: dict[bool, list[float]] = {False: [], True: []}
    for number in range(rounds):
        for sandbox in (False, True) if number % 2 else (True, False):
            seconds[sandbox].append(measured(locate(adapter, sandbox=sandbox)))
    return 1000 * statistics.median(seconds[False]), 1000 * statistics.median(seconds[True])


def _first_host(endpoint: Endpoint) -> float:
    began = time.perf_counter()
    with Hosts(endpoint) as hosts:
        assert hosts.welcome
        return time.perf_counter() - began


def _fresh_host(endpoint: Endpoint) -> float:
    """A host that an existing template forks, until it has said welcome."""
    with Hosts(endpoint) as hosts:
        assert hosts.welcome
        began = time.perf_counter()
        for _ in range(_FRESH):
            hosts.start_fresh()
        return (time.perf_counter() - began) / _FRESH


def _run(endpoint: Endpoint) -> float:
    statement = default_statement()
    began = time.perf_counter()
    with Driver(endpoint, 1) as driver:
        campaign = Campaign(driver, "container", (), statement)
        for _ in campaign.check(purposes_for(statement, "container", 0)):
            pass
        return time.perf_counter() - began


if __name__ == "__main__":
    main()
