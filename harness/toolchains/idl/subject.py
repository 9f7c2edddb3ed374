"""The declaration that a fact is about."""

from __future__ import annotations

from ucm_cts.harness.toolchains.idl.language.scopes import Hit
from ucm_cts.harness.toolchains.idl.results import NotExercised
from ucm_cts.harness.toolchains.idl.vendor import Vendor
from ucm_cts.reference_models.mapping.idl.declarations import Declaration, Place
from ucm_cts.reference_models.mapping.idl.expectations import Path


def here(vendor: Vendor, path: Path, kinds: type[Declaration] | tuple[type[Declaration], ...] = Declaration) -> Hit:
    """What stands at ``path``. Raises ``NotExercised`` if there is nothing, or something else, which another fact reports."""
    hit = vendor.at(path)
    if hit is None or not isinstance(hit.entry.declaration, kinds):
        raise NotExercised
    return hit


def nearest(hit: Hit | None) -> Place:
    """The place of the declaration around a missing one."""
    return hit.entry.declaration.place if hit is not None else Place()
