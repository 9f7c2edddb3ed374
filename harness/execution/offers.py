"""What an adapter offers besides containers: the parts of 10.1, and operations for tests. Found out with ``suite/offers.yaml``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.execution.confirmation import PATIENT
from ucm_cts.harness.execution.driver import Answer, Driver, Limits
from ucm_cts.harness.purposes.scripts import Script, read_scripts, to_scenario
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.statement.applicability import ALWAYS_NEEDED, with_policies
from ucm_cts.harness.statement.claims import Offer, claimed

LIMITS = Limits(seconds=3, incident_seconds=10)
"""Of asking: a framework that crashes or hangs offers little."""

OFFERS = SUITE / "offers.yaml"


def offers_of(driver: Driver) -> Mapping[str, Offer]:
    """What the adapter behind ``driver`` offers, by capability and by option. Raises ``WrongUse`` and ``HostUnavailable``."""
    scripts = read_scripts(OFFERS)
    offers: dict[str, Offer] = {}
    _ask(driver, [script for script in scripts if script.scenario == ALWAYS_NEEDED], offers)
    _ask(driver, [script for script in scripts if script.scenario != ALWAYS_NEEDED], offers)
    return offers


def _ask(driver: Driver, scripts: Sequence[Script], offers: dict[str, Offer]) -> None:
    """Add to ``offers`` what the answers to ``scripts`` show; components have what the framework was found to need."""
    statement = claimed(default_statement(), offers)
    answers = driver.run((script.scenario, with_policies(to_scenario(script), statement)) for script in scripts)
    for script, first in zip(scripts, answers, strict=True):
        answer = _asked_again(driver, first) if _may_be_late(first) else first
        known = offers.get(script.scenario)
        if known is None or known.lacking:
            lacking = _lacking(answer, offers)
            declared = dict(reading.split("=") for reading in script.under) if not lacking else {}
            offers[script.scenario] = known if known is not None and lacking else Offer(lacking, declared)


def _may_be_late(answer: Answer) -> bool:
    """Whether ``answer`` may say more of a loaded machine than of the adapter."""
    if answer.incident is not None:
        return answer.incident.kind != "untried" and not answer.incident.reproduced
    return any(isinstance(event, t.Timeout) for event in answer.trace)


def _asked_again(driver: Driver, first: Answer) -> Answer:
    """Another answer to the same scenario, with more patience; ``first`` if there is none."""
    second = driver.again(first.name, first.scenario, PATIENT)
    return second if second.trace else first


def _lacking(answer: Answer, offers: Mapping[str, Offer]) -> str:
    """How ``answer`` shows that the adapter does not offer what its scenario asks for, or uses of what ``offers`` has not; empty if it does."""
    if answer.incident is not None and answer.incident.kind == "untried":
        links = {step.connector for step in answer.scenario.steps if isinstance(step, s.Link)}
        needed = [connector for connector in links if connector in offers and offers[connector].lacking]
        return f"it needs {needed[0]}" if needed else "not tried after other crashes and hangs"
    if answer.incident is not None:
        return one_line(f"{answer.incident.kind}: {answer.incident.detail}", 160)
    asked = {event.body for event in answer.trace if isinstance(event, t.Request)}
    for event in answer.trace:
        if isinstance(event, t.Skip | t.Raise | t.Timeout):
            operation = s.operation(answer.scenario.steps[event.step])
            match event:
                case t.Skip():
                    return f"{operation} is not offered"
                case t.Timeout():
                    return "no component is executed"
                case t.Raise():
                    return f"{operation} raises {event.error}"
        if isinstance(event, t.Reply) and event.failed:
            return "calls of it raise"
    calls = [hook for part in answer.scenario.components.values() for hook in part.plan if hook == "exchange"]
    return "components do not get its port element" if calls and not asked else ""
