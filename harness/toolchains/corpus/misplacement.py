"""Elements where no class has room for them: derived from the meta-model, each class inside each other one that has no field for it.

The smallest legal model that has both is taken, and a copy of the one is put at the end of the other. A checker that looks at what
an element holds at all refuses the copy; nothing else is wrong with it where references do not depend on the place.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from lxml import etree

from ucm_cts.adapters.contract.metamodel import aspects, common, components, contracts, interactions, modules
from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS, TAGS, contained
from ucm_cts.adapters.contract.metamodel.writing import Dialect

UNDER = ("declarations-elsewhere=refused",)
"""The readings that must be declared."""

FAMILY = "misplaced"
"""What the names of the models begin with."""

GENERAL = "R-9-04"
"""Elements stand only where a class has a field for them."""

_DECLARED_ELSEWHERE = "R-9.1.4.4-03"

_OF_INNER: Mapping[type[Element], str] = {
    contracts.Attribute: "R-9.1.2-03",
    contracts.ConfigurationParameter: "R-9.1.2-05",
    contracts.AnnotationDefinition: "R-9.1.2-09",
    contracts.Annotation: "R-9.2.2.8-02",
}
_OF_OUTER: Mapping[type[Element], str] = {
    modules.ApplicationModule: "R-9.1.4.7-02",
    modules.PlatformModule: "R-9.1.4.8-02",
    contracts.ContractModule: "R-9.2.2.15-03",
    aspects.NonfunctionalAspectModule: "R-9.4.2.1-05",
    components.ComponentModule: "R-9.5.2.1-04",
    components.CompositeComponentImplementation: "R-9.5.5.2-02",
}
"""The requirements that speak of one class; all others are ``GENERAL``, or speak of modules and what they declare."""

_OPEN = {(contracts.ConfigurationParameter, interactions.InteractionPattern)}
"""Pairs that an interpretation of their own decides (pattern-parameters)."""

EVERYWHERE = frozenset(
    (*modules.MODULES, *_OF_INNER, contracts.ConfigurationParameterValue, contracts.Method, components.Port)
) - {common.SimpleComment}
"""What is asked of every class: what other classes hold under the same name."""

STRIDE = 5
"""Of the other pairs each ``STRIDE``-th is asked."""


def pairs() -> Iterator[tuple[type[Element], type[Element]]]:
    """Each class, and a class that may not hold it.

    All pairs of which the outer one is a module or holds elements of the same part of the meta-model (a clause 9.x), all with a class
    of ``EVERYWHERE``, and a regular selection of the others in which every class comes several times on either side.
    """
    classes = list(SPELLINGS)
    for i, inner in enumerate(classes):
        for j, outer in enumerate(classes):
            if inner in contained(outer) or inner in (modules.Model, common.SimpleComment) or (inner, outer) in _OPEN:
                continue
            near = inner.__module__ == outer.__module__ and not _is_leaf(outer)
            if near or inner in EVERYWHERE or outer in _OF_OUTER or (i + j) % STRIDE == 0:
                yield inner, outer


def _is_leaf(cls: type[Element]) -> bool:
    """Whether it holds nothing but what decorates it."""
    return not contained(cls).keys() - {common.SimpleComment, contracts.Annotation}


def requirement(inner: type[Element], outer: type[Element]) -> str:
    """What an ``inner`` in an ``outer`` breaks."""
    declared = any(inner in contained(module) for module in (*modules.MODULES, modules.Model))
    elsewhere = not issubclass(outer, modules.MODULES) and declared
    return _OF_INNER.get(inner) or _OF_OUTER.get(outer) or (_DECLARED_ELSEWHERE if elsewhere else GENERAL)


def name(inner: type[Element], outer: type[Element]) -> str:
    """The name of the model with an ``inner`` in an ``outer``."""
    return f"{FAMILY}/{SPELLINGS[inner].tag}-in-{SPELLINGS[outer].tag}"


def is_broken_in(dialect: Dialect, question: str) -> bool:
    """Whether the model ``question`` is wrong in ``dialect``, too, where one tag may stand for several classes."""
    if not question.startswith(f"{FAMILY}/"):
        return True
    inner, _, outer = question.removeprefix(f"{FAMILY}/").partition("-in-")
    held = [SPELLINGS[cls].tag for cls in contained(TAGS[outer])]
    return dialect.tags.get(inner, inner) not in [dialect.tags.get(tag, tag) for tag in held]


class Legal(NamedTuple):
    """A legal model: its name, its text, and the readings (``option=value``) under which it is legal."""

    name: str
    text: str
    under: tuple[str, ...]


class Misplaced(NamedTuple):
    """A model with one misplaced element: its name, the requirement that it breaks, why, its legal twin, and its text."""

    name: str
    requirement: str
    because: str
    twin: Legal
    text: str


def misplaced(models: Iterable[Legal]) -> Iterator[Misplaced]:
    """A model of each pair, made of the smallest one of ``models`` that has both classes, or the outer one at least.

    Models that need no reading come first.
    """
    roots = sorted(
        ((one, etree.fromstring(one.text.encode())) for one in models),
        key=lambda pair: (bool(pair[0].under), len(pair[0].text)),
    )
    tags = {one.name: frozenset(str(e.tag) for e in root.iter(etree.Element)) for one, root in roots}

    def first(*wanted: str) -> tuple[Legal, etree._Element] | None:
        return next((pair for pair in roots if tags[pair[0].name].issuperset(wanted)), None)

    for inner, outer in pairs():
        within, around = SPELLINGS[inner].tag, SPELLINGS[outer].tag
        twin = first(within, around) or first(around)
        source = first(within, around) or first(within)
        if twin is not None and source is not None:
            because = f"{_a(around)} has no field for {_a(within, False)}"
            text = _put(twin[1], around, _copied(source[1], within))
            yield Misplaced(name(inner, outer), requirement(inner, outer), because, twin[0], text)


def _copied(source: etree._Element, tag: str) -> etree._Element:
    """A copy of the smallest ``tag`` in ``source``, with a name of its own."""
    found = copy.deepcopy(min(source.iter(tag), key=lambda e: len(list(e.iter()))))
    if found.get("name", "").isidentifier():
        found.set("name", "misplaced_here")
    found.tail = None
    return found


def _put(root: etree._Element, tag: str, inner: etree._Element) -> str:
    """``root`` with ``inner`` as the last child of its first ``tag``."""
    changed = copy.deepcopy(root)
    outer = next(changed.iter(tag))
    last = outer[-1] if len(outer) else None
    outer.append(inner)
    if last is not None:
        inner.tail, last.tail = last.tail, last.tail
    return etree.tostring(changed, encoding="unicode")


def _a(tag: str, begins: bool = True) -> str:
    article = "an" if tag[0] in "AEIOU" else "a"
    return f"{article.capitalize() if begins else article} {tag}"
