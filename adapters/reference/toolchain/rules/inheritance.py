"""What rules on patterns, policy definitions and component types share: parents, and members that ancestors have already."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.interactions import InteractionPattern
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage, parent_of
from ucm_cts.adapters.reference.toolchain.checking import Complaint


def parents(declared: Declared) -> Iterator[Declared]:
    """What ``declared`` extends or refines, if that is there."""
    parent = parent_of(declared)
    if parent is not None:
        yield parent


def redefined(
    heir: TechnicalPolicyDefinition | InteractionPattern, scope: Scope, field: str, what: str
) -> Iterator[Complaint]:
    """Complaints about members in ``field`` of ``heir`` that an ancestor has, too; ``what`` says what they are."""
    own: tuple[Named, ...] = getattr(heir, field)
    if not own or not heir.extends:
        return
    for ancestor in lineage(Declared(heir, scope))[1:]:
        theirs = {one.name for one in getattr(ancestor.element, field)}
        for one in own:
            if one.name in theirs:
                yield (
                    one,
                    f"{what} {one.name} is one of {ancestor.element.name}, which {heir.name} extends; rename it",
                )
