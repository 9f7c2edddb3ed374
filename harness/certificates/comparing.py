"""Compares what a certificate says with what its record shows: each difference in a line of its own."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from ucm_cts.harness.certificates.contents import Claims, Environment, SignedStatement, result_of, tests_of
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.report.json_report import Entry, ReportEntry, RequirementEntry
from ucm_cts.harness.results.foreign import one_line

MOST = 12
"""Differences of one kind that are told one by one."""

ON_THE_SIGNERS_WORD = ("seconds", "seconds_by_clause", "started")
"""Fields of a report that no record shows."""


def differences(said: ReportEntry, shown: ReportEntry) -> Iterator[Problem]:
    """What the report ``said`` says otherwise than the one that the record ``shown`` gives."""
    if said.verdict != shown.verdict:
        yield Problem("verdict", f"the certificate says '{said.verdict}', and its record shows '{shown.verdict}'")
    yield from _few(list(_of_requirements(said, shown)))
    for name in ReportEntry.__struct_fields__:
        if name in ("verdict", "requirements", *ON_THE_SIGNERS_WORD):
            continue
        old, new = getattr(said, name), getattr(shown, name)
        if old != new:
            yield Problem("report", f"the report says {_words(name)} {_short(old)}, and the record shows {_short(new)}")


def _of_requirements(said: ReportEntry, shown: ReportEntry) -> Iterator[Problem]:
    old, new = ({entry.id: entry for entry in report.requirements} for report in (said, shown))
    if len(old) != len(said.requirements):
        yield Problem("requirements", "the report has a requirement twice")
    for missing in new.keys() - old.keys():
        yield Problem("requirements", f"{missing} is missing from the report; the profile has it")
    for surplus in old.keys() - new.keys():
        yield Problem("requirements", f"{one_line(surplus, 40)} is in the report, and the profile does not have it")
    for id_ in sorted(old.keys() & new.keys()):
        yield from _of_requirement(old[id_], new[id_])


def _of_requirement(said: RequirementEntry, shown: RequirementEntry) -> Iterator[Problem]:
    if said.verdict != shown.verdict:
        yield Problem("verdict", f"{said.id} is said to be '{said.verdict}', and the record shows '{shown.verdict}'")
    if said.exercised != shown.exercised:
        yield Problem(
            "counts",
            f"{said.id} is said to be exercised {said.exercised} times, and the record shows {shown.exercised}",
        )
    if said.findings != shown.findings:
        yield Problem(
            "findings",
            f"the failures of {said.id} are not those that the record shows: {_first_difference(said, shown)}",
        )
    for name in RequirementEntry.__struct_fields__:
        if name not in ("verdict", "exercised", "findings", "seconds") and getattr(said, name) != getattr(shown, name):
            yield Problem(
                "report",
                f"{said.id} has {_words(name)} {_short(getattr(said, name))}, and the suite gives {_short(getattr(shown, name))}",
            )


def _first_difference(said: RequirementEntry, shown: RequirementEntry) -> str:
    if len(said.findings) != len(shown.findings):
        return f"{len(said.findings)} are said, {len(shown.findings)} shown"
    for old, new in zip(said.findings, shown.findings, strict=True):
        for name in old.__struct_fields__:
            if getattr(old, name) != getattr(new, name):
                return f"{_words(name)} is said to be {_short(getattr(old, name))}, and the record shows {_short(getattr(new, name))}"
    return "they stand in another order"


def inconsistencies(
    signed: SignedStatement, report: ReportEntry | None, environment: Environment | None
) -> Iterator[Problem]:
    """What the signed statement says otherwise than the members that it signs."""
    claims = signed.predicate.ucm
    if signed.predicate.result != result_of(claims.verdict):
        yield Problem("result", f"in-toto's result is {signed.predicate.result}, and the verdict is '{claims.verdict}'")
    if report is not None:
        yield from _unlike(
            claims, report, "report", ("product", "version", "profile", "verdict", "seed", "suite_version", "isolation")
        )
        tests = tests_of(report.requirements)
        given = (signed.predicate.passedTests, signed.predicate.warnedTests, signed.predicate.failedTests)
        for name, old, new in zip(("passedTests", "warnedTests", "failedTests"), given, tests, strict=True):
            if old != new:
                other = sorted(set(old) ^ set(new))
                which = f": {', '.join(map(_id, other[:MOST]))}" if other else ", in another order"
                yield Problem("tests", f"{name} of the signed statement are not those of the report{which}")
    if environment is not None:
        yield from _unlike(claims, environment, "environment", ("specification", "suite_version", "isolation"))


def _unlike(claims: Claims, other: Entry | Environment, what: str, names: tuple[str, ...]) -> Iterator[Problem]:
    for name in names:
        signed, there = getattr(claims, name), getattr(other, name)
        if signed != there:
            yield Problem(
                "claims",
                f"the signed statement says {_words(name)} {_short(signed)}, and the {what} says {_short(there)}",
            )


def _few(problems: list[Problem]) -> Iterator[Problem]:
    """At most ``MOST`` of each kind, and how many more there are."""
    for check in dict.fromkeys(problem.check for problem in problems):
        same = [problem for problem in problems if problem.check == check]
        yield from same[:MOST]
        if len(same) > MOST:
            yield Problem(check, f"and {len(same) - MOST} more of this kind")


def _words(name: str) -> str:
    return name.replace("_", " ")


def _id(text: str) -> str:
    return one_line(text, 40)


def _short(value: object) -> str:
    if isinstance(value, str):
        return f"'{one_line(value, 80)}'"
    if isinstance(value, int | float):
        return str(value)
    try:
        return one_line(msgspec.json.encode(value).decode(), 120)
    except (msgspec.MsgspecError, UnicodeEncodeError):
        return "something else"
