"""Edits of the last of several elements: a tool chain that checks only the first ones accepts them."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.harness.toolchains.operators.modules import DECLARED, MEMBERS, is_returned
from ucm_cts.harness.toolchains.operators.operator import breaks

NOT_AGAIN = ("Connection", "ConnectionEnd", "ConnectorPort", "Language", "Enumerator", "Method", "ExceptionField")
"""Whose names have requirements of their own, or none."""


@breaks("R-9.1.4.1-02", at=tuple(tag for tag in DECLARED if tag not in NOT_AGAIN))
def declared_again(element: etree._Element) -> None:
    """Two declarations of one kind have one name."""
    element.addnext(copy.deepcopy(element))


@breaks("R-9.1.4.1-02", at=tuple(tag for tag in MEMBERS if tag not in NOT_AGAIN))
def member_again(element: etree._Element) -> bool:
    """Two members of one kind have one name."""
    if is_returned(element):
        return False
    element.addnext(copy.deepcopy(element))
    return True
