"""What every finding has: another observation than expected, a name of what it is about, and no words of the programs."""

from __future__ import annotations

import functools
import re

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution.leftovers import HOST_CHECKS
from ucm_cts.reference_models.findings import Finding

_PROGRAM_WORDS = re.compile(r"\bopaque\b|\bUNDECLARED\b|went the way|\bNone\b|\bTrue\b|\bFalse\b|<[a-z_.]+object")

_NAMING = ("bind", "component", "id", "connection", "link", "container", "ref")
"""The fields of steps with names of instances, implementations (one may be nobody's), connections, containers and references."""


class Wording:
    """Looks at the texts of findings about ``scenario``, both in the same names."""

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario

    def problem(self, finding: Finding) -> str:
        """What is wrong with the text of ``finding``; empty if nothing is."""
        text = f"{finding.expected} {finding.observed}"
        if not finding.expected.strip():
            return "does not say what was expected"
        if finding.expected == finding.observed:
            return "observed what was expected"
        if finding.rule not in HOST_CHECKS and not self._names.search(text):  # those are about a process
            return "names no instance, implementation, port, connection, container or reference"
        if words := _PROGRAM_WORDS.search(text):
            return f"says '{words.group()}'"
        return ""

    @functools.cached_property
    def _names(self) -> re.Pattern[str]:
        return _names_of(self._scenario)


def _names_of(scenario: Scenario) -> re.Pattern[str]:
    names = {s.MANAGER, *scenario.components}
    for declaration in scenario.components.values():
        names.update((*declaration.provides, *declaration.requires))
    for step in scenario.steps:
        values = (getattr(step, field, "") for field in _NAMING)
        names.update(value for value in values if isinstance(value, str))
    return re.compile("|".join(rf"(?<!\w){re.escape(name)}(?!\w)" for name in names if name))
