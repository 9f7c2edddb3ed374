"""Properties of reading any input, and a command that tests them for a given time.

The command is ``python -m ucm_cts.harness.toolchains.corpus.fuzzing --seconds 3600``.
"""

from __future__ import annotations

import random
import time
from collections import Counter
from collections.abc import Callable
from typing import Any

import click
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from ucm_cts.adapters.contract.metamodel.common import without_lines
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import MOST_PROBLEMS, Reading, read_model
from ucm_cts.adapters.contract.metamodel.writing import write_model
from ucm_cts.harness.models.core_models import CORE
from ucm_cts.harness.toolchains.corpus import strategies
from ucm_cts.harness.toolchains.corpus.schema import violations

LONGEST_MESSAGE = 1000
"""Characters that a message may hold."""

A_ROUND = 500

PRINTED = [write_model(read_model(path.read_bytes(), path.name).model) for path in sorted(CORE.glob("*.xml"))]
LEGAL = st.sampled_from(PRINTED) | strategies.models().map(write_model)


def is_an_answer(reading: Reading, xml: bytes) -> None:
    """A reading is a model and problems in bounds. Raises ``AssertionError``."""
    assert isinstance(reading.model, Model)
    assert len(reading.problems) <= MOST_PROBLEMS + 1
    for problem in reading.problems:
        assert problem.message.isprintable()
        assert len(problem.message) < LONGEST_MESSAGE
        assert 1 <= problem.line <= len(xml) + 1


def written_is_read_again(model: Model) -> None:
    """Writing and reading give an equal model, against which the schema has nothing. Raises ``AssertionError``."""
    written = write_model(model)
    reading = read_model(written, "m.xml")
    assert reading.problems == ()
    assert without_lines(reading.model) == model
    assert violations(written) == []


def schema_agrees(xml: bytes) -> None:
    """Reader and schema find something wrong in the same models. Raises ``AssertionError``."""
    reading = read_model(xml, "m.xml")
    is_an_answer(reading, xml)
    against = violations(xml)
    assert bool(reading.problems) == bool(against), (reading.problems, against)


def nothing_is_raised(xml: bytes) -> None:
    """Reading anything gives an answer. Raises ``AssertionError``."""
    is_an_answer(read_model(xml, "m.xml"), xml)


PROPERTIES: dict[Callable[[Any], None], st.SearchStrategy[Any]] = {
    written_is_read_again: strategies.models(),
    schema_agrees: strategies.spoilt(LEGAL),
    nothing_is_raised: strategies.nearly_models(LEGAL) | st.binary(max_size=200),
}
"""What holds, and of what."""


@click.command()
@click.option("--seconds", default=60.0, show_default=True, help="How long to try.")
@click.option("--seed", "first", type=int, help="Where to begin; drawn if not given.")
def main(seconds: float, first: int | None) -> None:
    """Try random models, spoilt models and near models until the time is over; print how many were tried."""
    number = first if first is not None else random.randrange(1 << 32)
    click.echo(f"seed {number}")
    tried: Counter[str] = Counter()
    slowest: Counter[str] = Counter()
    end = time.monotonic() + seconds
    try:
        while time.monotonic() < end:
            for holds, inputs in PROPERTIES.items():
                _round(holds, inputs, number, tried, slowest)
            number += 1
    finally:
        for name, times in tried.items():
            click.echo(f"{name}: {times} cases, the slowest took {slowest[name] / 1e3:.1f} ms")


def _round(
    holds: Callable[[Any], None],
    inputs: st.SearchStrategy[Any],
    number: int,
    tried: Counter[str],
    slowest: Counter[str],
) -> None:
    name = holds.__name__

    @seed(number)
    @settings(
        max_examples=A_ROUND,
        deadline=None,
        database=None,
        phases=(Phase.generate, Phase.shrink),
        suppress_health_check=list(HealthCheck),
    )
    @given(inputs)
    def attempt(value: Any) -> None:
        tried[name] += 1
        began = time.perf_counter_ns()
        holds(value)
        slowest[name] = max(slowest[name], (time.perf_counter_ns() - began) // 1000)

    attempt()


if __name__ == "__main__":
    main()
