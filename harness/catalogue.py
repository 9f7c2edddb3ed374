"""The requirement catalogue: every normative statement of the clauses under test, as data with provenance."""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract.scenario import Value

Level = Literal["shall", "should", "may", "statement"]
"""How strongly the text speaks: an obligation, a recommendation, a permission, or a plain statement of what is."""


class Requirement(Value):
    """One statement of the specification, in the project's own words.

    ``observed`` says how a trace shows that it was kept or broken, ``rules`` which rules stand for it. A requirement
    that no run can show has ``untestable`` instead: the reason. ``interpretations`` are ids of ``interpretations.yaml``.
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
