"""The record of a run on a tool chain: what it was asked and what came back, so that the run can be judged again without it.

A ``Recorder`` stands before the tool chain and writes down; a ``Replay`` stands in its place and reads out. ``recorded_form.py`` makes
bytes of a record and reads bytes that may be hostile.
"""

from __future__ import annotations

import bisect
import hashlib
import threading
import time
from collections.abc import Sequence

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Incident, Isolation, Processed, ToolChainReport
from ucm_cts.harness.toolchains.commands.description import Task, ToolChain
from ucm_cts.harness.toolchains.commands.processing import SEVERAL, Processor, Response, oddity, response_to


class Said(Value, frozen=True):
    """What came back of one model.

    ``model``: the fingerprint of its text, which is derived again from suite and seed.
    ``command``, ``output``, and the values of ``files``: places in the ``commands`` and ``texts`` of the record.
    ``status``: the exit status; None if there is none.
    ``files``: the files that were written, by their names relative to the folder they were to be written to.
    """

    name: str
    model: str
    command: int
    status: int | None
    output: int
    incident: Incident | None = None
    files: dict[str, int] = {}


class Call(Value, frozen=True):
    """One call for some models, from ``begun`` to ``ended``: seconds since the first call.

    ``again_for``: the requirement whose failure was looked at again; empty for a first look.
    """

    begun: float
    ended: float
    said: tuple[Said, ...]
    again_for: str = ""


class ToolChainRecord(Value, frozen=True, kw_only=True):
    """All calls of a run, first looks in the order of the models, then second looks in the order of the requirements.

    ``toolchain``: its description with the command for ``task`` only, and without the folder where it was.
    ``started``, ``seconds``: when the run began, ISO 8601, and how long it took.
    ``jobs``: how many calls there could be at a time.
    ``source``: the file of the description, as it was named.
    ``warnings``: what the vendor was told of how the calls went. ``isolation``: where the commands ran.
    ``commands``, ``texts``: what calls refer to, each once, in the order of the first references.
    """

    toolchain: ToolChain
    task: Task
    seed: int
    started: str
    seconds: float
    jobs: int
    calls: tuple[Call, ...]
    commands: tuple[tuple[str, ...], ...]
    texts: tuple[str, ...]
    source: str = ""
    warnings: tuple[str, ...] = ()
    isolation: Isolation = "process"


def fingerprint(text: str) -> str:
    """Tells the models of one run from those of another; whoever forges a record knows it."""
    return hashlib.blake2b(text.encode(), digest_size=8).hexdigest()


class Recorder:
    """Stands before a processor and keeps what it is asked and what it answers."""

    def __init__(self, processor: Processor) -> None:
        self._processor = processor
        self._writing = threading.Lock()
        self._first: float | None = None
        self._kept: list[tuple[float, float, str, list[Response]]] = []

    @property
    def isolation(self) -> Isolation:
        return self._processor.isolation

    def at_once(self, task: Task) -> int:
        return self._processor.at_once(task)

    def warnings(self) -> tuple[str, ...]:
        return self._processor.warnings()

    def process(self, task: Task, name: str, text: str, again_for: str = "") -> Response:
        begun = self._now()
        response = self._processor.process(task, name, text, again_for)
        self._keep(begun, again_for, [response])
        return response

    def process_all(self, task: Task, models: Sequence[tuple[str, str]]) -> list[Response]:
        begun = self._now()
        responses = self._processor.process_all(task, models)
        self._keep(begun, "", responses)
        return responses

    def _now(self) -> float:
        with self._writing:
            now = time.monotonic()
            self._first = now if self._first is None else self._first
            return now - self._first

    def _keep(self, begun: float, again_for: str, responses: list[Response]) -> None:
        ended = self._now()
        with self._writing:
            self._kept.append((begun, ended, again_for, responses))

    def record(
        self, toolchain: ToolChain, task: Task, report: ToolChainReport, names: Sequence[str], jobs: int
    ) -> ToolChainRecord:
        """What was recorded of the run on ``toolchain`` that ``report`` is of; ``names`` are those of its models, in order."""
        place = {name: number for number, name in enumerate(names)}
        with self._writing:
            kept = sorted(self._kept, key=lambda k: (k[2], k[0] if k[2] else place[k[3][0].processed.name]))
        commands: dict[tuple[str, ...], int] = {}
        texts: dict[str, int] = {}

        def said(response: Response) -> Said:
            processed = response.processed
            return Said(
                processed.name,
                fingerprint(processed.model),
                commands.setdefault(processed.command, len(commands)),
                processed.status,
                texts.setdefault(processed.output, len(texts)),
                processed.incident,
                {name: texts.setdefault(text, len(texts)) for name, text in response.files.items()},
            )

        calls = tuple(
            Call(round(begun, 3), round(ended, 3), tuple(map(said, responses)), again_for)
            for begun, ended, again_for, responses in kept
        )
        return ToolChainRecord(
            toolchain=_anywhere(toolchain, task),
            task=task,
            seed=report.seed,
            started=report.started,
            seconds=report.seconds,
            jobs=jobs,
            calls=calls,
            commands=tuple(commands),
            texts=tuple(texts),
            source=report.adapter,
            warnings=self.warnings(),
            isolation=self.isolation,
        )


