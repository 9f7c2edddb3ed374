"""The values a run produces, from single traces to the whole report. They have no behaviour."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Literal

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.requirements import Level, decides
from ucm_cts.harness.results.statement import Statement
from ucm_cts.reference_models.findings import Finding

Verdict = Literal["pass", "fail", "inconclusive", "not applicable", "error"]
"""A requirement's verdict, in the words of ISO/IEC 9646 (docs/verdicts.md)."""

Overall = Literal["conformant", "not conformant", "inconclusive"]
"""A run's verdict: not conformant if any requirement that decides failed, conformant if all of them that apply passed."""

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

    @property
    def last_line(self) -> str:
        """The last line that a host printed before it ended by itself, but for stack frames of Java; empty if there is none."""
        if self.kind not in ("crash", "exit"):
            return ""
        lines = (line.strip() for line in reversed(self.stacks.splitlines()))
        return next((line for line in lines if line and not line.startswith("at ")), "")


class Execution(Value, frozen=True):
    """One scenario run once: the trace, whole or (after an incident) as far as it is known, in the script's own names."""

    name: str
    scenario: Scenario
    trace: Trace
    incident: Incident | None = None


MODEL_FILE, OUT_FOLDER = "model.xml", "out"
"""What commands of tool chains are shown with, for a model and for the folder of what is made of it."""


class Processed(Value, frozen=True):
    """One model through one command of a tool chain."""

    name: str
    """The model's name in the suite."""
    task: str
    """What the tool chain had to do: ``check``, ``idl``, ``cpp11`` or ``cpp03``."""
    model: str
    """The text of the model."""
    command: tuple[str, ...]
    status: int | None
    """The exit status, None if the command did not end by itself."""
    output: str
    """What the command printed."""
    incident: Incident | None = None


class TraceEvidence(Value, frozen=True, tag="trace"):
    """What shows a finding of a framework."""

    execution: Execution
    steady: Execution | None = None
    """Another run of the same scenario, which does not show the finding."""


class FactEvidence(Value, frozen=True, tag="fact"):
    """What shows a finding of a tool chain."""

    processed: Processed
    twin: str = ""
    """The legal model that the processed one was made of, empty if there is none."""
    place: str = ""
    """The wrong place in a generated file, empty if no generated file is wrong."""
    excerpt: str = ""
    """The lines around that place."""


Evidence = TraceEvidence | FactEvidence


class ReportedFinding(Value, frozen=True):
    """One cause of failure, with the shortest evidence of the run."""

    finding: Finding
    evidence: Evidence | None = None
    """None where the vendor's models or statement show the finding, and nothing was run."""
    occurrences: int = 1
    """How often the run showed this cause."""
    waived: str = ""
    """Why the failure is known, empty if it is not."""
    unstable: str = ""
    """Why it is not held against the product: another run did not show it. Empty if it is held against it."""
    explains: tuple[str, ...] = ()
    """Other requirements that were broken after it in the same scenarios."""

    @property
    def execution(self) -> Execution | None:
        """The execution that shows it, None if no execution does."""
        return self.evidence.execution if isinstance(self.evidence, TraceEvidence) else None

    @property
    def steady(self) -> Execution | None:
        """Another run of that execution's scenario, which does not show it."""
        return self.evidence.steady if isinstance(self.evidence, TraceEvidence) else None


class RequirementResult(Value, frozen=True):
    """Verdict and evidence for one requirement of the catalogue. ``reason`` says why it is not ``pass`` or ``fail``.

    ``caused_by``: a requirement whose violation comes before each of its failures, so that they may follow from it.
    ``seconds``: the time that was spent on scenarios that are to exercise it.
    A recommendation (level ``should``) that fails was not followed: it does not decide the verdict of the run.
    """

    id: str
    clause: str
    title: str
    verdict: Verdict
    exercised: int
    findings: tuple[ReportedFinding, ...] = ()
    reason: str = ""
    caused_by: str = ""
    level: Level = "shall"
    seconds: float = 0.0

    @property
    def decides(self) -> bool:
        """Does it decide the verdict of the run?"""
        return decides(self.level)


class TransitionResult(Value, frozen=True):
    """How often one row of the life-cycle table was exercised and violated, and which readings were observed."""

    row: str
    exercised: int
    violated: int
    readings: tuple[str, ...] = ()


class IncidentReport(Value, frozen=True):
    """An incident with its execution, or the shortest one of all ``occurrences`` that met it.

    ``requirements``: those that the scenarios were to exercise.
    """

    incident: Incident
    execution: Execution
    occurrences: int = 1
    requirements: tuple[str, ...] = ()


Isolation = Literal["bubblewrap", "process", "none", "remote"]
"""Where the code of the product ran: in a sandbox, where it can neither see nor reach the harness; in processes of the same user;
in the process of the harness; or somewhere else, behind a socket. ``docs/verdicts.md`` says what each is worth."""

_WEAKEST_FIRST: tuple[Isolation, ...] = ("none", "process", "remote", "bubblewrap")


def weakest(isolations: Iterable[Isolation]) -> Isolation:
    """What the isolation of several parts of a run is worth together."""
    return min(isolations, key=_WEAKEST_FIRST.index)


class Effort(Value, frozen=True):
    """The effort of a run: ``measures`` are the sums that properties report (overlaps provoked, calls stressed ...),
    ``seconds`` the time spent, by clause.
    """

    measures: dict[str, int] = {}
    seconds: dict[str, float] = {}


class Report(Value, frozen=True):
    """The results of a run, for any product."""

    product: str
    version: str
    profile: str
    verdict: Overall
    requirements: tuple[RequirementResult, ...]
    adapter: str
    """What was named on the command line: an adapter, or the file that describes a tool chain."""
    suite_version: str
    seed: int
    started: str
    seconds: float
    statement: Statement
    effort: Effort = Effort()
    incomplete: str = ""
    """Why the run ended before its end, empty if it did not. What is incomplete is not conformant."""
    selection: str = ""
    """What ``-k`` selected; empty after a run of everything. What was not selected and not shown either has no verdict."""
    isolation: Isolation = "process"


class FrameworkReport(Report, frozen=True, kw_only=True):
    """The results of a run on a framework."""

    transitions: tuple[TransitionResult, ...]
    incidents: tuple[IncidentReport, ...]
    scenarios: int
    events: int
    readings: dict[str, tuple[str, ...]]
    """The readings that were observed, by option."""
    runs: int = 1
    adapter_file: str = ""
    """The file that the adapter was loaded from; empty if it is not known."""
    warnings: tuple[str, ...] = ()
    """What the vendor should know of the adapter, a sentence each."""
    provoked: dict[str, int] = {}
    """How often bodies acted in a callback: by callback, operation that led there, and action."""


SIDES: Mapping[str, tuple[str, str]] = {
    "accepts what is legal": ("legal models", "legal models accepted"),
    "refuses what is broken": ("broken models", "broken models refused"),
}
"""The two sides of a checker, and the measures of each: the models that decide something, and those answered as they must be. The
same measures with ``REQUIREMENTS_WITH`` before them count requirements of which all such models are answered so.
"""

REQUIREMENTS_WITH = "requirements with "


class ToolChainReport(Report, frozen=True, kw_only=True):
    """The results of a run on a tool chain."""

    models: int
    facts: int
    """How many statements about requirements the answers of the tool chain make."""


def incidents_of(report: Report) -> tuple[IncidentReport, ...]:
    """The incidents of a framework. Those of a tool chain belong to the evidence of its findings."""
    return report.incidents if isinstance(report, FrameworkReport) else ()
