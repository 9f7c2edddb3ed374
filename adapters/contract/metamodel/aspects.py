"""Technical aspects, technical policy definitions and programming languages (9.4)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.contracts import ConfigurationParameter, ContractModule
from ucm_cts.adapters.contract.metamodel.interactions import PortElement


class TechnicalAspect(Named, frozen=True, kw_only=True):
    """A technical aspect (9.4.3.1).

    ``multiplicity``: anyNumber, atMostOne, exactlyOne or atLeastOne.
    """

    multiplicity: str = ""


class TechnicalPolicyDefinition(Named, frozen=True, kw_only=True):
    """A technical policy definition (9.4.3.2).

    ``technical_aspect``: reference to its aspect.
    ``applicability``: onComponent, onPort or onBoth.
    ``extends``: reference to its parent, empty if there is none.
    ``port_elements``: what it provides to and requires from components.
    ``configuration_parameters``: its settings.
    """

    technical_aspect: str = ""
    applicability: str = ""
    extends: str = ""
    port_elements: tuple[PortElement, ...] = ()
    configuration_parameters: tuple[ConfigurationParameter, ...] = ()


class Language(Named, frozen=True, kw_only=True):
    """A programming language that the platform supports (9.4.4.2)."""


class ProgrammingLanguages(Element, frozen=True, kw_only=True):
    """At least one language (9.4.4.1)."""

    languages: tuple[Language, ...] = ()


class NonfunctionalAspectModule(Named, frozen=True, kw_only=True):
    """Declarations of aspects and policies (9.4.2.1)."""

    nonfunctional_aspect_modules: tuple[NonfunctionalAspectModule, ...] = ()
    contract_modules: tuple[ContractModule, ...] = ()
    technical_aspects: tuple[TechnicalAspect, ...] = ()
    policy_definitions: tuple[TechnicalPolicyDefinition, ...] = ()
    supported_languages: tuple[ProgrammingLanguages, ...] = ()
