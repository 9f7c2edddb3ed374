"""The kill record: one line a mutant, variant and cheat of a whole self-test. It is under version control; its pages are not."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, read_text
from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.selftest.matrix import Matrix


class SelfTest(Value, frozen=True, tag="self-test", tag_field="kind"):
    """The self-test itself.

    ``suite_version``: version of the suite.
    ``testable``: how many requirements can be broken.
    ``unproved``: those that no killed mutant breaks.
    """

    suite_version: str
    testable: int
    unproved: tuple[str, ...] = ()


class Mutant(Value, frozen=True, tag="mutant", tag_field="kind"):
    """One mutant.

    ``name``: its name.
    ``killed``: it was killed.
    ``requirements``: those that it breaks.
    ``missed``: those of them that it did not fail as it must.
    ``spills``: requirements that it fails although it does not break them.
    ``further``: requirements that its defect breaks besides those that it declares.
    """

    name: str
    killed: bool
    requirements: tuple[str, ...]
    missed: tuple[str, ...] = ()
    spills: tuple[str, ...] = ()
    further: tuple[str, ...] = ()


class Variant(Value, frozen=True, tag="variant", tag_field="kind"):
    """One conformant variant. ``failed`` are the requirements that it was wrongly failed for."""

    name: str
    spared: bool
    failed: tuple[str, ...] = ()


class Cheat(Value, frozen=True, tag="cheat", tag_field="kind"):
    """One cheating adapter. ``requirements`` are those that must fail; none if no observation can show the cheat."""

    name: str
    found_out: bool
    requirements: tuple[str, ...] = ()


Line = SelfTest | Mutant | Variant | Cheat


class KillRecord(msgspec.Struct, frozen=True):
    """A whole self-test, by the kinds of its lines."""

    self_test: SelfTest
    mutants: tuple[Mutant, ...]
    variants: tuple[Variant, ...]
    cheats: tuple[Cheat, ...]

    @property
    def is_proved(self) -> bool:
        """Is each mutant killed without spills and each requirement proved, each variant spared, each cheat found out?"""
        return not self.self_test.unproved and all(
            (
                *(mutant.killed and not mutant.spills for mutant in self.mutants),
                *(variant.spared for variant in self.variants),
                *(cheat.found_out for cheat in self.cheats),
            )
        )


def read_matrix(path: Path) -> Matrix:
    """The kill matrix in the file ``path``. Raises ``DocumentError``, also if the self-test was not a whole one."""
    try:
        matrix = msgspec.json.decode(read_text(path), type=Matrix)
    except msgspec.MsgspecError as error:
        raise DocumentError(path, None, f"is no kill matrix ({error}); ucm-cts selftest writes it") from None
    if not matrix.is_all or matrix.left_out:
        raise DocumentError(path, None, "is the matrix of a part of the self-test; run ucm-cts selftest without names")
    return matrix


def file_name(matrix: Matrix) -> str:
    """The file of the record: self-tests of frameworks and of tool chains have one each."""
    of_frameworks = {r.id for r in load_requirements() if r.profile in PARTS["core"]}
    return "frameworks.jsonl" if of_frameworks.intersection(matrix.testable) else "toolchains.jsonl"


def to_lines(matrix: Matrix) -> bytes:
    """The record of ``matrix``."""
    return b"".join(msgspec.json.encode(line) + b"\n" for line in _lines(matrix))


def _lines(matrix: Matrix) -> Iterator[Line]:
    yield SelfTest(matrix.suite_version, len(matrix.testable), tuple(sorted(matrix.unproved)))
    for mutant in sorted(matrix.mutants, key=lambda m: m.name):
        spills = tuple(sorted({kill.requirement for kill in mutant.spills}))
        further = tuple(sorted({kill.requirement for kill in mutant.further}))
        yield Mutant(mutant.name, mutant.is_killed, mutant.breaks, mutant.survives, spills, further)
    for variant in sorted(matrix.variants, key=lambda v: v.name):
        yield Variant(variant.name, variant.is_spared, tuple(sorted({kill.requirement for kill in variant.failed})))
    for cheat in sorted(matrix.cheats, key=lambda c: c.name):
        yield Cheat(cheat.name, cheat.is_as_it_should, cheat.due)


def read_record(path: Path) -> KillRecord:
    """The record in the file ``path``. Raises ``DocumentError``."""
    decoder = msgspec.json.Decoder(Line)
    lines: list[Line] = []
    for number, text in enumerate(read_text(path).splitlines(), 1):
        try:
            lines.append(decoder.decode(text))
        except msgspec.MsgspecError as error:
            raise DocumentError(path, number, f"is no line of a kill record: {error}; write it anew") from None
    heads = [line for line in lines if isinstance(line, SelfTest)]
    if len(heads) != 1:
        raise DocumentError(path, None, "has not just one line of the kind 'self-test'; write it anew")
    return KillRecord(
        heads[0],
        tuple(line for line in lines if isinstance(line, Mutant)),
        tuple(line for line in lines if isinstance(line, Variant)),
        tuple(line for line in lines if isinstance(line, Cheat)),
    )
