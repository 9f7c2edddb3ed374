"""Compares suites by the faults they find: ``python -m ucm_cts.harness.purposes.systematic.comparison``.

For each setting the same wrong machines are tried with the systematic suite, with tours, random walks and hypothesis.
"""

from __future__ import annotations

import itertools
import random
import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import click

from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.purposes.systematic.derivation import derive
from ucm_cts.harness.purposes.systematic.faults import Fault, Subject, Tried
from ucm_cts.harness.purposes.systematic.identification import reduced
from ucm_cts.harness.purposes.systematic.machine import Machine
from ucm_cts.harness.purposes.systematic.rivals import hypothesis_walks, random_walks
from ucm_cts.harness.purposes.systematic.settings import Setting, relays, setting
from ucm_cts.harness.purposes.systematic.suites import Suite, hsi, tour, transition_cover, w, wp

READINGS: Mapping[str, str] = {
    "manager-start": "own",
    "manager-get-components": "own",
    "late-add": "refuse",
    "late-connect": "refuse",
    "late-disconnect": "refuse",
    "late-container": "refuse",
    "self-connection": "allowed",
    "start-unconfigured": "refuse",
    "double-start": "noop",
    "stop-when-stopped": "noop",
    "remove-while-ready": "refuse",
    "remove-while-connected": "refuse",
    "remove-provider-in-use": "refuse",
    "second-connect": "refuse",
}
"""What the vendor of the framework in question declares: every choice of the life-cycle table."""

KINDS = ("output", "transfer", "missing state", "extra state", "two faults")

WALK = 1000
"""Steps of a random walk."""

WALKED = f"a random walk of {WALK:,} steps"

FEW = 2000
"""So many pairs of faults are drawn."""

FEWER = 300
"""So many faults of a kind are drawn of the large machine."""

CASES = (("one", 2), ("two", 0), ("two", 1), ("below", 1), ("across", 0), ("across", 1))
"""The compared settings, each with extra states."""


@dataclass(frozen=True)
class Row:
    """The result of one suite of one setting.

    ``suite``: its method.
    ``words``: test words.
    ``inputs``: of all words.
    ``seconds``: to derive it.
    ``states``: that it visits.
    ``transitions``: that it takes.
    ``killed``: faults found, by kind.
    """

    suite: str
    words: int
    inputs: int
    seconds: float
    states: int
    transitions: int
    killed: Mapping[str, int]


@dataclass(frozen=True)
class Comparison:
    """All suites of one setting, and how many wrong machines of each kind they were tried with."""

    setting: Setting
    machine: Machine
    seconds: float
    faults: Mapping[str, int]
    rows: tuple[Row, ...]


def compare(of: Setting, readings: Mapping[str, str], extra: int, seed: int, most: int) -> Comparison:
    """Try wrong machines with all suites; of each kind at most ``most``, drawn."""
    began = time.process_time()
    machine = derive(load_life_cycle(), of, readings)
    if machine.final:
        machine = reduced(machine)
    derived = time.process_time() - began
    subject = Subject(machine)
    faults = wrong_machines(subject, extra, seed, most)
    rows: list[Row] = []
    suites = systematic_suites(machine, extra)
    budget = 0
    for name, make in suites.items():
        rows.append(_row(name, make, subject, faults))
        budget = budget or rows[-1].inputs
    for name, make in {
        WALKED: lambda: random_walks(machine, WALK, seed),
        "random walks, same budget": lambda: random_walks(machine, budget, seed),
        "hypothesis, same budget": lambda: hypothesis_walks(machine, budget, seed),
    }.items():
        rows.append(_row(name, make, subject, faults))
    return Comparison(of, machine, derived, Counter(fault.kind for fault in faults), tuple(rows))


def systematic_suites(machine: Machine, extra: int) -> dict[str, Callable[[], Suite]]:
    """The one whose budget the rivals get comes first."""
    suites = {"tour": lambda: tour(machine)}
    if not machine.final:
        return suites
    return {
        f"HSI, k={extra}": lambda: hsi(machine, extra),
        f"Wp, k={extra}": lambda: wp(machine, extra),
        f"W, k={extra}": lambda: w(machine, extra),
        "transition cover": lambda: transition_cover(machine),
        **suites,
    }


