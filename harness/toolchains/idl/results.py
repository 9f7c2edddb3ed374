"""The results of one check of IDL."""

from __future__ import annotations

from dataclasses import dataclass

from ucm_cts.reference_models.mapping.idl.declarations import Place


@dataclass(frozen=True)
class Wrong:
    """What a check found: ``requirement`` is that of the fact unless another one is broken instead."""

    expected: str
    observed: str
    place: Place
    requirement: str = ""


class NotExercised(Exception):
    """The declaration that a fact is about is missing, which another fact reports."""
