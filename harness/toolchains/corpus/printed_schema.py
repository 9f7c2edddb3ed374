"""The schema of models in all spellings that the text prints: made of the canonical schema and the table of spellings.

``python -m ucm_cts.harness.toolchains.corpus.printed_schema`` writes it again. An attribute that has another printed name is optional in
either, because XSD 1.0 cannot ask for one of two.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping
from pathlib import Path

from lxml import etree

from ucm_cts.adapters.contract.metamodel.spelling import LITERALS, SHORT_STRINGS, SPELLINGS, Spelling
from ucm_cts.harness.toolchains.corpus.schema import SCHEMA

PRINTED = SCHEMA.parent / "printed"
"""The folder of the schema; its root has the name of the canonical one."""

_XS = "{http://www.w3.org/2001/XMLSchema}"
_MADE = " Made from ../{name} by printed_schema.py: canonical spellings and all others that the text prints. "


def printed_schema() -> Mapping[str, bytes]:
    """The files of the schema by their names."""
    files = {path.name: etree.parse(path).getroot() for path in sorted(SCHEMA.parent.glob("ucm*.xsd"))}
    types = {str(t.get("name")): t for root in files.values() for t in root.iterfind(f"{_XS}complexType")}
    for spelling in SPELLINGS.values():
        for element in [
            e for root in files.values() for e in root.iter(f"{_XS}element") if e.get("name") == spelling.tag
        ]:
            declared = types[str(element.get("type"))] if element.get("type") else element[-1]
            _add_attributes(declared, spelling)
    for root in files.values():
        _add_names(root)
        _add_words(root)
    _add_tags(list(files.values()))
    return {name: _text(name, root) for name, root in files.items()}


def _text(name: str, root: etree._Element) -> bytes:
    for comment in list(root.iter(etree.Comment)):
        parent = comment.getparent()
        if parent is not None:
            parent.remove(comment)
    root.insert(0, etree.Comment(_MADE.format(name=name)))
    etree.indent(root)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"


def _others(spelling: Spelling) -> dict[str, str]:
    """Canonical attributes by their other printed names, but for the name, which all named classes share."""
    return {other: spelling.attribute(field) for other, field in spelling.other_attributes.items() if field != "name"}


def _add_attributes(declared: etree._Element, spelling: Spelling) -> None:
    own = {str(a.get("name")): a for a in declared.iter(f"{_XS}attribute")}
    for other, canonical in _others(spelling).items():
        if canonical in own and other not in own:
            known = own[canonical]
            known.attrib.pop("use", "")
            again = copy.deepcopy(known)
            again.set("name", other)
            again.set("type", "xs:string")
            known.addnext(again)
            own[other] = again


def _add_names(root: etree._Element) -> None:
    """A name may be written as name or as identifier."""
    for attribute in list(root.iter(f"{_XS}attribute")):
        around = attribute.getparent()
        if attribute.get("name") == "name" and around is not None:
            attribute.attrib.pop("use", "")
            attribute.addnext(etree.Element(f"{_XS}attribute", name="identifier", type="xs:string"))


def _add_words(root: etree._Element) -> None:
    """Words that prose or another clause spells otherwise."""
    for restriction in root.iter(f"{_XS}restriction"):
        words = {str(e.get("value")) for e in restriction.findall(f"{_XS}enumeration")}
        for known in (known for fields in LITERALS.values() for known in fields.values()):
            if words and words == set(known.values()):
                for other in sorted(known.keys() - words):
                    etree.SubElement(restriction, f"{_XS}enumeration", value=other)
                    words = words | {other}
                break


def _other_tags() -> Iterator[tuple[str, str]]:
    """Each other printed tag with the canonical one."""
    for spelling in SPELLINGS.values():
        yield from ((other, spelling.tag) for other in spelling.other_tags)
    yield from ((tag, "StringType") for tag in SHORT_STRINGS)


def _add_tags(roots: list[etree._Element]) -> None:
    for other, canonical in _other_tags():
        for root in roots:
            for element in [e for e in root.iter(f"{_XS}element") if canonical in (e.get("name"), e.get("ref"))]:
                again = copy.deepcopy(element)
                again.set("name" if element.get("name") else "ref", other)
                element.addnext(again)
    for root in roots:
        for declared in root.iter(f"{_XS}complexType"):
            if declared.get("name") == "StringType":
                for attribute in declared.iter(f"{_XS}attribute"):
                    if attribute.get("name") == "charBase":
                        attribute.attrib.pop("use", "")


def main(folder: Path = PRINTED) -> None:
    """Write the files."""
    folder.mkdir(exist_ok=True)
    for name, text in printed_schema().items():
        (folder / name).write_bytes(text)


if __name__ == "__main__":
    main()
