"""Compares the models of clause 10 that a framework ships with the suite's own (``suite/models/core`` and ``extensions``).

``compare(paths, claims, parts)`` takes the framework's files, what its vendor declares of the interpretations of clause 10, and the
parts of 10.2 to 10.5 that it claims. It says of each requirement that a model can show whether it is kept, broken, absent, left out
or unclear, and which readings it met.
"""

from __future__ import annotations

import functools
from collections import ChainMap
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from msgspec.structs import replace as replace_struct

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, read
from ucm_cts.harness.catalogue.requirements import SUITE, load_options, load_requirements
from ucm_cts.harness.models.comparing import Comparing, Conventions, Declaration, Fact, Status
from ucm_cts.harness.models.spellings import Element, read_models

CHECKS = {
    "core_declarations": "Each declaration stands where it belongs, with the kind and the attributes it has in 10.1.",
    "core_parameters": "Core connectors and core policies have no configuration parameters beyond those of port_trace.",
    "core_additions": "Core declarations have nothing inside that 10.1 does not put there.",
    "core_restrictions": "Core modules have neither native types nor attributes of interfaces.",
    "policy_aspects": "The core's policies are there and name their aspects.",
    "no_policy_api": "Passive policies have no port elements.",
    "port_sides": "Who requires an interface and who provides it is as 10.1 tells it.",
    "extension_declarations": "Each declaration of 10.2 to 10.5 is there, with the kind, the attributes and the content it has there.",
}
"""The checks that the catalogue names among its rules, with the declarations that each compares."""


@dataclass(frozen=True)
class ModelResult:
    """The result of the model checks for one requirement; ``expected`` and ``observed`` describe a difference."""

    requirement: str
    check: str
    status: Status
    expected: str = ""
    observed: str = ""


@dataclass(frozen=True)
class Comparison:
    """A result for each requirement that models can show, and the readings met: values by option."""

    results: tuple[ModelResult, ...]
    readings: Mapping[str, frozenset[str]]


class Statement(Value, frozen=True):
    """A requirement that repeats other declarations, or forbids a declaration."""

    requirement: str
    check: str
    of: dict[str, tuple[str, ...]] = {}


class Catalogue(Value, frozen=True):
    """The declarations of 10.1, or of 10.2 to 10.5, and the statements that repeat them."""

    declarations: tuple[Declaration, ...]
    statements: tuple[Statement, ...]


@dataclass(frozen=True, eq=False)
class Models:
    """The suite's own models in one ``folder``, the ``check`` of their declarations, and how they are compared."""

    folder: Path
    check: str
    conventions: Conventions


CORE = SUITE / "models" / "core"

_CORE = Models(
    CORE,
    "core_declarations",
    Conventions(
        "core-root",
        "none",
        {
            "ConfigurationParameter": "R-10.1-02",
            "NativeType": "R-10.1.1-02",
            "Attribute": "R-10.1.1-05",
            "": "R-10.1-03",
        },
    ),
)
_EXTENSIONS = Models(
    SUITE / "models" / "extensions", "extension_declarations", Conventions("extension-root", "root", {})
)


def compare(paths: Sequence[Path], claims: Mapping[str, str] = {}, parts: Collection[str] = ()) -> Comparison:
    """Compare the models at ``paths`` (files, or folders with ``*.xml``) with 10.1, and the ``parts`` claimed of 10.2 to 10.5.

    ``claims`` maps options of the interpretations of clause 10 to the values declared; an option's first value holds for
    those not named. Without any path everything is absent. Raises ``DocumentError`` for files that cannot be used.
    """
    files = [file for path in paths for file in (sorted(path.rglob("*.xml")) if path.is_dir() else (path,))]
    root, core = read_models(files)
    results: list[ModelResult] = []
    readings: dict[str, frozenset[str]] = {}
    for models in (_CORE, _EXTENSIONS):
        ours, declarations = _ours(models)
        if models is _EXTENSIONS:
            of = {r.id: r.part for r in load_requirements()}
            kept = [module for module in ours.children if of[declarations[module].requirement] in parts]
            ours = replace(ours, children=kept)
            declarations = {e: d for e, d in declarations.items() if of[d.requirement] in parts}
        comparing = Comparing(declarations, ChainMap({}, claims, _first_values()), models.conventions)  # type: ignore[arg-type]  # only {} is written to
        if files and declarations:
            comparing.compare(ours, root, core)
        readings |= {option: frozenset(values) for option, values in comparing.readings.items()}
        results += _results(models, {d.requirement for d in declarations.values()}, comparing.facts)
    return Comparison(tuple(results), readings)


