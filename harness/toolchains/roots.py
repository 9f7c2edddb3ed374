"""The root ``Model`` around several outermost modules: 9.1.4.4 has it, and no spelling of it is printed.

A tool chain that accepts no model with such a root is not failed for the spelling of ours.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

_ROOT = re.compile(r"(?:\s|<\?.*?\?>|<!--.*?-->)*<Model\b", re.DOTALL)

ROOT_UNKNOWN = "no model with a root around several outermost modules was accepted, and the text prints no such root"
"""Why the refusal of a model with such a root says nothing."""


def refused_for_the_root(texts: Mapping[str, str], accepted: Mapping[str, bool | None]) -> frozenset[str]:
    """The names in ``accepted`` of models that may have been refused for their root alone; ``texts`` are the models by name."""
    rooted = {name for name in accepted if _ROOT.match(texts[name])}
    if any(accepted[name] for name in rooted):
        return frozenset()
    return frozenset(name for name in rooted if accepted[name] is False)
