"""A run carries negative payloads and the edges of their type, and tells payloads apart where the script does."""

from __future__ import annotations

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.purposes.payloads import EDGES, Payloads, with_payloads
from ucm_cts.harness.purposes.selection import load_purposes

SCENARIOS = [scenario for purpose in load_purposes("container") for _, scenario in purpose.scenarios]


def payloads(scenario: Scenario) -> list[int]:
    """Every payload, as often as it is there."""
    found: list[int] = []
    with_payloads(scenario, lambda value: found.append(value) or value)  # type: ignore[func-returns-value]
    return found


def dealt(seed: int) -> list[Scenario]:
    hand = Payloads(seed)
    return [hand.deal(scenario) for scenario in SCENARIOS]


def test_every_run_carries_each_edge_and_other_negative_and_positive_payloads() -> None:
    for seed in range(20):
        disguise = Disguise(seed, "{port}_{element}")
        seen = [value for scenario in dealt(seed) for value in payloads(disguise.scenario(scenario))]
        assert set(EDGES) <= set(seen)
        others = [value for value in seen if value not in EDGES]
        assert min(others) < -(10**9)
        assert max(others) >= 10**9


def test_payloads_and_their_complements_are_the_same_or_distinct_as_before() -> None:
    for seed in range(20):
        disguise = Disguise(seed, "{port}_{element}")
        for plain, scenario in zip(SCENARIOS, dealt(seed), strict=True):
            sent = payloads(disguise.scenario(scenario))
            assert len(set(zip(payloads(plain), sent, strict=True))) == len(set(sent)) == len(set(payloads(plain)))
            assert set(EDGES) & set(payloads(plain)) or not set(sent) & {~value for value in sent}


def test_the_seed_says_which_payloads_go_where() -> None:
    assert dealt(7) == dealt(7)
    assert dealt(7) != dealt(8)


def test_nothing_but_payloads_is_replaced_and_edges_of_a_script_stay() -> None:
    for plain, scenario in zip(SCENARIOS, dealt(3), strict=True):
        assert with_payloads(plain, lambda _: 0) == with_payloads(scenario, lambda _: 0)
    for edge in EDGES:
        kept = [with_payloads(scenario, lambda value, edge=edge: edge) for scenario in SCENARIOS]  # type: ignore[misc]
        assert [Payloads(3).deal(scenario) for scenario in kept] == kept


def test_negative_payloads_come_back_from_their_disguise() -> None:
    for scenario in dealt(5):
        disguise = Disguise(5, "{port}_{element}")
        revealed = disguise.reveal(disguise.scenario(scenario))
        assert payloads(revealed) == payloads(scenario)
