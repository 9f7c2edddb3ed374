"""Edits of component modules, component types and ports (9.5.2 and 9.5.3)."""

from __future__ import annotations

from lxml import etree

from ucm_cts.harness.toolchains.corpus import declarations as decl
from ucm_cts.harness.toolchains.operators.operator import breaks


@breaks("R-9.5.3.4-02", at="InteractionItemBinding", under=("partial-role-bindings=refused",))
def item_without_type(binding: etree._Element) -> bool:
    """An item that the role involves is not bound."""
    spec = binding.getparent()
    role = (
        decl.member(spec, str(spec.get("role")), "InteractionPattern", "InteractionRole") if spec is not None else None
    )
    item = str(binding.get("item")).rpartition(".")[2]
    if spec is None or role is None or role.find(f"InvolvedItem[@item='{item}']") is None:
        return False
    spec.remove(binding)
    return spec.find("InteractionItemBinding") is not None


@breaks("R-9.5.3.5-03", at="InteractionItemBinding", under=("abstract-actual-types=refused",))
def item_stands_for_something_abstract(binding: etree._Element) -> bool:
    """The actual type is abstract."""
    interface = decl.is_interface(binding, str(binding.get("actualType")))
    actual = decl.spare(binding, "AbstractInterface" if interface else "AbstractDataType")
    binding.set("actualType", actual)
    return bool(actual)
