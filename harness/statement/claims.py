"""What a statement can claim of a product: what its adapter offers, and the options that its vendor must decide."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import msgspec

from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES
from ucm_cts.harness.catalogue.requirements import load_capabilities, load_options, requirements_of
from ucm_cts.harness.results.statement import HOOKS, IMPOSSIBLE, Statement, default_statement
from ucm_cts.harness.statement.applicability import lines_for


@dataclass(frozen=True)
class Offer:
    """Whether an adapter offers a part of the platform, or an operation for tests.

    ``lacking``: how it shows that it does not; empty if it offers it.
    ``readings``: what must be declared with it.
    """

    lacking: str = ""
    readings: Mapping[str, str] = field(default_factory=dict)


Offers = Mapping[str, Offer]
"""By capability, and by option of a test operation."""


def claimed(known: Statement, offers: Offers, wanted: str = "") -> Statement:
    """``known`` without what the adapter does not offer, and with the operations for tests that it offers.

    It claims the profile ``wanted``; if that is empty, all that a vendor of these ``offers`` can claim. Of parts of 10.2 to 10.5 that no
    adapter can be asked about it keeps what is known.
    """
    default = default_statement()
    readings = dict(known.readings)
    for name, offer in offers.items():
        for option, value in offer.readings.items():
            if readings[option] == default.readings[option]:
                readings[option] = value
        if name in HOOKS and readings[name] != IMPOSSIBLE:
            readings[name] = "none" if offer.lacking else "hook"
    parts = load_capabilities().capabilities
    capabilities = {p.id: known.capabilities[p.id] and not _lacks(offers, p.id) for p in parts if p.profile == "core"}
    extended = {
        p.id: not offers[p.id].lacking if p.id in offers else known.capabilities[p.id]
        for p in parts
        if p.profile == "extensions"
    }
    whole = all(capabilities.values())
    if wanted:
        profiles = FRAMEWORK_PROFILES[: FRAMEWORK_PROFILES.index(wanted) + 1]
    else:
        can = {"container": True, "core": whole, "extensions": whole and any(extended.values())}
        profiles = tuple(p for p in FRAMEWORK_PROFILES if p in known.profiles and can[p])
    capabilities |= extended if "extensions" in profiles else dict.fromkeys(extended, False)
    return msgspec.structs.replace(known, readings=readings, capabilities=capabilities, profiles=profiles)


def lacking(offers: Offers) -> Mapping[str, str]:
    """How the adapter shows that it does not offer something, by what it does not offer."""
    return {name: offer.lacking for name, offer in offers.items() if offer.lacking}


def to_decide(statement: Statement, asked: Mapping[str, frozenset[str]]) -> Mapping[str, frozenset[str]]:
    """The options whose declaration would let a run decide requirements of the profiles that ``statement`` claims, with these.

    ``asked`` are further such options, with requirements of any profile. An operation for tests is not the vendor's to declare
    but the adapter's to offer, unless there may be nothing to test. What is declared, is decided.
    """
    options = load_options()
    found: dict[str, set[str]] = {}
    for requirement in dict.fromkeys(r for profile in statement.profiles for r in requirements_of(profile)):
        if requirement.untestable:
            continue
        lines = lines_for(requirement, statement)
        if any(not line.option for line in lines):  # a part of 10.1 is left out, so it does not apply anyway
            continue
        names = {line.option for line in lines}
        names |= {option for option, of in asked.items() if requirement.id in of}
        for option in names:
            if statement.readings[option] == options[option][0] and (
                option not in HOOKS or IMPOSSIBLE in options[option]
            ):
                found.setdefault(option, set()).add(requirement.id)
    return {option: frozenset(ids) for option, ids in found.items()}


def _lacks(offers: Offers, name: str) -> bool:
    return name in offers and bool(offers[name].lacking)
