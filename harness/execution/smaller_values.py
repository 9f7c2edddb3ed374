"""The smallest value that still shows a failure: hypothesis draws and shrinks, each try is a scenario for the framework.

A value that fails in a long scenario is sent anew in a short one, with what it is made of and one simple value beside it, so
that it still fails for the same reason. First its parts are tried alone, then smaller values of the part that fails.
"""

from __future__ import annotations

import random
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType, Datum, Parameter, String
from ucm_cts.adapters.contract.data_values import misfit, parts
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Enter, Exit, Request
from ucm_cts.harness.purposes.data.corner_values import corners
from ucm_cts.harness.purposes.data.scenarios import Load, messages, services, with_parts
from ucm_cts.harness.purposes.data.typed_values import values
from ucm_cts.harness.results.values import Execution
from ucm_cts.reference_models.findings import Finding

TRIES = 200
"""How many values are drawn for one failure; shrinking draws some more."""

_PARTS = 60
_PAUSE = 20
"""Milliseconds after which a message counts as lost; a short wait makes shrinking fast."""

_HASTE = 5
"""Tries wait for less time: many of them wait in vain."""

FirstFailing = Callable[[Sequence[Scenario]], int | None]
"""Runs scenarios and returns the first one that still shows the failure."""


@dataclass(frozen=True)
class _Sent:
    """A value that a connector was given in a scenario."""

    connector: str
    of: AnyType
    value: Datum
    patience: int

    @property
    def size(self) -> tuple[int, bytes]:
        """Smaller values have smaller sizes."""
        encoded = msgspec.json.encode(self.value)
        return len(encoded), encoded

    def scenario(self, pause: int = 0) -> Scenario:
        """A short scenario that sends it; with ``pause``, the wait for a message ends after so many milliseconds."""
        loads = with_parts([Load("value", self.of, (corners(self.of)[0], self.value))])
        made = services(loads) if self.connector == s.SERVICE_CONNECTOR else messages(loads, pause)
        return msgspec.structs.replace(made, patience=self.patience)


def smallest(finding: Finding, execution: Execution, first_failing: FirstFailing, seed: int, until: float) -> None:
    """Search smaller values of those that ``finding`` is about, if it is about any. The last scenario that
    ``first_failing`` finds to fail is the one with the smallest.

    Ends soon after ``until``, a time of ``time.monotonic``.
    """
    search = _Search(first_failing, until)
    wholes = list(_sent_in(finding, execution))
    try:
        part = next((part for whole in wholes for part in _parts_of(whole) if search.fails(part)), None)
        if part is not None:
            _draw_smaller(_cut(part, search), search, seed)
    except _TimeIsUp:
        pass
    if search.best is not None:
        first_failing([search.best.scenario()])
        first_failing([search.best.scenario(_PAUSE)])


class _TimeIsUp(BaseException):
    """The time for tries is used up. Hypothesis does not catch it."""


class _Search:
    """Tries values, each once, and remembers the smallest that failed."""

    def __init__(self, first_failing: FirstFailing, until: float) -> None:
        self._first_failing = first_failing
        self._until = until
        self._tried: dict[bytes, bool] = {}
        self.best: _Sent | None = None

    def fails(self, sent: _Sent) -> bool:
        """Does ``sent`` show the failure? Raises ``_TimeIsUp``."""
        key = msgspec.json.encode((sent.connector, sent.of, sent.value))
        if key not in self._tried:
            if time.monotonic() > self._until:
                raise _TimeIsUp
            self._tried[key] = self._first_failing([sent.scenario()]) is not None
            if self._tried[key] and (self.best is None or self.best.of != sent.of or sent.size < self.best.size):
                self.best = sent
        return self._tried[key]


def _parts_of(whole: _Sent) -> Sequence[_Sent]:
    """The parts of ``whole`` and itself, the smallest first."""
    inside = [replace(whole, of=of, value=value) for of, value in parts(whole.of, whole.value)]
    found = {(part.size, msgspec.json.encode(part.of)): part for part in inside}
    return [part for _, part in sorted(found.items(), key=lambda item: item[0])][-_PARTS:]


def _cut(part: _Sent, search: _Search) -> _Sent:
    """``part`` without the end of a long string or sequence, and with simple characters."""
    while isinstance(part.value, str | list):
        length = len(part.value)
        cuts = [part.value[:shorter] for shorter in dict.fromkeys((length // 2, length * 3 // 4, max(length - 1, 0)))]
        if isinstance(part.of, String):
            cuts.insert(0, "a" * length)
        smaller = (replace(part, value=cut) for cut in cuts if cut != part.value and not misfit(part.of, cut))
        found = next((one for one in smaller if search.fails(one)), None)
        if found is None:
            break
        part = found
    return part


def _draw_smaller(part: _Sent, search: _Search, seed: int) -> None:
    """Have hypothesis search the smallest value of the type that fails."""
    import hypothesis

    settings = hypothesis.settings(
        max_examples=TRIES,
        database=None,
        deadline=None,
        phases=(hypothesis.Phase.generate, hypothesis.Phase.shrink),
        suppress_health_check=list(hypothesis.HealthCheck),
    )
    with _without_traces(), suppress(hypothesis.errors.NoSuchExample):
        hypothesis.find(
            values(part.of, around=part.value),
            lambda value: search.fails(replace(part, value=value)),
            settings=settings,
            random=random.Random(seed),
        )


@contextmanager
def _without_traces() -> Iterator[None]:
    """Keeps hypothesis from writing its cache into the user's folder."""
    from hypothesis import configuration

    with tempfile.TemporaryDirectory() as home:
        configuration.set_hypothesis_home_dir(home)
        try:
            yield
        finally:
            configuration.set_hypothesis_home_dir(None)


def _sent_in(finding: Finding, execution: Execution) -> Iterator[_Sent]:
    """The values of the calls and answers that ``finding`` points at."""
    scenario = execution.scenario
    inside: dict[tuple[str, int, int], Enter] = {}
    for event in execution.trace:
        if isinstance(event, Enter) and event.hook == "method":
            inside[event.component, event.instance, event.thread] = event
        if event.n not in finding.events:
            continue
        if isinstance(event, Request) and event.arguments is not None:
            yield from _typed(scenario, event.component, event.port, event.method, "arguments", event.arguments)
        elif isinstance(event, Exit) and event.results is not None:
            enter = inside.get((event.component, event.instance, event.thread))
            if enter is not None:
                yield from _typed(scenario, event.component, enter.port, enter.method, "results", event.results)


def _typed(
    scenario: Scenario, component: str, port: str | None, method: str | None, which: str, given: Sequence[Datum]
) -> Iterator[_Sent]:
    """``given`` with the types that the interface of the port element has for them."""
    declaration = scenario.components.get(component)
    name = declaration.ports.get(port or "") if declaration is not None else None
    interface = scenario.interfaces.get(name or "")
    described = interface.methods.get(method or "") if interface is not None else None
    connector = next((x.connector for x in scenario.steps if isinstance(x, s.Link) and x.interface == name), None)
    if described is None or connector is None:
        return
    parameters: Sequence[Parameter] = described.arguments if which == "arguments" else described.results
    if len(parameters) == len(given):
        for parameter, value in zip(parameters, given, strict=True):
            if not misfit(parameter.of, value):
                yield _Sent(connector, parameter.of, value, max(1, scenario.patience // _HASTE))
