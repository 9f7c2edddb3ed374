"""A framework that is merely slow leaves its bursts' requirements undecided, and nothing else (10.1.2, 10.1.6)."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Sequence

import msgspec
import pytest
from performing import answer

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.mutants.python.registry import Base, bind
from ucm_cts.adapters.reference.python.connectors import COMM_ERROR, Link
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.derived.messages import message_purposes
from ucm_cts.reference_models.monitor import Monitor

_PATIENCE = 100

_over = threading.Event()


class _Slow(Link):
    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        if _over.is_set():  # the test need not wait for the rest
            return COMM_ERROR
        time.sleep(0.0005)
        return super()._emit(method, arguments)


class takes_its_time_for_a_push(Base):
    """Each push takes half a millisecond."""

    link_class = _Slow


@pytest.fixture
def hurry() -> Iterator[None]:
    _over.clear()
    yield
    _over.set()


def _bursts() -> list[tuple[str, Scenario]]:
    return [one for p in message_purposes() if p.id.startswith("burst") for one in p.scenarios]


@pytest.mark.parametrize(("name", "whole"), _bursts(), ids=[name for name, _ in _bursts()])
@pytest.mark.usefixtures("hurry")
def test_slow_pushes_are_no_hang(name: str, whole: Scenario) -> None:
    asked = msgspec.structs.replace(whole, patience=_PATIENCE)
    reply = answer(asked, bind("slow", takes_its_time_for_a_push))
    assert isinstance(reply, Traced), reply
    assert contradiction(asked, reply.events, reply.stuck) is None
    assert reply.stuck, "the bursts were over in time"
    assert set(reply.stuck) <= set(asked.may_stay)
    verdicts = Monitor(load_life_cycle()).judge(asked, reply.events)
    assert not verdicts.findings
    assert not {"R-10.1.2-10", "R-10.1.6.1-03"} & set(verdicts.exercises)