def _anywhere(toolchain: ToolChain, task: Task) -> ToolChain:
    """``toolchain`` with one command, whose words do not tell where it was."""
    command = toolchain.command_for(task)
    if command is not None:
        below = f"{toolchain.folder}/"
        command = msgspec.structs.replace(
            command,
            libraries=tuple(word.removeprefix(below) for word in command.libraries),
            compiler=tuple(word.removeprefix(below) for word in command.compiler),
        )
    commands = {**dict.fromkeys(("check", "idl", "cpp11", "cpp03")), task: command}
    return msgspec.structs.replace(toolchain, **commands, folder="", source="")


class Replay:
    """A processor that answers from a record what the tool chain answered. Ask it for ``problems`` when all is asked."""

    def __init__(self, record: ToolChainRecord, of_another_suite: bool = False) -> None:
        """``record`` is one that ``decoded`` gave, or a ``Recorder``. Those of another suite answer only for models that this one has,
        too.
        """
        self._record = record
        self._of_another_suite = of_another_suite
        self._lock = threading.Lock()
        self._said = {(call.again_for, said.name): said for call in record.calls for said in call.said}
        self._asked: dict[tuple[str, str], None] = {}
        self._missing: list[str] = []
        self._missing_again: list[str] = []
        self._altered: list[str] = []
        self._impossible: list[str] = []

    @property
    def isolation(self) -> Isolation:
        return self._record.isolation

    def at_once(self, task: Task) -> int:
        return SEVERAL

    def warnings(self) -> tuple[str, ...]:
        return self._record.warnings

    def process_all(self, task: Task, models: Sequence[tuple[str, str]]) -> list[Response]:
        return [self.process(task, name, text) for name, text in models]

    def process(self, task: Task, name: str, text: str, again_for: str = "") -> Response:
        """What was recorded. A second look that is missing shows what the first one did: leaving it out makes nothing better."""
        with self._lock:
            self._asked[again_for, name] = None
            said = self._said.get((again_for, name))
            if said is None and again_for:
                self._missing_again.append(f"{name} for {again_for}")
                said = self._said.get(("", name))
            elif said is None:
                self._missing.append(name)
            if said is not None and said.model != fingerprint(text):
                self._altered.append(name)
                said = None if self._of_another_suite else said
            if said is None:
                nothing = Incident("untried", "the record does not have it")
                return Response(Processed(name, task, text, (), None, "", nothing), None)
        return self._response(said, task, text)

    def _response(self, said: Said, task: Task, text: str) -> Response:
        """``said`` as a response. Whether the model was accepted, and which lines are named, is derived again."""
        texts, described = self._record.texts, self._record.toolchain.command_for(task)
        output = texts[said.output]
        incident, why = said.incident, ""
        if described is None:
            raise ValueError(f"the record has no command for {task}")
        shown = oddity(said.status, output, described)
        if said.status is None and incident is None:
            incident = Incident("untried", "the record has no exit status")
            why = "has neither an exit status nor an incident"
        elif said.status is not None and incident != shown:
            why = f"has exit status {said.status}, which does not go with {_worded(incident)}"
            incident = shown
        elif said.files and said.status != 0:
            why = "was not accepted, and has files"
        if why:
            with self._lock:
                self._impossible.append(f"{said.name} {why}")
        processed = Processed(said.name, task, text, self._record.commands[said.command], said.status, output, incident)
        return response_to(processed, described, {name: texts[number] for name, number in said.files.items()})

    def problems(self, names: Sequence[str]) -> tuple[str, ...]:
        """What in the record does not go with what was asked, a line for each kind; ``names`` are those of the models, in order."""
        recorded = [name for again_for, name in self._said if not again_for]
        surplus = [name for name in recorded if ("", name) not in self._asked]
        again = [f"{name} for {id_}" for id_, name in self._said if id_ and (id_, name) not in self._asked]
        altered = sorted(set(self._altered))
        found: list[str] = []
        if 2 * len(altered) > len(names):  # models without names of their own are the same in all runs
            those = f"{len(altered)} of {len(names)} models are not those that this suite makes with this seed"
            found.append(f"the record is of another run: {those}")
            altered = []
        for what, which in (
            ("models are not those that this suite makes with this seed", altered),
            ("models are missing in the record", sorted(self._missing)),
            ("models in the record are none of this run", surplus),
            ("second looks that failures call for are missing in the record", sorted(self._missing_again)),
            ("second looks in the record are due to no failure", again),
            ("answers in the record are impossible", sorted(set(self._impossible))),
        ):
            if which:
                found.append(f"{what}: {_some(which)}")
        if set(recorded) == set(names) and recorded != list(names):
            first = next(name for name, due in zip(recorded, names, strict=True) if name != due)
            found.append(f"the record has models in another order than they are asked in; the first one is {first}")
        return tuple(found)


