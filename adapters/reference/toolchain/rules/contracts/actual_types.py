"""The type that a reference means once all aliases are followed."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.contracts import (
    AbstractDataType,
    Alias,
    Array,
    Constant,
    DataType,
    Sequence,
    StructureField,
    UnionCase,
)
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope

DATA_TYPES = (DataType, AbstractDataType)
"""What may stand where a data type is asked for (9.2.2.2)."""

TypedInContracts = StructureField | UnionCase | Alias | Array | Sequence | Constant
"""The parts of data types and constants that refer to a data type."""


def actual_type(reference: str, scope: Scope) -> Declared | None:
    """The data type that ``reference`` means in ``scope`` and that is no alias; None if there is none, or only a circle of aliases."""
    found = scope.find_one_of(reference, DATA_TYPES)
    if found is None or not isinstance(found.element, Alias):
        return found
    seen: set[int] = set()
    while found is not None and isinstance(found.element, Alias):
        if id(found.element) in seen:
            return None
        seen.add(id(found.element))
        found = found.scope.find(found.element.type, *DATA_TYPES)
    return found
