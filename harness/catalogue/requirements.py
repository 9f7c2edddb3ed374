"""The catalogue: requirements, interpretations and capabilities, read from ``suite``."""

from __future__ import annotations

import fnmatch
import functools
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Literal, get_args

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.profiles import PARTS, TOOLCHAIN_PROFILES
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable

Level = Literal["shall", "should", "may", "statement"]
"""The force of a requirement: an obligation, a recommendation, a permission, or a fact (docs/decisions/0012)."""


def decides(level: Level) -> bool:
    """Does a requirement of this level decide the verdict of a run? A recommendation does not."""
    return level != "should"


Part = Literal[
    "",
    "properties",
    "request-response",
    "shared-data",
    "timers",
    "index-timers",
    "object-timers",
    "execution",
    "periodic_self-executing_component",
    "background_self-executing_component",
    "sporadic_protected_active_component",
    "periodic_protected_active_component",
]
"""What a requirement of clauses 10.2 to 10.5 belongs to."""

_WITH_PARTS = {"extensions", *(family for profile in TOOLCHAIN_PROFILES for family in PARTS[profile])}
"""What requirements with a part may be filed under: the standard properties of 10.2 are a matter of tool chains, too."""

_SEVERAL: Mapping[str, tuple[str, ...]] = {
    "timers": ("index-timers", "object-timers"),
    "execution": (
        "periodic_self-executing_component",
        "background_self-executing_component",
        "sporadic_protected_active_component",
        "periodic_protected_active_component",
    ),
}
"""What several parts have in common, and these parts, which a vendor claims one by one."""

CLAIMABLE: tuple[str, ...] = tuple(part for part in get_args(Part) if part and part not in _SEVERAL)
"""The parts of clauses 10.2 to 10.5, finished or not."""


def claims_of(part: str) -> tuple[str, ...]:
    """The parts that a vendor can claim, one of which makes the requirements of ``part`` apply."""
    return _SEVERAL.get(part, (part,))


class Requirement(Value, frozen=True):
    """One demand of the specification, in the project's own words. It has exactly one of ``rules``, ``pending`` and ``untestable``.

    ``id``: ``R-<clause>-<number>``.
    ``clause``: the clause of the specification.
    ``title``: a few words for lists.
    ``level``: its force.
    ``meaning``: what it demands.
    ``derived``: why it holds although the text does not say it; empty if the text says it.
    ``observed``: how a trace or a model shows that it was kept or broken.
    ``rules``: the properties or model checks that decide it.
    ``untestable``: why no run can decide it.
    ``interpretations``: ids of entries in ``suite/interpretations``.
    ``profile``: the first profile that has it.
    ``pending``: what its property still needs.
    ``part``: the part of clauses 10.2 to 10.5 that it belongs to, which a vendor claims by itself, or what several parts have in common.
    """

    id: str
    clause: str
    title: str
    level: Level
    meaning: str
    observed: str = ""
    rules: tuple[str, ...] = ()
    untestable: str = ""
    interpretations: tuple[str, ...] = ()
    profile: str = "container"
    pending: str = ""
    derived: str = ""
    part: Part = ""

    def __post_init__(self) -> None:
        if self.part and self.profile not in _WITH_PARTS:
            raise ValueError(f"part {self.part} is of profile extensions, not of {self.profile}; leave it out")

    @property
    def force(self) -> str:
        """Its level as people read it."""
        return f"{self.level}, derived" if self.derived else self.level


SUITE = Path(__file__).parents[2] / "suite"


class Interpretation(Value, frozen=True):
    """A place where the text is silent or contradicts itself, and how the suite reads it.

    ``reason`` says what is unclear, ``readings`` what the text could mean, ``decision`` which reading the suite takes, and
    ``checked`` what follows for the tests. ``options`` maps each option to its values; the first one holds unless the vendor
    declares another. ``profile`` is the first profile that needs the decision.
    """

    id: str
    clauses: tuple[str, ...]
    reason: str
    decision: str
    readings: tuple[str, ...] = ()
    checked: str = ""
    options: dict[str, tuple[str, ...]] = {}
    profile: str = "container"

    @property
    def lines(self) -> tuple[str, ...]:
        """Its sentences: a line for each field that is given."""
        labelled = (("Readings", "; ".join(self.readings)), ("Decision", self.decision), ("Checked", self.checked))
        return (self.reason, *(f"{label}: {text}" for label, text in labelled if text))


@functools.cache
def load_requirements() -> tuple[Requirement, ...]:
    """The whole catalogue, in the order of the clauses. Raises ``DocumentError``."""
    return tuple(r for path in sorted((SUITE / "requirements").glob("*.yaml")) for r in read(path, list[Requirement]))


@functools.cache
def unfinished_parts() -> frozenset[str]:
    """The parts of clauses 10.2 to 10.5 of which some requirement is pending: no run asks for them, and nobody can claim them."""
    return frozenset(part for r in load_requirements() if r.part and r.pending for part in claims_of(r.part))