_SHOWN = 3
"""How many names a problem shows."""


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"{', '.join(one_line(name) for name in names[:_SHOWN])}{more}"


def _worded(incident: Incident | None) -> str:
    return f"the incident '{incident.kind}: {one_line(incident.detail, 80)}'" if incident else "an answer"


def impossible_times(record: ToolChainRecord) -> tuple[str, ...]:
    """What is wrong with the times: calls of one run follow each other, and no more go on at a time than there were jobs."""
    first = [call for call in record.calls if not call.again_for]
    again = [call for call in record.calls if call.again_for]
    found: list[str] = []
    if any(not 0 <= call.begun <= call.ended <= record.seconds for call in record.calls):
        found.append("a call began or ended outside the time of the run")
    if _is_overlapping(first, record.jobs) or _is_overlapping(again, record.jobs):
        found.append(f"more calls go on at a time than the {record.jobs} that the run allowed")
    ends: list[float] = []
    for number, call in enumerate(first):
        # of as many calls as there are jobs, one had ended before the next could begin
        if bisect.bisect_right(ends, call.begun) < number - record.jobs + 1:
            found.append(f"{one_line(call.said[0].name)} was asked before its turn")
            break
        bisect.insort(ends, call.ended)
    if first and again and min(c.begun for c in again) < max(c.ended for c in first):
        found.append("a failure was looked at again before all models had been asked once")
    waited = record.toolchain.seconds
    for call in record.calls:
        hung = next((s for s in call.said if s.incident is not None and s.incident.kind == "hang"), None)
        if hung is not None and call.ended - call.begun < waited - _CLOCK:
            found.append(
                f"{one_line(hung.name)} came to no end, it says, in a call shorter than the limit of {waited:g} s"
            )
            break
    return tuple(found)


_CLOCK = 0.01
"""Seconds by which rounded times may differ."""


def _is_overlapping(calls: Sequence[Call], jobs: int) -> bool:
    moments = sorted([(call.begun, 1) for call in calls] + [(call.ended, -1) for call in calls])
    at_once = 0
    for _, change in moments:
        at_once += change
        if at_once > jobs:
            return True
    return False