def checked() -> dict[str, frozenset[str]]:
    """The requirements of each check."""
    stands_for: dict[str, set[str]] = {name: set() for name in CHECKS}
    for models in (_CORE, _EXTENSIONS):
        catalogue = _catalogue(models)
        stands_for[models.check] |= {d.requirement for d in catalogue.declarations}
        for statement in catalogue.statements:
            stands_for[statement.check].add(statement.requirement)
    return {name: frozenset(requirements) for name, requirements in stands_for.items()}


def core_catalogue() -> Catalogue:
    """What ``declarations.yaml`` says of our own models of 10.1."""
    return _catalogue(_CORE)


@functools.cache
def _catalogue(models: Models) -> Catalogue:
    return read(models.folder / "declarations.yaml", Catalogue)


@functools.cache
def _first_values() -> dict[str, str]:
    return {option: values[0] for option, values in load_options().items()}


@functools.cache
def _ours(models: Models) -> tuple[Element, dict[Element, Declaration]]:
    """The suite's models, and the entry of ``declarations.yaml`` for each of their elements."""
    root, _ = read_models(sorted(models.folder.glob("*.xml")))
    by_source = {e.source: e for e in root.walk()}
    trees = {element.where.partition(":")[0]: element.source for element in root.children}
    declarations: dict[Element, Declaration] = {}
    for declaration in _catalogue(models).declarations:
        source = trees[declaration.file]
        found: Any = source.getroottree().xpath(declaration.place) if source is not None else []
        if len(found) != 1:
            raise DocumentError(
                models.folder / "declarations.yaml", None, f"{declaration.place} is there {len(found)} times"
            )
        declarations[by_source[found[0]]] = declaration
    for element, declaration in list(declarations.items()):
        for inside in element.walk() if declaration.within else ():
            declarations.setdefault(inside, replace_struct(declaration, readings=(), beyond={}))
    return root, declarations


def _results(
    models: Models, compared: Collection[str], facts: Mapping[str, Mapping[str, Fact]]
) -> Iterator[ModelResult]:
    catalogue = _catalogue(models)
    for requirement in dict.fromkeys(d.requirement for d in catalogue.declarations if d.requirement in compared):
        yield _result(requirement, models.check, list(facts.get(requirement, {}).values()))
    for statement in catalogue.statements:
        all_of_it = list(facts.get(statement.requirement, {}).values())
        for requirement, abouts in statement.of.items():
            known = facts.get(requirement, {})
            all_of_it += [known[about] for about in abouts if about in known]
        yield _result(statement.requirement, statement.check, all_of_it)


def _result(requirement: str, check: str, facts: list[Fact]) -> ModelResult:
    """The worst of ``facts`` decides; present and absent facts together count as kept."""
    for status in _WORST_FIRST:
        decisive = [fact for fact in facts if fact.status == status]
        if decisive:
            expected = "; ".join(dict.fromkeys(fact.expected for fact in decisive if fact.expected))
            observed = "; ".join(dict.fromkeys(fact.observed for fact in decisive if fact.observed))
            return ModelResult(requirement, check, status, *(("", "") if status == "kept" else (expected, observed)))
    return ModelResult(requirement, check, "absent", observed="there is no model to look at")


_WORST_FIRST: tuple[Status, ...] = ("broken", "unclear", "kept", "absent", "left out")
