"""Are native mutants found out, and how often? ``python -m ucm_cts.harness.selftest.native --runs 20``

Each mutant is run through the ordinary pipeline under its vendor's statement, for the clauses whose test purposes are to find
it out, with another seed each time.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from ucm_cts.adapters.derived_cpp import COMMAND, NativeMutant, being, native_mutants
from ucm_cts.adapters.reference_cpp import STATEMENT
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.results import Report
from ucm_cts.harness.running.campaign import Campaign
from ucm_cts.harness.running.driver import Driver, Limits
from ucm_cts.harness.stating.applicability import purposes_for
from ucm_cts.harness.stating.files import read_statement
from ucm_cts.harness.stating.statement import Statement, default_statement

LIMITS = Limits(seconds=2, incident_seconds=20)
"""A mutant that hangs is not waited for longer."""

OFTEN_ENOUGH = 0.95
"""In this part of the runs a mutant must be found out."""


@dataclass
class Found:
    """In how many ``runs`` a mutant was found out, which requirements failed how often, and what else came out."""

    mutant: NativeMutant
    runs: int = 0
    times: int = 0
    failed: Counter[str] = field(default_factory=Counter)
    incidents: Counter[str] = field(default_factory=Counter)

    def add(self, report: Report) -> None:
        """One more run."""
        failed = {result.id for result in report.requirements if result.verdict == "fail"}
        due = set(self.mutant.requirements)
        self.runs += 1
        self.times += bool(due & failed) if self.mutant.is_rare else due <= failed
        self.failed.update(failed)
        self.incidents.update({item.incident.kind for item in report.incidents})

    @property
    def spills(self) -> set[str]:
        """Requirements that failed and are not broken by the defect."""
        return set(self.failed) - {*self.mutant.requirements, *self.mutant.also}

    @property
    def is_well(self) -> bool:
        """Was it found out often enough, and for nothing else?"""
        return self.times >= OFTEN_ENOUGH * self.runs and not self.spills


def statement_of(readings: Mapping[str, str]) -> Statement:
    """What is stated of the C++ reference framework, with these readings; its models are not looked at."""
    known, own = default_statement(), read_statement(STATEMENT)
    return msgspec.structs.replace(known, readings={**known.readings, **own.readings, **readings})


def run_once(
    mutant: NativeMutant, seed: int, command: Path = COMMAND, limits: Limits = LIMITS, beginning: str = ""
) -> Report:
    """One run of the purposes that are to find ``mutant`` out, of those whose names have this ``beginning``."""
    statement = statement_of(mutant.readings)
    purposes = [
        purpose
        for purpose in purposes_for(statement, "core")
        if purpose.clause.startswith(mutant.clauses) and purpose.id.startswith(beginning)
    ]
    with being(mutant.name), Driver(locate(str(command)), seed, limits) as driver:
        campaign = Campaign(driver, "core", statement=statement)
        for _ in campaign.check(purposes):
            pass
        return campaign.report()


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m ucm_cts.harness.selftest.native", description=__doc__)
    parser.add_argument("names", metavar="NAME", nargs="*", help="native mutants; all of them otherwise")
    parser.add_argument("--runs", type=int, default=1, help="runs of each (default: 1)")
    parser.add_argument("--command", type=Path, default=COMMAND, help="the executable with the mutants")
    options = parser.parse_args()
    try:
        known = native_mutants(options.command)
    except OSError as error:
        parser.error(f"{options.command} cannot be run ({error.strerror}); it is part of an installed ucm-cts")
    unknown = set(options.names) - set(known)
    if unknown:
        parser.error(f"there is no native mutant {min(unknown)}; there are {', '.join(known)}")
    well = True
    for name in options.names or known:
        found = Found(known[name])
        for seed in range(1, options.runs + 1):
            found.add(run_once(known[name], seed, options.command))
        well = well and found.is_well
        spilled = f"; also fails {', '.join(sorted(found.spills))}" if found.spills else ""
        times = ", ".join(f"{requirement} {n}" for requirement, n in sorted(found.failed.items()))
        met = ", ".join(f"{kind} {n}" for kind, n in sorted(found.incidents.items()) if kind != "untried")
        print(f"{name}: found out in {found.times} of {found.runs} ({times or 'nothing fails'}; {met or 'no incident'}){spilled}",
              flush=True)  # fmt: skip
    sys.exit(0 if well else 1)


if __name__ == "__main__":
    main()
