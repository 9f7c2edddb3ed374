"""From a model to what clause 13 makes of it. Pure: no file, no process."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.reference_models.mapping.cpp.components import Components
from ucm_cts.reference_models.mapping.cpp.context import Context
from ucm_cts.reference_models.mapping.cpp.data_types import constants, data_types, exceptions, modules
from ucm_cts.reference_models.mapping.cpp.expected import ExpectedCpp, Standard
from ucm_cts.reference_models.mapping.cpp.interfaces import Interfaces


def expected_cpp(model: Model, standard: Standard, readings: Mapping[str, str]) -> ExpectedCpp:
    """What headers generated from ``model`` must hold; ``readings`` are the vendor's values of the options of clause 13.

    ``model`` is well-formed. Nothing is expected of what the text does not say how to spell.
    """
    context = Context(model, standard, readings)
    interfaces = Interfaces(context)
    components = Components(context, interfaces)
    expected = (
        *modules(context),
        *data_types(context),
        *constants(context),
        *exceptions(context),
        *interfaces.expected(),
        *components.expected(),
    )
    abstract = (*interfaces.abstract.values(), *components.abstract)
    return ExpectedCpp(standard, tuple(dict.fromkeys(expected)), abstract)
