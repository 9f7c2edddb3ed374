"""What a verdict is about: specification, profile, and how many of its requirements the run decided about.

The terminal, ``report.html``, ``report.json`` and ``junit.xml`` take it from here.
"""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.requirements import Requirement, requirements_of
from ucm_cts.harness.catalogue.specification import Specification, load_specification
from ucm_cts.harness.purposes.selection import words_of
from ucm_cts.harness.results.values import Report


class Scope(Value, frozen=True):
    """What a verdict is about. The three numbers together are the requirements of the profile, or of what ``-k`` selected.

    ``asked``: requirements with a verdict, whatever it is.
    ``not_applicable``: requirements that the vendor's statement leaves out.
    ``not_testable``: requirements that no run can decide; the verdict says nothing of them.
    """

    specification: Specification
    profile: str
    asked: int
    not_applicable: int
    not_testable: int

    @property
    def text(self) -> str:
        """One line: ``OMG UCM (...), profile core: 214 requirements asked, 3 not applicable, 41 not testable``."""
        numbers = f"{self.asked} requirement{'' if self.asked == 1 else 's'} asked"
        rest = f"{self.not_applicable} not applicable, {self.not_testable} not testable"
        return f"{self.specification.name}, profile {self.profile}: {numbers}, {rest}"


def scope_of(report: Report, catalogue: Sequence[Requirement] | None = None) -> Scope:
    """The scope of ``report``; ``catalogue`` has the requirements of its profile, those of this suite if it is not given."""
    if catalogue is None:
        catalogue = requirements_of(report.profile)
    reported = {result.id for result in report.requirements}
    left_out = sum(result.verdict == "not applicable" for result in report.requirements)
    words = words_of(report.selection)
    selected = [r for r in catalogue if not words or any(word in r.id.lower() for word in words)]
    untestable = sum(bool(r.untestable) and r.id not in reported for r in selected)
    asked = len(report.requirements) - left_out
    return Scope(load_specification(), report.profile, asked, left_out, untestable)