def wrong_machines(subject: Subject, extra: int, seed: int, most: int) -> list[Fault]:
    """Machines of every kind that are truly wrong; of each kind at most ``most``, drawn. Of a machine that nothing ends,
    which is a large one, only output and transfer faults are drawn, alone and in pairs.
    """
    draw = random.Random(seed)
    kinds: tuple[Iterable[Fault], ...]
    if subject.machine.final:
        kinds = (
            subject.output_faults(),
            subject.transfer_faults(),
            subject.missing_states(),
            subject.extra_states(extra),
        )
    else:
        kinds = tuple([subject.drawn(kind, draw) for _ in range(most)] for kind in ("output", "transfer"))
    pairs = subject.two_faults(min(most, FEW), seed)
    return [fault for kind in (*kinds, pairs) for fault in _at_most(most, kind, draw) if subject.is_wrong(fault)]


def _at_most(most: int, faults: Iterable[Fault], draw: random.Random) -> list[Fault]:
    """A uniform sample of a stream that is too long to keep."""
    kept = list(itertools.islice(source := iter(faults), most))
    for seen, fault in enumerate(source, most + 1):
        place = draw.randrange(seen)
        if place < most:
            kept[place] = fault
    return kept


def _row(name: str, make: Callable[[], Suite], subject: Subject, faults: Sequence[Fault]) -> Row:
    began = time.process_time()
    suite = make()
    seconds = time.process_time() - began
    tried = Tried(subject, suite)
    killed = Counter(fault.kind for fault in faults if tried.kills(fault) is not None)
    return Row(name, len(suite), sum(map(len, suite)), seconds, *tried.covered, killed)


def table_of(comparison: Comparison) -> list[str]:
    """The comparison as lines of Markdown: faults killed, of how many."""
    machine = comparison.machine
    kinds = [kind for kind in KINDS if comparison.faults.get(kind)]
    heads = ["suite", "words", "inputs", "s", "states", "transitions", *kinds]
    lines = [
        f"**{comparison.setting.name}**: {comparison.setting.text}; {len(machine.moves)} states, "
        f"{machine.transitions} transitions, derived in {comparison.seconds:.2f} s",
        "",
        _line(heads),
        _line(["---"] + ["--:"] * (len(heads) - 1)),
    ]
    for row in comparison.rows:
        counts = [f"{row.words:,}", f"{row.inputs:,}", f"{row.seconds:.3f}", f"{row.states:,}", f"{row.transitions:,}"]
        killed = [f"{row.killed.get(kind, 0):,} of {comparison.faults[kind]:,}" for kind in kinds]
        lines.append(_line([row.suite, *counts, *killed]))
    return [*lines, ""]


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


@click.command()
@click.option("--seed", type=int, default=1, show_default=True)
@click.option("--most", type=click.IntRange(min=1), default=3_000, show_default=True, help="Wrong machines of a kind.")
@click.option("--undeclared", is_flag=True, help="For a vendor who declares nothing.")
@click.option("--large", is_flag=True, help="Also four components, 33,055 transitions.")
def main(seed: int, most: int, undeclared: bool, large: bool) -> None:
    """Try wrong machines with systematic suites, random walks and hypothesis; print the tables.

    Seconds are of processor time, to make a suite. Exit status 1 if a suite with a guarantee misses a wrong machine, or if
    the tour of four components kills fewer of a kind than a random walk of 1,000 steps.
    """
    readings = {} if undeclared else READINGS
    kept = True
    for name, extra in CASES:
        comparison = compare(setting(name), readings, extra, seed, most)
        click.echo("\n".join(table_of(comparison)))
        kept = kept and keeps_its_guarantee(comparison)
    if large:
        comparison = compare(relays(4), readings, 0, seed, min(most, FEWER))
        click.echo("\n".join(table_of(comparison)))
        kept = kept and keeps_up(comparison)
    raise SystemExit(0 if kept else 1)


def keeps_its_guarantee(comparison: Comparison) -> bool:
    """Do the suites with a guarantee kill all?"""
    guaranteed = [row for row in comparison.rows if row.suite.startswith(("HSI", "Wp", "W,"))]
    kills = [row.killed.get(kind, 0) == n for row in guaranteed for kind, n in comparison.faults.items()]
    return bool(kills) and all(kills)


def keeps_up(comparison: Comparison) -> bool:
    """Does the first suite kill no fewer of any kind than the random walk of 1,000 steps?"""
    first, walk = comparison.rows[0], next(row for row in comparison.rows if row.suite == WALKED)
    return all(first.killed.get(kind, 0) >= walk.killed.get(kind, 0) for kind in comparison.faults)


if __name__ == "__main__":
    main()
