"""The values a run produces, from single traces to the whole report. They have no behaviour."""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.results.statement import Statement
from ucm_cts.reference_models.findings import Finding

Verdict = Literal["pass", "fail", "inconclusive", "not applicable", "error"]
"""A requirement's verdict, in the words of ISO/IEC 9646 (docs/verdicts.md)."""

Overall = Literal["conformant", "not conformant", "inconclusive"]
"""A run's verdict: not conformant if any requirement failed, conformant if all that apply passed."""

IncidentKind = Literal[
    "crash",
    "exit",
    "hang",
    "memory",
    "flood",
    "garbage",
    "protocol",
    "refused",
    "contradiction",
    "unreachable",
    "untried",
]
"""How a host can fail to answer: killed by a signal; ended; silent past the deadline; too much memory; too much output;
not JSON; JSON that breaks the schema; refused by the adapter itself; a trace that cannot be true; no host to be had;
not tried, because earlier incidents had taken too long."""

FRAMEWORK_INCIDENTS: frozenset[IncidentKind] = frozenset(("crash", "exit", "hang", "memory"))
"""Incidents that are the framework's doing; the others, but for ``untried``, are the adapter's and lead to ``error``, never to
``fail``."""


class Incident(Value, frozen=True):
    """A scenario that did not come back with a trace, or came back with one that cannot be true.

    ``detail`` names the signal, exit status, limit or offending field; ``stacks`` is what the host printed while it
    was interrupted or died, empty if nothing; ``reproduced``: whether the second run met the incident again.
    """

    kind: IncidentKind
    detail: str
    stacks: str = ""
    reproduced: bool = True


class Execution(Value, frozen=True):
    """One scenario run once: the trace, whole or (after an incident) as far as it is known, in the script's own names."""

    name: str
    scenario: Scenario
    trace: Trace
    incident: Incident | None = None


MODEL_FILE, OUT_FOLDER = "model.xml", "out"
"""What commands of tool chains are shown with, for a model and for the folder of what is made of it."""


class Processed(Value, frozen=True):
    """One model through one command of a tool chain. ``name`` is the question's, ``task`` what was asked, ``status`` the exit
    status, None if it did not end by itself; ``output`` what it printed. ``twin`` is the legal model that ``model`` was
    made of, empty if it was not; ``place`` is where in a generated file it is wrong, ``excerpt`` what stands there.
    """

    name: str
    task: str
    model: str
    command: tuple[str, ...]
    status: int | None
    output: str
    incident: Incident | None = None
    twin: str = ""
    place: str = ""
    excerpt: str = ""


class FailedExecution(Value, frozen=True):
    """A finding with the shortest execution that shows it, and how many executions of the run showed the same cause.

    There is no ``execution`` where models or the vendor's statement show it and nothing was run, and ``processed`` instead where a
    tool chain was asked. ``unstable`` says why it is
    not held against the framework: a second look did not show it. ``steady`` is what that look saw instead.
    """

    finding: Finding
    execution: Execution | None
    occurrences: int = 1
    waived: str = ""
    unstable: str = ""
    steady: Execution | None = None
    processed: Processed | None = None


class RequirementResult(Value, frozen=True):
    """Verdict and evidence for one requirement of the catalogue. ``reason`` says why it is not ``pass`` or ``fail``."""

    id: str
    clause: str
    title: str
    verdict: Verdict
    exercised: int
    findings: tuple[FailedExecution, ...] = ()
    reason: str = ""


class TransitionResult(Value, frozen=True):
    """How often one row of the life-cycle table was exercised and violated, and which readings were observed."""

    row: str
    exercised: int
    violated: int
    readings: tuple[str, ...] = ()


class IncidentReport(Value, frozen=True):
    """An incident with the execution it cost, or the shortest one of all ``occurrences`` that met it."""

    incident: Incident
    execution: Execution
    occurrences: int = 1


class Effort(Value, frozen=True):
    """What was behind the verdicts: ``measures`` are what rules added up (overlaps provoked, calls stressed ...),
    ``seconds`` where the time went, by clause.
    """

    measures: dict[str, int] = {}
    seconds: dict[str, float] = {}


class Report(Value, frozen=True):
    """Everything one run says, ready to be written as HTML, JSON and JUnit."""

    product: str
    version: str
    profile: str
    verdict: Overall
    requirements: tuple[RequirementResult, ...]
    transitions: tuple[TransitionResult, ...]
    incidents: tuple[IncidentReport, ...]
    adapter: str
    suite_version: str
    seed: int
    started: str
    seconds: float
    scenarios: int
    events: int
    statement: Statement
    readings: dict[str, tuple[str, ...]]
    effort: Effort = Effort()
    runs: int = 1
