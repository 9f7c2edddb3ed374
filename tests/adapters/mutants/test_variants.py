"""Conformant variants that use a freedom of the text do not fail, with or without a declaration."""

from __future__ import annotations

import functools

import msgspec
import pytest
from pipeline import Product

from ucm_cts.adapters.mutants.python.subjects import CONTAINER, VARIANTS, Variant, variants_of
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.harness.catalogue.requirements import load_options, load_requirements
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.selftest.trials import Thoroughness, all_variants, examine_variant
from ucm_cts.harness.statement.applicability import why_not

pytestmark = pytest.mark.slow

REQUIREMENTS = {requirement.id: requirement for requirement in load_requirements()}


@functools.cache
def reference() -> Product:
    return Product(ReferenceAdapter)


@pytest.mark.parametrize("name", sorted(VARIANTS.keys() - variants_of(CONTAINER).keys()))
def test_conformant_variant_is_not_failed(name: str) -> None:
    result = examine_variant(all_variants()[name], Thoroughness())
    assert (result.failed, result.incidents, result.trouble) == ((), (), "")


@pytest.mark.parametrize("variant", variants_of(CONTAINER).values(), ids=variants_of(CONTAINER).keys())
def test_conformant_life_cycle_is_not_failed(variant: Variant) -> None:
    product = Product(variant.adapter, variant.readings)
    assert product.failing == {}
    default = default_statement()
    stated = msgspec.structs.replace(default, readings=default.readings | variant.readings)
    undecided = reference().exercised - product.exercised
    assert {requirement for requirement in undecided if why_not(REQUIREMENTS[requirement], stated) is None} == set()
    assert [option for option, values in product.readings.items() if len(values) > 1] == []
    if product.readings != reference().readings:
        assert product.failing_if({option: value for option, (value,) in product.readings.items()}) == {}


OBSERVED = {option for option, values in load_options().items() if "observed" in values}
"""What a vendor need not declare."""


@pytest.mark.parametrize(
    "name", [name for name, variant in variants_of(CONTAINER).items() if OBSERVED >= variant.readings.keys() != set()]
)
def test_variant_without_declarations_is_not_failed(name: str) -> None:
    assert Product(variants_of(CONTAINER)[name].adapter).failing == {}


BELIED = {
    "late-add": {"R-11.2.3-13"},
    "double-start": {"R-11.2.3-15"},
    "late-disconnect": {"R-11.2.3-13"},
    "second-connect": {"R-12.10-24"},
    "start-unconfigured": {"R-11.2.3-07"},
    "stop-when-stopped": {"R-11.2.3-15"},
    "remove-while-connected": {"R-11.2.3-11"},
    "self-connection": {"R-11.2.2.1-08"},
    "remove-provider-in-use": {"R-11.2.3-11"},
    "manager-get-components": {"R-11.2.2.1-14"},
    "manager-start": {"R-11.2.3-06", "R-11.2.3-10"},
    "remove-while-ready": {"R-11.2.3-11"},
    "remove-container-in-use": {"R-11.2.2.2-03"},
    "late-container": {"R-11.2.2.2-02"},
    "callback-failure": {"R-12.10-22", "R-12.10-23"},
    "stop-drain": {"R-11.2.3-17"},
    "unknown-names": {"R-12.10-18", "R-12.10-20"},
}
"""What a vendor fails who declares another reading than the reference framework's; the framework never has the choice of
late-connect.
"""


def test_reference_framework_shows_every_reading_that_it_can() -> None:
    assert set(BELIED) == set(reference().readings) <= {*OBSERVED, "unknown-names"}
    assert reference().failing == {}


@pytest.mark.parametrize(
    ("option", "value"), [(option, value) for option in BELIED for value in load_options()[option][1:]]
)
def test_declared_reading_that_is_not_taken_fails(option: str, value: str) -> None:
    taken = value in reference().readings[option]
    assert set(reference().failing_if({option: value})) == (set() if taken else BELIED[option])
