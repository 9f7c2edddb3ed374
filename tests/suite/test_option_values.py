"""Every value of every option is taken by a subject that the suite spares: a permission that nobody uses was never tried."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.harness.selftest.values_taken import values_taken

NOT_TAKEN: Mapping[str, str] = {}
"""``option=value`` that no subject can take, each with the reason."""


def test_every_value_of_every_option_is_taken_by_a_spared_subject() -> None:
    taken = values_taken()
    assert {f"{option}={value}" for (option, value), names in taken.items() if not names} == NOT_TAKEN.keys()
