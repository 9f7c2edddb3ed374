"""Operators that only set attributes or add a child: data in ``suite/models/edits.yaml``."""

from __future__ import annotations

from lxml import etree

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.toolchains.operators.operator import Change, breaks

EDITS = SUITE / "models" / "edits.yaml"


class Edit(Value, frozen=True):
    """An edit at an element with the tag ``at``, or one of them, that breaks a requirement."""

    breaks: str
    at: str | tuple[str, ...]
    name: str
    because: str
    set: dict[str, str | None] = {}
    """Attributes of the element; None takes one out."""
    add: tuple[str, dict[str, str]] | None = None
    """A new last child: its tag and its attributes."""
    under: tuple[str, ...] = ()
    """The readings (``option=value``) that must be declared."""


def _change(edit: Edit) -> Change:
    def change(element: etree._Element) -> None:
        for attribute, value in edit.set.items():
            if value is None:
                del element.attrib[attribute]
            else:
                element.set(attribute, value)
        if edit.add is not None:
            etree.SubElement(element, *edit.add)

    change.__name__, change.__doc__ = edit.name, edit.because
    return change


for _edit in read(EDITS, list[Edit]):
    breaks(_edit.breaks, _edit.at, _edit.under)(_change(_edit))
