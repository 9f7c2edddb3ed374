"""The kill matrix: which mutant fails which requirement, and whether for the right reason."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence

from ucm_cts.adapters.contract.value import Value

MOST_FURTHER = 1
"""The largest permitted average of requirements that a mutant fails besides those that it declares."""


class Kill(Value, frozen=True):
    """A requirement that a mutant failed, and the finding that shows it best.

    ``names_the_place``: the finding names events in which the mutant differs from the framework it was made from.
    ``looked_at``: the number of findings for this requirement that were compared.
    """

    requirement: str
    scenario: str
    rule: str
    expected: str
    observed: str
    events: tuple[int, ...]
    names_the_place: bool
    looked_at: int

    @property
    def text(self) -> str:
        """Where it failed, and why."""
        return f"{self.requirement} in {self.scenario}: expected {self.expected}; observed {self.observed}"


class MutantResult(Value, frozen=True):
    """The result of one mutant.

    ``name``: its name.
    ``lie``: its defect, one sentence.
    ``clause``: that of the requirement that it breaks first.
    ``breaks``: the requirements that it must fail.
    ``also``: the requirements that the same defect breaks too.
    ``kills``: the requirements that failed.
    ``incidents``: kind and detail of each.
    ``scenarios``: how many were run.
    ``seconds``: duration.
    ``trouble``: why it could not be judged, such as a host that did not start; empty if it was.
    ``is_rare``: its defect shows rarely, so one failed requirement is enough.
    ``wrongly_said``: findings whose text is wrong, one of each property, and what is wrong with it.
    """

    name: str
    lie: str
    clause: str
    breaks: tuple[str, ...]
    also: tuple[str, ...]
    kills: tuple[Kill, ...]
    incidents: tuple[str, ...]
    scenarios: int
    seconds: float
    trouble: str = ""
    is_rare: bool = False
    wrongly_said: tuple[str, ...] = ()

    @property
    def survives(self) -> tuple[str, ...]:
        """The requirements that it was to fail, and did not fail for the right reason. Of a rare defect one is enough."""
        failed = {kill.requirement for kill in self.kills if kill.names_the_place}
        if self.is_rare and failed.intersection(self.breaks):
            return ()
        return tuple(requirement for requirement in self.breaks if requirement not in failed)

    @property
    def is_killed(self) -> bool:
        """Did each requirement it violates fail, with a finding that names the right events?"""
        return not self.trouble and not self.survives

    @property
    def spills(self) -> tuple[Kill, ...]:
        """What it fails although its defect does not break it: no finding names a place where it differs from its original."""
        return tuple(kill for kill in self._others if not kill.names_the_place)

    @property
    def further(self) -> tuple[Kill, ...]:
        """What it fails besides, because of its defect: the findings name places where it differs from its original."""
        return tuple(kill for kill in self._others if kill.names_the_place)

    @property
    def _others(self) -> tuple[Kill, ...]:
        return tuple(kill for kill in self.kills if kill.requirement not in (*self.breaks, *self.also))


class CheatResult(Value, frozen=True):
    """The result of a cheating adapter: ``due`` are the requirements that must fail, none if no observation can show the cheat."""

    name: str
    lie: str
    due: tuple[str, ...]
    came_out: tuple[str, ...]
    is_as_it_should: bool
    seconds: float
    trouble: str = ""


class VariantResult(Value, frozen=True):
    """The result of one conformant variant: ``failed`` are the requirements that it was wrongly failed for."""

    name: str
    failed: tuple[Kill, ...]
    incidents: tuple[str, ...]
    scenarios: int
    seconds: float
    trouble: str = ""

    @property
    def is_spared(self) -> bool:
        """Was nothing held against it?"""
        return not (self.failed or self.incidents or self.trouble)


class Matrix(Value, frozen=True):
    """The result of one self-test.

    ``suite_version``: version of the suite.
    ``seed``: of the run.
    ``seconds``: duration.
    ``testable``: the requirements that a property checks and that can be broken.
    ``mutants``: by name.
    ``variants``: by name.
    ``whole``: all scenarios were run on each subject.
    ``cheats``: by name.
    ``left_out``: how many subjects were not run, although they were selected.
    ``is_all``: all subjects were selected.
    """

    suite_version: str
    seed: int
    seconds: float
    testable: tuple[str, ...]
    mutants: tuple[MutantResult, ...]
    variants: tuple[VariantResult, ...]
    whole: bool
    cheats: tuple[CheatResult, ...] = ()
    left_out: int = 0
    is_all: bool = False

    @property
    def unproved(self) -> tuple[str, ...]:
        """The requirements that no killed mutant breaks, if all mutants were examined."""
        return tuple(r for r, killers in self.killers.items() if not killers) if self.is_all else ()

    @property
    def undetected(self) -> tuple[CheatResult, ...]:
        """The cheats that were not detected."""
        return tuple(cheat for cheat in self.cheats if not cheat.is_as_it_should)

    @property
    def survivors(self) -> tuple[MutantResult, ...]:
        """The mutants that were not killed."""
        return tuple(mutant for mutant in self.mutants if not mutant.is_killed)

    @property
    def spilling(self) -> tuple[MutantResult, ...]:
        """The mutants that fail requirements which they do not break."""
        return tuple(mutant for mutant in self.mutants if mutant.spills)

    @property
    def wronged(self) -> tuple[VariantResult, ...]:
        """The conformant variants that something was held against."""
        return tuple(variant for variant in self.variants if not variant.is_spared)

    @property
    def wrong(self) -> list[tuple[str, str]]:
        """All defects of the self-test: the name of a subject or a requirement, and the problem."""
        return [
            *((m.name, f"survives ({m.trouble or ', '.join(m.survives)}): {m.lie}") for m in self.survivors),
            *((m.name, f"also fails {kill.text}") for m in self.spilling for kill in m.spills),
            *(
                [("all mutants", f"fail {self.further_on_average:.2f} further requirements on average")]
                if self.further_on_average > MOST_FURTHER
                else []
            ),
            *((m.name, f"has a finding that {text}") for m in self.mutants for text in m.wrongly_said),
            *(
                (c.name, f"cheats, and {', '.join(c.came_out) or 'nothing'} comes out: {c.trouble or c.lie}")
                for c in self.undetected
            ),
            *(
                (variant.name, f"is conformant and fails {kill.text}")
                for variant in self.wronged
                for kill in variant.failed
            ),
            *((r, "is broken by no mutant that was killed") for r in self.unproved),
            *((v.name, f"is conformant: {v.trouble or ', '.join(v.incidents)}") for v in self.wronged if not v.failed),
        ]

    @property
    def killers(self) -> Mapping[str, Sequence[str]]:
        """For each testable requirement the mutants that failed it as they should."""
        found: dict[str, list[str]] = {requirement: [] for requirement in self.testable}
        for mutant in self.mutants:
            for requirement in set(mutant.breaks) - set(mutant.survives):
                found.setdefault(requirement, []).append(mutant.name)
        return found

    @property
    def is_proved(self) -> bool:
        """Are all mutants killed without spills, of each requirement one, all variants spared, and all cheats found out?"""
        badly_said = any(mutant.wrongly_said for mutant in self.mutants)
        wrong = self.survivors or self.spilling or badly_said or self.wronged or self.undetected or self.unproved
        return not (wrong or self.left_out or self.further_on_average > MOST_FURTHER)

    @property
    def further_on_average(self) -> float:
        """How many requirements a mutant fails besides those that it declares, on average."""
        return sum(len(mutant.further) for mutant in self.mutants) / max(1, len(self.mutants))


def by_clause(mutants: Iterable[MutantResult]) -> dict[str, list[MutantResult]]:
    """The mutants by the clause of the requirement that each breaks first."""
    sorted_out: dict[str, list[MutantResult]] = defaultdict(list)
    for mutant in mutants:
        sorted_out[mutant.clause].append(mutant)
    return dict(sorted_out)
