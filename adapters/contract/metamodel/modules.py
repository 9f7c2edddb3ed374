"""Modules that gather others, and the whole model (9.1.4)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.aspects import NonfunctionalAspectModule
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.components import ComponentModule
from ucm_cts.adapters.contract.metamodel.contracts import ContractModule
from ucm_cts.adapters.contract.metamodel.interactions import InteractionModule


class ApplicationModule(Named, frozen=True, kw_only=True):
    """Gathers modules of an application (9.1.4.7)."""

    submodules: tuple[ApplicationModule | ComponentModule | ContractModule, ...] = ()


class PlatformModule(Named, frozen=True, kw_only=True):
    """Gathers modules of a platform (9.1.4.8)."""

    submodules: tuple[PlatformModule | InteractionModule | NonfunctionalAspectModule | ContractModule, ...] = ()


Module = (
    ApplicationModule
    | PlatformModule
    | ContractModule
    | InteractionModule
    | NonfunctionalAspectModule
    | ComponentModule
)
"""What has names of its own inside (9.1.4.4)."""

MODULES = (
    ApplicationModule,
    PlatformModule,
    ContractModule,
    InteractionModule,
    NonfunctionalAspectModule,
    ComponentModule,
)


class Model(Element, frozen=True, kw_only=True):
    """One file: its outermost modules. The root that holds several of them has no name and is no scope."""

    modules: tuple[Module, ...] = ()
