"""Counts how often native mutants are killed: ``python -m ucm_cts.harness.selftest.native --runs 20``.

Their defects depend on chance, so each is run several times, with another seed each time.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from ucm_cts.adapters.mutants.cpp import COMMAND, native_mutants
from ucm_cts.harness.selftest.matrix import MutantResult
from ucm_cts.harness.selftest.trials import Thoroughness, examine_mutant, native_subject

OFTEN_ENOUGH = 0.95
"""The part of the runs in which a mutant must be killed."""


@dataclass
class Found:
    """The results of a mutant's ``runs``: kills, failures by requirement, incidents and spills."""

    runs: int = 0
    times: int = 0
    failed: Counter[str] = field(default_factory=Counter)
    incidents: Counter[str] = field(default_factory=Counter)
    spills: set[str] = field(default_factory=set)

    def add(self, result: MutantResult) -> None:
        """One more run."""
        self.runs += 1
        self.times += result.is_killed
        self.failed.update(kill.requirement for kill in result.kills)
        self.incidents.update({incident.partition(":")[0] for incident in result.incidents})
        self.spills.update(kill.requirement for kill in result.spills)

    @property
    def is_well(self) -> bool:
        """Was it killed often enough, and for nothing else?"""
        return self.times >= OFTEN_ENOUGH * self.runs and not self.spills

    def line(self, name: str) -> str:
        """One line."""
        spilled = f"; also fails {', '.join(sorted(self.spills))}" if self.spills else ""
        times = ", ".join(f"{requirement} {n}" for requirement, n in sorted(self.failed.items()))
        met = ", ".join(f"{kind} {n}" for kind, n in sorted(self.incidents.items()) if kind != "untried")
        became = f"({times or 'nothing fails'}; {met or 'no incident'})"
        return f"{name}: found out in {self.times} of {self.runs} {became}{spilled}"


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
        found = Found()
        for seed in range(1, options.runs + 1):
            found.add(examine_mutant(native_subject(known[name], options.command), Thoroughness(seed)))
        well = well and found.is_well
        print(found.line(name), flush=True)
    sys.exit(0 if well else 1)


if __name__ == "__main__":
    main()
