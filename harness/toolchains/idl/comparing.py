"""Compares a vendor's IDL with what clause 12 makes of a model: by meaning, so text, order and spelling are free where IDL's are.

One fact reports a missing declaration; further facts about it are not exercised, so one defect is reported once.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from itertools import islice

from ucm_cts.harness.toolchains.differences import Comparison, Difference
from ucm_cts.harness.toolchains.idl.annotations import applied
from ucm_cts.harness.toolchains.idl.facts import FACTS, MISPLACED
from ucm_cts.harness.toolchains.idl.language.reading import Files, read_files
from ucm_cts.harness.toolchains.idl.language.scopes import build
from ucm_cts.harness.toolchains.idl.omniidl import Opinion
from ucm_cts.harness.toolchains.idl.results import NotExercised, Wrong
from ucm_cts.harness.toolchains.idl.standard import standard_differences
from ucm_cts.harness.toolchains.idl.validity import building_blocks, invalid, not_included
from ucm_cts.harness.toolchains.idl.vendor import Vendor
from ucm_cts.reference_models.mapping.idl.declarations import Place
from ucm_cts.reference_models.mapping.idl.expectations import RULE_OF, Declares, Expected, ExpectedIdl

CHECKS = {
    "idl_generated": "Files of IDL are generated for each legal model.",
    "idl_syntax": "The generated files are IDL: they can be parsed, nothing is declared twice, and every name means something.",
    "idl_building_blocks": "They use core data types, annotations, basic interfaces and template modules, nothing else of IDL.",
    "idl_types": "Each data type is declared under its name, as the table and the examples of clause 12 have it.",
    "idl_annotations": "The annotations of clause 14 stand where they are needed, with the members and the values they should have.",
    "idl_constants": "Each constant has its name, its type and its value.",
    "idl_interfaces": "Interfaces and exceptions have the operations, parameters, results, fields and ancestors of the model.",
    "idl_modules": "Each module is a module that holds what the model's module holds, a template where abstract types are used.",
    "idl_components": "Component types and implementations are interfaces with their ancestors, attributes and getters.",
    "idl_interactions": "Nothing is made of connectors, patterns, port types, policy definitions, composites and configuration parameters.",
    "idl_equivalents": "Connectors, port types and components that stand beside clause 12's declarations are as clause 9 shows them.",
    "idl_decoration": "Annotations and comments in a model change nothing of what is generated.",
    "idl_standard": "Declarations that clause 12 prints are as printed, wherever they stand.",
}
"""The checks that the catalogue names among its rules, and what each checks."""


def compare(
    expected: ExpectedIdl,
    files: Mapping[str, str],
    readings: Mapping[str, str] = {},
    second_opinion: Callable[[Mapping[str, str]], Opinion] | None = None,
) -> Comparison:
    """Compare the vendor's ``files`` (name to text) with what is ``expected`` of them under the ``readings`` declared.

    ``readings`` maps options of ``suite/interpretations`` to values; what is not named counts as its first value.
    ``second_opinion`` says whether files are IDL in which nothing else is wrong. Never raises.
    """
    read = read_files(files)
    vendor = Vendor(build(read.declarations), expected, readings, bool(read.problems), bool(read.missing))
    exercised: dict[str, int] = {}
    unjudged: dict[str, str] = {}
    differences = list(_of_files(vendor, read, exercised))
    for fact in expected.facts:
        if vendor.is_printed(fact.path):
            continue
        try:
            wrong = FACTS[type(fact)](vendor, fact)
        except NotExercised:
            if read.problems:
                unjudged[fact.requirement] = f"not all files can be read: {read.problems[0]}"
            continue
        found = [_difference(fact, one) for one in wrong]
        placed = {MISPLACED} if isinstance(fact, Declares) and len(fact.path) > 1 else set()
        for requirement in {fact.requirement, *placed, *(one.requirement for one in found)}:
            exercised[requirement] = exercised.get(requirement, 0) + 1
        differences += found
    remarks: tuple[str, ...] = ()
    if second_opinion is not None and not differences:  # omniidl often complains about what is reported already
        second = second_opinion(files)
        differences += [
            _about_files("R-12.1-03", Wrong("IDL", f"omniidl: {one.text}", Place(one.file, one.line)))
            for one in second.problems
            if not (_is_printed_unsigned_long(vendor) and _TOO_LARGE.match(one.text))
        ]
        remarks = (
            "models that omniidl judged, too" if second.verdict != "none" else "models without omniidl's opinion",
        )
    seen = {option: frozenset(values) for option, values in vendor.met.items()}
    return Comparison(exercised, tuple(dict.fromkeys(differences)), seen, unjudged, remarks)


_TOO_LARGE = re.compile(r"Integer literal is too large for unsigned long\b")


def _is_printed_unsigned_long(vendor: Vendor) -> bool:
    """Whether ULONGLONG is unsigned long here, as the table prints it: that has not all its values (interpretation idl-ulonglong)."""
    shown = vendor.met.get("idl-ulonglong", ())
    return vendor.reading("idl-ulonglong") != "unsigned-long-long" and "unsigned-long" in shown


def _difference(fact: Expected, wrong: Wrong) -> Difference:
    requirement = wrong.requirement or fact.requirement
    return Difference(
        requirement,
        RULE_OF[requirement],
        fact.element,
        fact.line,
        wrong.expected,
        wrong.observed,
        wrong.place.file,
        wrong.place.line,
    )


def _of_files(vendor: Vendor, read: Files, exercised: dict[str, int]) -> Iterator[Difference]:
    """What holds of the files for any model."""
    if not read.declarations and not read.problems:
        return
    exercised["R-12.1-03"] = exercised["R-12.1-02"] = 1
    for problem in read.problems:
        yield _about_files("R-12.1-03", Wrong("IDL", problem.text, Place(problem.file, problem.line)))
    of_idl = list(invalid(vendor, read))
    of_idl += [] if of_idl else islice(not_included(vendor, read), 1)
    for requirement, found in (("R-12.1-03", of_idl), ("R-12.1-02", building_blocks(vendor, read))):
        for wrong in found:
            yield _about_files(requirement, wrong)
    for requirement, looked_at in (*applied(vendor, read), *standard_differences(vendor)):
        exercised[requirement] = exercised.get(requirement, 0) + 1
        for wrong in looked_at:
            yield _about_files(requirement, wrong)


def _about_files(requirement: str, wrong: Wrong) -> Difference:
    place = wrong.place
    return Difference(requirement, RULE_OF[requirement], "", 0, wrong.expected, wrong.observed, place.file, place.line)