@functools.cache
def requirements_of(profile: str) -> tuple[Requirement, ...]:
    """What a run of ``profile`` asks for, in the order of the clauses; nothing for an unknown one."""
    families, unfinished = PARTS.get(profile, ()), unfinished_parts()
    return tuple(
        r for r in load_requirements() if r.profile in families and not unfinished.issuperset(claims_of(r.part))
    )


@functools.cache
def in_the_making(profile: str) -> str:
    """Why a run cannot choose ``profile`` yet; empty for an unknown profile, and for one that is complete as far as it goes."""
    requirements = [r for r in load_requirements() if r.profile in PARTS.get(profile, (profile,))]
    pending = sum(bool(r.pending) for r in requirements)
    if not pending or requirements_of(profile):
        return ""
    return (
        f"profile '{profile}' is in the making: {pending} of its {len(requirements)} requirements are not checked yet; "
        "'ucm-cts explain' lists them"
    )


@functools.cache
def load_interpretations() -> tuple[Interpretation, ...]:
    """All decisions about unclear places. Raises ``DocumentError``."""
    return tuple(
        msgspec.structs.replace(entry, profile=profile)
        for profile, patterns in _INTERPRETATIONS.items()
        for pattern in patterns
        for path in sorted((SUITE / "interpretations").glob(pattern))
        for entry in read(path, list[Interpretation])
    )


_INTERPRETATIONS = {
    "container": ("clause_11.yaml",),
    "core": ("clause_10_1.yaml",),
    "extensions": ("clause_10_extensions_*.yaml",),
    "pim": ("clause_9*.yaml", "clause_10_2.yaml"),
    "idl": ("clause_12.yaml",),
    "cpp": ("clause_13.yaml",),
}
"""Where the decisions about unclear places are, by the part of a profile that asks first."""


def declarable() -> tuple[Interpretation, ...]:
    """The decisions whose options a vendor can declare: not those of parts in the making, which nothing reads yet."""
    asked = {name for r in requirements_of("extensions") for name in r.interpretations}
    return tuple(entry for entry in load_interpretations() if entry.profile != "extensions" or entry.id in asked)


class Capability(Value, frozen=True):
    """A part of the platform that a vendor claims or leaves out; ``text`` says what it is.

    Those of profile ``core`` are claimed unless the vendor says otherwise, those of ``extensions`` are not.
    """

    id: str
    clause: str
    text: str
    profile: Literal["core", "extensions"] = "core"


class Need(Value, frozen=True):
    """What the vendor must claim for some requirements to apply.

    ``requirements``: their ids; ``*`` and ``[...]`` match as in file names.
    ``needs``: capabilities, or readings as ``option=value``; all must be claimed.
    ``one_of``: one of these must be claimed, if there are any.
    """

    requirements: tuple[str, ...]
    needs: tuple[str, ...] = ()
    one_of: tuple[str, ...] = ()


class Capabilities(Value, frozen=True):
    """The parts of the platform, and what requirements need of them."""

    capabilities: tuple[Capability, ...]
    needs: tuple[Need, ...]

    def of(self, requirement: str) -> list[Need]:
        """What ``requirement`` needs; nothing for one that always applies."""
        found = [n for n in self.needs if any(fnmatch.fnmatchcase(requirement, p) for p in n.requirements)]
        parts = _parts().get(requirement)
        return [*([Need((requirement,), one_of=parts)] if parts is not None else []), *found]


@functools.cache
def needs_of_requirement(requirement: str) -> tuple[Need, ...]:
    """What ``requirement`` needs, by the suite's own capabilities."""
    return tuple(load_capabilities().of(requirement))


@functools.cache
def _parts() -> Mapping[str, tuple[str, ...]]:
    """The parts of clauses 10.2 to 10.5 that a requirement belongs to, by its id; none in the making."""
    finished = {part: tuple(p for p in claims_of(part) if p not in unfinished_parts()) for part in get_args(Part)}
    return {r.id: finished[r.part] for r in load_requirements() if r.part and finished[r.part]}


@functools.cache
def load_capabilities() -> Capabilities:
    """What a vendor may leave out. Raises ``DocumentError``."""
    return read(SUITE / "capabilities.yaml", Capabilities)


def capabilities_for(families: Collection[str]) -> tuple[Capability, ...]:
    """What a vendor can claim for a profile with these ``families`` of requirements (``PARTS``): the parts that belong to them, and
    those that requirements of theirs name.
    """
    named = {part for r in load_requirements() if r.profile in families for part in claims_of(r.part)}
    return tuple(c for c in load_capabilities().capabilities if c.profile in families or c.id in named)


@functools.cache
def load_options() -> Mapping[str, tuple[str, ...]]:
    """The values of all options that a vendor can declare; the first one holds unless the vendor declares another."""
    return {option: values for entry in declarable() for option, values in entry.options.items()}


@functools.cache
def load_life_cycle() -> LifeCycleTable:
    """The life-cycle table. Raises ``DocumentError``."""
    return read(SUITE / "life_cycle.yaml", LifeCycleTable)
