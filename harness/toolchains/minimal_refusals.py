"""Finds the refused legal models that show a defect of their own.

One defect makes a tool chain refuse every model with a certain construct. Only the simplest of those models counts; the others share
with it a construct that no accepted model has.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Collection, Iterator, Mapping

from lxml import etree

_LITERALS = frozenset(
    ("kind", "direction", "mode", "nature", "multiplicity", "applicability", "charBase", "indexType", "defaultCase")
)


class MinimalRefusals:
    """The simplest models among those in ``refused``; ``texts`` are all legal models by name."""

    def __init__(self, texts: Mapping[str, str], refused: Collection[str]) -> None:
        used = {name: constructs(text) for name, text in texts.items()}
        accepted = frozenset().union(*(used[name] for name in texts if name not in refused))
        self._used = {name: used[name] for name in texts if name in refused}
        self._unaccepted = {name: found - accepted for name, found in self._used.items()}
        self._simplest_first = sorted(self._used, key=lambda name: len(self._used[name]))

    def simpler_than(self, name: str) -> str:
        """A simpler refused model that shares an unaccepted construct with ``name``, or is part of it; empty if there is none."""
        for other in itertools.takewhile(lambda other: other != name, self._simplest_first):
            if self._unaccepted[other] & self._unaccepted[name] or self._used[other] < self._used[name]:
                return other
        return ""


@functools.lru_cache(8192)
def constructs(text: str) -> frozenset[str]:
    """The constructs of a model: nested, repeated and neighbouring elements, sets of attributes, shapes of values."""
    return frozenset(_found(etree.fromstring(text.encode())))


def _found(root: etree._Element) -> Iterator[str]:
    yield f"/{root.tag!s}"
    for element in root.iter(etree.Element):
        tag = str(element.tag)
        inside = [str(child.tag) for child in element if isinstance(child.tag, str)]
        yield from (f"{tag}/{child}" for child in inside)
        yield from (f"{tag}/{child} several" for child in set(inside) if inside.count(child) > 1)
        yield from (f"{before}, {after}" for before, after in itertools.pairwise(inside) if before != after)
        if not inside:
            yield f"{tag} empty"
        attributes = {str(a): str(v) for a, v in element.attrib.items()}
        yield f"{tag}({', '.join(sorted(attributes))})"
        yield from (f"{tag}@{attribute} {_shape(attribute, value)}" for attribute, value in attributes.items())


def _shape(attribute: str, value: str) -> str:
    """The kind of spelling of an attribute's value."""
    if attribute in _LITERALS and not (":" in value or "." in value):
        return value
    if value.lstrip("+-").isdecimal():
        return "negative" if value.startswith("-") else "number" if value.strip("+-0") else "0"
    signs = "".join(sign for sign in ("::", ".", "-", '"', "'", " ") if sign in value)
    return ("root " if value.startswith("::") else "") + (signs or ("name" if value else "nothing"))
