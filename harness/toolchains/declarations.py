"""The options without whose declaration a tool chain is not asked some requirements at all."""

from __future__ import annotations

import fnmatch
from collections.abc import Mapping

from ucm_cts.harness.catalogue.requirements import load_options
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.toolchains.acceptance import unasked
from ucm_cts.harness.toolchains.idl.declared_support import ASKED_OF
from ucm_cts.reference_models.mapping.idl.expectations import RULE_OF


def asked_of_declared() -> Mapping[str, frozenset[str]]:
    """Such options, each with the requirements that are only asked of vendors who declare it."""
    found: dict[str, set[str]] = {}
    for requirement, (_, options) in unasked(default_statement()).items():
        for option in options & load_options().keys():  # not a part that is to be claimed
            found.setdefault(option, set()).add(requirement)
    for pattern, readings in ASKED_OF.items():
        for reading in readings:
            found.setdefault(reading.partition("=")[0], set()).update(fnmatch.filter(RULE_OF, pattern))
    return {option: frozenset(requirements) for option, requirements in found.items()}
