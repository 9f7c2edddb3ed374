"""A model once more with annotations and comments everywhere: generators make the same of it (9.2.9.4)."""

from __future__ import annotations

from lxml import etree

from ucm_cts.adapters.contract.metamodel.contracts import Annotation
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS, TAGS, contained
from ucm_cts.harness.toolchains.corpus.declarations import path

PREFIX = "decorated_"
"""How the names of such models begin; the rest is the name of the model without decoration."""

DECORATION_OF_IDL = "R-9.2.9.4-04", "idl_decoration"
DECORATION_OF_CPP = "R-9.2.9.4-05", "cpp_decoration"
"""What a generator breaks that makes something else of it, and the rule that finds it."""

_ANNOTABLE = frozenset(s.tag for s in SPELLINGS.values() if Annotation in contained(TAGS[s.tag]))


def decorated(text: str) -> str:
    """The model ``text`` with a comment in each element and an annotation on each that may have one."""
    root = etree.fromstring(text.encode())
    module = next(root.iter("ContractModule"))
    elements = list(root.iter(etree.Element))
    definition = etree.SubElement(module, "AnnotationDefinition", name="decoration")
    for element in elements:
        if element.tag in _ANNOTABLE:
            element.insert(0, etree.Element("Annotation", annotationDefinition=path(definition)))
        if len(element):
            element.insert(0, etree.Comment(" interface struct { }; "))
    return etree.tostring(root, encoding="unicode")
