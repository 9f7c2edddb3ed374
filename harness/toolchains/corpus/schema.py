"""The schema of UCM models: checks the structure of a model in canonical spelling against clause 9, without its references."""

from __future__ import annotations

import functools
from typing import Any, NamedTuple

from lxml import etree

from ucm_cts.harness.catalogue.requirements import SUITE

SCHEMA = SUITE / "models" / "ucm.xsd"


class Violation(NamedTuple):
    """A line, counted from 1, and what the schema has against it."""

    line: int
    message: str


@functools.cache
def schema() -> etree.XMLSchema:
    """The schema as libxml2 understands it, which is fast. Validating with it is not safe in several threads."""
    return etree.XMLSchema(etree.parse(SCHEMA))


def parser() -> etree.XMLParser:
    """For models that come from others: no entities, no network, bounded depth and text."""
    return etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)


def violations(xml: bytes) -> list[Violation]:
    """What the schema has against the model ``xml``; nothing if it is as it should be."""
    try:
        root = etree.fromstring(xml, parser())
    except etree.XMLSyntaxError as error:
        return [Violation(error.lineno or 1, f"is not XML: {error.msg}")]
    about: Any = root.getroottree().docinfo
    if about.doctype:
        return [Violation(1, "has a document type")]
    known = schema()
    known.validate(root)
    log: Any = known.error_log
    return [Violation(error.line, error.message) for error in log]
