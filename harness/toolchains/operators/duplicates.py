"""Names that are there twice, derived from the meta-model: for each field that holds named elements (INamed, 9.1.4.1).

``further.py`` repeats elements right beside the first one. Here they are repeated at the end of what holds them, and as an element of
another class that the same field holds; besides, elements that nothing refers to by their names.
"""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.contracts import ContractModule
from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS
from ucm_cts.harness.toolchains.operators.further import NOT_AGAIN
from ucm_cts.harness.toolchains.operators.modules import DECLARED, MEMBERS, MODULES, is_returned, module_of
from ucm_cts.harness.toolchains.operators.operator import breaks

_SAME = "R-9.1.4.1-02"
_DATA_TYPES = tuple(
    spelling.tag
    for spelling in SPELLINGS.values()
    if issubclass(spelling.cls, SPELLINGS[ContractModule].contained["data_types"]) and issubclass(spelling.cls, Named)
)
_OTHERWISE: dict[str, tuple[str, dict[str, str]]] = {
    **dict.fromkeys(_DATA_TYPES, ("PrimitiveBoolean", {})),
    "PrimitiveBoolean": ("PrimitiveFloat", {"kind": "DOUBLE"}),
    "Interface": ("AbstractInterface", {}),
    "AbstractInterface": ("Interface", {}),
}
"""For each class another one of the same field, which needs nothing but its name and these attributes."""


@breaks(_SAME, at=tuple(tag for tag in (*DECLARED, *MEMBERS) if tag not in NOT_AGAIN))
def again_at_the_end(element: etree._Element) -> bool:
    """Two elements of one kind, with others between them, have one name."""
    owner = element.getparent()
    if owner is None or is_returned(element) or element.getnext() is None:
        return False
    owner.append(copy.deepcopy(element))
    return True


@breaks(_SAME, at=tuple(_OTHERWISE))
def again_as_another_class(element: etree._Element) -> bool:
    """Two declarations of one kind and of different classes have one name."""
    tag, attributes = _OTHERWISE[str(element.tag)]
    if _is_used(element):
        return False
    etree.SubElement(module_of(element), tag, {"name": str(element.get("name")), **attributes})
    return True


def _is_used(element: etree._Element) -> bool:
    """Whether something may refer to ``element``: then the other class might be wrong there, too."""
    name = str(element.get("name"))
    others = (one for one in element.getroottree().iter(etree.Element) if one is not element)
    return any(str(v).rpartition("::")[2] == name for one in others for a, v in one.attrib.items() if a != "name")


@breaks(_SAME, at=("AtomicComponentImplementation", "CompositeComponentImplementation"))
def implementations_of_both_classes(implementation: etree._Element) -> bool:
    """An atomic and a composite implementation have one name."""
    tag = "CompositeComponentImplementation"
    if implementation.tag == tag:
        tag = "AtomicComponentImplementation"
        other = implementation.getroottree().getroot().find(f".//{tag}")
        if other is None or other.find("TechnicalPolicy") is not None:
            return False
        language = {"language": str(other.get("language"))}
    else:
        language = {}
    attributes = {"name": str(implementation.get("name")), "type": str(implementation.get("type")), **language}
    implementation.addnext(etree.Element(tag, attributes))
    return True


@breaks(_SAME, at="Language")
def language_again(language: etree._Element) -> None:
    """A list has the same language twice."""
    language.addnext(copy.deepcopy(language))


@breaks(_SAME, at="Connection")
def connection_again(connection: etree._Element) -> None:
    """Two connections of a composite have one name."""
    attributes = {key: str(connection.get(key)) for key in ("name", "definition")}
    connection.addnext(etree.Element("Connection", attributes))


@breaks(_SAME, at="Connection")
def ends_of_one_name(connection: etree._Element) -> bool:
    """Two ends of a connection have one name."""
    ends = connection.findall("ConnectionEnd")
    if len(ends) < 2:
        return False
    for end in ends:
        end.set("name", "both_ends")
    return True


@breaks(_SAME, at=MODULES, under=("modules-given-twice=refused",))
def module_again(module: etree._Element) -> bool:
    """A module and an empty one of its kind have one name."""
    around = module.getparent()
    if around is None:
        return False
    etree.SubElement(around, str(module.tag), {"name": str(module.get("name"))})
    return True
