"""Compares the models of clause 10 that a framework ships with the suite's own (``suite/models/core`` and ``extensions``).

``compare(paths, claims, parts)`` takes the framework's files, what its vendor declares of the interpretations of clause 10, and the
parts of 10.2 to 10.5 that it claims. It says of each requirement that a model can show whether it is kept, broken, absent, left out
or unclear, and which readings it met.
"""

from __future__ import annotations

import functools
from collections import ChainMap
from collections.abc import Collection, Iterator, Mapping, MutableMapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, read
from ucm_cts.harness.catalogue.requirements import SUITE, claims_of, load_interpretations, load_requirements
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
    "nothing_redefined": "Policies of 10.5 declare no port elements beside those of the policies that they extend.",
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
    """A requirement that repeats other declarations, or forbids a declaration; it may be that of a declaration itself."""

    requirement: str
    check: str
    of: dict[str, tuple[str, ...]] = {}


class Catalogue(Value, frozen=True):
    """The declarations of 10.1, or of 10.2 to 10.5, and what is said of several of them."""

    declarations: tuple[Declaration, ...]
    statements: tuple[Statement, ...]


@dataclass(frozen=True, eq=False)
class Models:
    """The suite's own models in one ``folder``, the ``check`` of their declarations, and how they are compared."""

    folder: Path
    check: str
    conventions: Conventions

    @functools.cached_property
    def catalogue(self) -> Catalogue:
        """What ``declarations.yaml`` says of them. Raises ``DocumentError``."""
        return read(self.folder / "declarations.yaml", Catalogue)

    @functools.cached_property
    def root(self) -> Element:
        """What they declare. Raises ``DocumentError``."""
        return read_models(sorted(self.folder.glob("*.xml")))[0]

    @functools.cached_property
    def declarations(self) -> Mapping[Element, Declaration]:
        """The entry of ``declarations.yaml`` for each of their elements. Raises ``DocumentError``."""
        by_source = {e.source: e for e in self.root.walk()}
        trees = {element.where.partition(":")[0]: element.source for element in self.root.children}
        declarations: dict[Element, Declaration] = {}
        for declaration in self.catalogue.declarations:
            source = trees[declaration.file]
            found: Any = source.getroottree().xpath(declaration.place) if source is not None else []
            if len(found) != 1:
                problem = f"{declaration.place} is there {len(found)} times"
                raise DocumentError(self.folder / "declarations.yaml", None, problem)
            declarations[by_source[found[0]]] = declaration
        for element, declaration in list(declarations.items()):
            for inside in element.walk() if declaration.within else ():
                declarations.setdefault(inside, replace(declaration, readings=(), beyond={}))
        return declarations


CORE = SUITE / "models" / "core"
EXTENSIONS = SUITE / "models" / "extensions"

CORE_MODELS = Models(
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
EXTENSION_MODELS = Models(
    EXTENSIONS, "extension_declarations", Conventions("extension-root", "root", {}, free=frozenset({"NativeType"}))
)
OWN_MODELS = (CORE_MODELS, EXTENSION_MODELS)


def compare(paths: Sequence[Path], claims: Mapping[str, str] = {}, parts: Collection[str] = ()) -> Comparison:
    """Compare the models at ``paths`` (files, or folders with ``*.xml``) with 10.1, and the ``parts`` claimed of 10.2 to 10.5.

    ``claims`` maps options of the interpretations of clause 10 to the values declared; an option's first value holds for
    those not named. Without any path everything is absent. Raises ``DocumentError`` for files that cannot be used.
    """
    files = [file for path in paths for file in (sorted(path.rglob("*.xml")) if path.is_dir() else (path,))]
    root, core = read_models(files)
    printed = frozenset(element.path for models in OWN_MODELS for element in models.root.walk())
    results: list[ModelResult] = []
    readings: dict[str, frozenset[str]] = {}
    for models in OWN_MODELS:
        claimed = {e: d for e, d in models.declarations.items() if _is_claimed(d.requirement, parts)}
        settled: MutableMapping[str, str] = ChainMap({}, claims, _first_values())  # type: ignore[arg-type]  # only {} is written to
        comparing = Comparing(claimed, settled, models.conventions, printed)
        if files and claimed:
            comparing.compare(models.root, root, core)
        for option, values in comparing.readings.items():
            readings[option] = readings.get(option, frozenset()) | values
        results += _results(models, parts, comparing.facts)
    return Comparison(tuple(results), readings)


def checked() -> dict[str, frozenset[str]]:
    """The requirements of each check."""
    stands_for: dict[str, set[str]] = {name: set() for name in CHECKS}
    for models in OWN_MODELS:
        for requirement, check in _checks(models).items():
            stands_for[check].add(requirement)
    return {name: frozenset(requirements) for name, requirements in stands_for.items()}


@functools.cache
def _checks(models: Models) -> Mapping[str, str]:
    """The check of each requirement: first those about a declaration, then those about several only."""
    of_several = {s.requirement: s.check for s in models.catalogue.statements}
    return {d.requirement: models.check for d in models.catalogue.declarations} | of_several


@functools.cache
def _first_values() -> Mapping[str, str]:
    return {option: values[0] for entry in load_interpretations() for option, values in entry.options.items()}


@functools.cache
def _parts() -> Mapping[str, str]:
    return {requirement.id: requirement.part for requirement in load_requirements()}


def _is_claimed(requirement: str, parts: Collection[str]) -> bool:
    """Is it of 10.1, or of one of the ``parts``?"""
    part = _parts()[requirement]
    return not part or any(one in parts for one in claims_of(part))


def _results(models: Models, parts: Collection[str], facts: Mapping[str, Mapping[str, Fact]]) -> Iterator[ModelResult]:
    repeated = {statement.requirement: statement.of for statement in models.catalogue.statements}
    for requirement, check in _checks(models).items():
        if _is_claimed(requirement, parts):
            all_of_it = list(facts.get(requirement, {}).values())
            for other, abouts in repeated.get(requirement, {}).items():
                known = facts.get(other, {})
                all_of_it += [known[about] for about in abouts if about in known]
            yield _result(requirement, check, all_of_it)


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
