"""A finding of a tool chain in reports: the model, its differences from the legal twin, the command and its response."""

from __future__ import annotations

import difflib
import shlex
from collections.abc import Sequence
from dataclasses import dataclass

from ucm_cts.harness.results.values import MODEL_FILE, OUT_FOLDER, FactEvidence, Processed

AROUND = 4
"""Lines shown before and after each one that was changed."""

LONGEST = 60
"""Lines of a model that is shown without a twin."""


@dataclass(frozen=True)
class ModelLine:
    """A line of a model: ``mark`` is ``+`` for one that its legal twin has not, ``-`` for one that only the twin has, a blank
    for others, and ``…`` where lines are left out; ``number`` counts in the model itself, None for the twin's.
    """

    mark: str
    number: int | None
    text: str


def model_lines(evidence: FactEvidence) -> list[ModelLine]:
    """The lines of the model that a reader needs."""
    lines = evidence.processed.model.splitlines()
    if not evidence.twin:
        shown = [ModelLine(" ", number, line) for number, line in enumerate(lines[:LONGEST], 1)]
        left = len(lines) - len(shown)
        return [*shown, ModelLine("…", None, f"{left} more lines")] if left else shown
    before = evidence.twin.splitlines()
    found: list[ModelLine] = []
    for group in difflib.SequenceMatcher(None, before, lines, autojunk=False).get_grouped_opcodes(AROUND):
        if found or group[0][3] > 0:
            found.append(ModelLine("…", None, ""))
        for kind, first, last, start, end in group:
            if kind in ("replace", "delete"):
                found += [ModelLine("-", None, line) for line in before[first:last]]
            mark = " " if kind == "equal" else "+"
            found += [ModelLine(mark, start + at + 1, line) for at, line in enumerate(lines[start:end])]
    return found


def model_text(lines: Sequence[ModelLine]) -> str:
    """``lines`` with their numbers."""
    return "\n".join(f"{line.mark} {line.number or '':>4}  {line.text}".rstrip() for line in lines)


def command_text(processed: Processed, file: str) -> str:
    """The command that processes ``file``, the saved model, again, from the report's folder."""
    words = [word.replace(MODEL_FILE, file) for word in processed.command]
    folder = "" if processed.task == "check" else f"mkdir -p {OUT_FOLDER} && "
    return folder + shlex.join(words)


def ending(processed: Processed) -> str:
    """How the command ended."""
    if processed.incident is not None:
        return f"{processed.incident.kind}: {processed.incident.detail}"
    return f"exit status {processed.status}"


@dataclass(frozen=True)
class FactShown:
    """Evidence of a tool chain as a page shows it; without lines of the model once the page is full."""

    evidence: FactEvidence
    command: str
    lines: tuple[ModelLine, ...]
    ending: str

    @property
    def size(self) -> int:
        """Bytes that it adds to the page."""
        return sum(len(line.text.encode()) for line in self.lines)


def fact_shown(evidence: FactEvidence, file: str, whole: bool) -> FactShown:
    """``evidence`` for a page, the lines of the model only if it is shown ``whole``; ``file`` is the saved model."""
    lines = tuple(model_lines(evidence)) if whole else ()
    return FactShown(evidence, command_text(evidence.processed, file), lines, ending(evidence.processed))


def fact_text(evidence: FactEvidence) -> str:
    """All of it as plain text, for the log of a CI system."""
    processed = evidence.processed
    parts = [f"model {processed.name}", model_text(model_lines(evidence)), f"{ending(processed)}"]
    if processed.output:
        parts.append(f"output:\n{processed.output.rstrip()}")
    if evidence.place:
        parts.append(f"{evidence.place}:\n{evidence.excerpt}")
    return "\n\n".join(parts)
