"""The schema of models as another library understands it."""

from __future__ import annotations

import functools

import xmlschema

from ucm_cts.harness.toolchains.corpus.schema import SCHEMA


@functools.cache
def second_opinion() -> xmlschema.XMLSchema10:
    """It is slow, and shares no code with libxml2."""
    return xmlschema.XMLSchema10(str(SCHEMA))
