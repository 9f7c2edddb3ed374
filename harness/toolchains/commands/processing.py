"""Has a tool chain do a task with models, and collects its responses."""

from __future__ import annotations

import os
import re
import shutil
import signal
import threading
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.harness.hosting.sandbox import GIVEN_UP, why_none
from ucm_cts.harness.hosting.view import view_of
from ucm_cts.harness.results.values import MODEL_FILE, OUT_FOLDER, Incident, Isolation, Processed
from ucm_cts.harness.toolchains.commands.bounded import Ended, own_folder, run
from ucm_cts.harness.toolchains.commands.description import MODEL, MODELS, OUT, Command, Task, ToolChain, program
from ucm_cts.harness.toolchains.commands.expressions import matches

SEVERAL = 40
"""Models for one call that takes several."""

_OUTPUT = 1 << 18
_OUTPUT_OF_SEVERAL = 1 << 22
"""Bytes of output that are read, of a call with one model and with several."""
_FILES = 2_000
_FILES_BYTES = 64 << 20
_ENTRIES = 20_000
_DEEPEST = 50
"""The greatest depth of folders whose files are read."""


@dataclass(frozen=True)
class Response:
    """What a tool chain did with one model."""

    processed: Processed
    accepted: bool | None
    """None if the tool chain came to no answer."""
    lines: frozenset[int] = frozenset()
    """The lines of the model that diagnostics name."""
    files: Mapping[str, str] = field(default_factory=dict)
    """The text files that the tool chain wrote, by path."""

    @property
    def first_line(self) -> str:
        """The first line that the tool chain printed, at most 300 characters."""
        return next((line for line in map(str.strip, self.processed.output.splitlines()) if line), "")[:300]


class Processor(Protocol):
    """A tool chain that can be called."""

    def process(self, task: Task, name: str, text: str, again_for: str = "") -> Response:
        """Do ``task`` with the model ``text``, which the suite calls ``name``. Never raises for what the tool does.

        ``again_for`` is the requirement whose failure is to be confirmed, empty for the first look.
        """

    def process_all(self, task: Task, models: Sequence[tuple[str, str]]) -> list[Response]:
        """The same for several models, each with its name."""

    def at_once(self, task: Task) -> int:
        """How many models one call of ``process_all`` should get."""

    @property
    def isolation(self) -> Isolation:
        """Where the tool chain runs."""

    def warnings(self) -> tuple[str, ...]:
        """What the vendor should know of how the calls went, a sentence each."""


class CommandLine:
    """A tool chain behind its command lines; each call gets a folder and a process group of its own."""

    def __init__(self, toolchain: ToolChain, sandbox: bool = True, hidden: Iterable[str | Path] = ()) -> None:
        """``hidden``: what the commands must not see. Raises ``DocumentError`` if a program is not there."""
        self._toolchain = toolchain
        self._no_sandbox = why_none() if sandbox else GIVEN_UP
        self._together_calls: Counter[str] = Counter()
        self._counting = threading.Lock()
        self._programs: dict[Task, tuple[Command, list[str]]] = {}
        for task in ("check", "idl", "cpp11", "cpp03"):
            command = toolchain.command_for(task)
            if command is not None:
                self._programs[task] = (command, program(toolchain, command))
        found = [words[0] for _, words in self._programs.values() if "/" in words[0]]
        needed = [*found, *([toolchain.folder] if toolchain.folder else [])]
        memory = toolchain.memory
        self._view = None if self._no_sandbox else view_of(needed, hidden=hidden, mebibytes=memory)

    @property
    def isolation(self) -> Isolation:
        return "process" if self._no_sandbox else "bubblewrap"

    def at_once(self, task: Task) -> int:
        return SEVERAL if self._toolchain.takes_several(task) else 1

    def process_all(self, task: Task, models: Sequence[tuple[str, str]]) -> list[Response]:
        """Where one call takes several models it must be clear which it refuses; if it is not, each gets a call of its own."""
        made = None
        with suppress(OSError):  # the disk may be full, which each model will show
            made = self._together(task, models) if len(models) > 1 else None
        return self._confirmed(task, models, made) if made else [self.process(task, *model) for model in models]

    def _confirmed(self, task: Task, models: Sequence[tuple[str, str]], made: Sequence[Response]) -> list[Response]:
        """What one call ``made`` of the models. Those that a refusal did not name are checked again: it may have named some only."""
        unnamed = [model for model, response in zip(models, made, strict=True) if response.accepted]
        if len(unnamed) in (0, len(models)):
            return list(made)
        again = None
        with suppress(OSError):
            again = self._together(task, unnamed) if len(unnamed) > 1 else None
        if again is None or not all(response.accepted for response in again):
            again = [self.process(task, *model) for model in unnamed]
        if not all(response.accepted for response in again):
            with self._counting:
                self._together_calls.subtract([""])
                self._together_calls.update([_SOME])
        rest = iter(again)
        return [next(rest) if response.accepted else response for response in made]

    def warnings(self) -> tuple[str, ...]:
        calls = self._together_calls.total()
        exposed = f"isolation: process; commands could reach the harness and its files, because {self._no_sandbox}"
        return (exposed,) * bool(self._no_sandbox) + tuple(
            f"{number} of {calls} calls with several models {why}: their models were checked again, one by one, which is slow; "
            f"{_MENDS[why]}"
            for why, number in self._together_calls.items()
            if why
        )

    def _together(self, task: Task, models: Sequence[tuple[str, str]]) -> list[Response] | None:
        command, words = self._programs[task]
        with own_folder() as folder:
            files = [folder / f"model-{number}.xml" for number in range(len(models))]
            for file, (_, text) in zip(files, models, strict=True):
                file.write_text(text, encoding="utf-8")
            filled = [str(f) for word in words for f in (files if word == MODELS else (word,))]
            ended = self._run(filled, folder, command, kept=_OUTPUT_OF_SEVERAL)
        printed: dict[str, list[str]] = {file.name: [] for file in files}
        for name, _, line in diagnostics_in(ended.output, command.diagnostic, printed):
            printed[name].append(line.replace(str(folder / name), MODEL_FILE).replace(name, MODEL_FILE))
        why = _not_clear(ended, command, any(printed.values()))
        with self._counting:
            self._together_calls[why] += 1
        if why:
            return None
        shown = tuple(word.replace(MODELS, MODEL_FILE) for word in _by_hand(command, words))
        responses = []
        for (name, text), lines in zip(models, printed.values(), strict=True):
            output = "".join(f"{line}\n" for line in lines)
            processed = Processed(name, task, text, shown, ended.status if lines else 0, output)
            responses.append(Response(processed, not lines, named_lines(output, command.diagnostic, text)))
        return responses

    def _run(self, words: Sequence[str], folder: Path, command: Command, kept: int = _OUTPUT) -> Ended:
        return run(words, folder, self._toolchain, kept=kept, view=self._view, own_statuses=command.refuses)

    def process(self, task: Task, name: str, text: str, again_for: str = "") -> Response:
        try:
            return self._alone(task, name, text)
        except OSError as error:
            incident = Incident("unreachable", f"the model cannot be written: {error.strerror or error}")
            shown = self._programs[task][0].command
            return Response(Processed(name, task, text, shown, None, "", incident), None)

    def _alone(self, task: Task, name: str, text: str) -> Response:
        command, words = self._programs[task]
        with own_folder() as folder:
            model, out = folder / MODEL_FILE, folder / OUT_FOLDER
            model.write_text(text, encoding="utf-8")
            out.mkdir()
            filled = [_filled(word, str(model), str(out)) for word in words]
            ended = self._run(filled, folder, command)
            output = ended.output.replace(f"{folder}/", "")
            shown = tuple(_filled(word, MODEL_FILE, OUT_FOLDER) for word in _by_hand(command, words))
            incident = ended.incident or oddity(ended.status, output, command)
            processed = Processed(name, task, text, shown, ended.status, output, incident)
            return response_to(processed, command, _files(out) if ended.status == 0 else {})


def response_to(processed: Processed, command: Command, files: Mapping[str, str]) -> Response:
    """What ``processed`` comes to by the description ``command``; ``files`` were written."""
    if processed.incident is not None:
        return Response(processed, None)
    accepted = processed.status == 0
    lines = named_lines(processed.output, command.diagnostic, processed.model)
    return Response(processed, accepted, lines, files if accepted else {})


def oddity(status: int | None, output: str, command: Command) -> Incident | None:
    """Why a command that ended with ``status`` gave no answer; None if it did."""
    return _odd_status(status, command) or _died(status, output)


def _by_hand(command: Command, words: Sequence[str]) -> tuple[str, ...]:
    """``command`` as it can be typed in any folder; ``words`` are the same with the program as it was found."""
    name = command.command[0]
    on_the_path = "/" not in name and shutil.which(name) is not None
    return (name if on_the_path else words[0], *words[1:])


def _filled(word: str, model: str, out: str) -> str:
    return word.replace(MODELS, model).replace(MODEL, model).replace(OUT, out)


class InProcess:
    """A tool chain of ours in this very process, for the self-test: quick, and not isolated."""

    def __init__(self, program: Program) -> None:
        self._program = program

    isolation: Isolation = "none"

    def at_once(self, task: Task) -> int:
        return SEVERAL

    def warnings(self) -> tuple[str, ...]:
        return ()

    def process_all(self, task: Task, models: Sequence[tuple[str, str]]) -> list[Response]:
        return [self.process(task, name, text) for name, text in models]

    def process(self, task: Task, name: str, text: str, again_for: str = "") -> Response:
        files: Mapping[str, str] = {}
        try:
            if task == "check":
                _, diagnostics = self._program.check(text.encode(), MODEL_FILE)
            else:
                files, diagnostics = self._program.generate(task, text.encode(), MODEL_FILE)
        except Exception as problem:  # noqa: BLE001 - a mutant may do anything
            incident = Incident("crash", f"{type(problem).__name__}: {problem}")
            return Response(Processed(name, task, text, ("ucm-cts-toolchain", task), None, "", incident), None)
        output = "".join(f"{diagnostic}\n" for diagnostic in diagnostics)
        status = 1 if diagnostics else 0
        processed = Processed(name, task, text, ("ucm-cts-toolchain", task, MODEL_FILE), status, output)
        return Response(processed, not diagnostics, frozenset(diagnostic.line for diagnostic in diagnostics), files)


def diagnostics_in(output: str, expression: str, files: Collection[str]) -> Iterator[tuple[str, str, str]]:
    """File, line number and full text of each diagnostic in ``output`` that names one of ``files`` and is no remark.

    ``expression`` is searched for in all the output, where ``^`` and ``$`` are the ends of a line; files are compared by their
    last names, and one that the expression does not give is the model. The same holds for calls with one model and with several.
    """
    for match in matches(expression, output):
        begin = output.rfind("\n", 0, match.start()) + 1
        end = output.find("\n", match.end())
        end = len(output) if end < 0 else end
        file = Path((match.groupdict().get("file") or MODEL_FILE).strip()).name
        if file in files and not _REMARK.match(output[match.end() : end]):
            yield file, match["line"] or "", output[begin:end]


def named_lines(output: str, diagnostic: str, model: str) -> frozenset[int]:
    """The lines of ``model`` that ``output`` names; numbers beside the name of another file do not count."""
    last = model.count("\n") + 1
    numbers = (number for _, number, _ in diagnostics_in(output[:_OUTPUT], diagnostic, (MODEL_FILE,)))
    return frozenset(
        int(number) for number in numbers if number.isdecimal() and len(number) < 10 and 0 < int(number) <= last
    )


_TOO_LONG = f"printed more than {_OUTPUT_OF_SEVERAL >> 20} MiB"
_NO_ANSWER = "came to no answer"
_UNNAMED = "refused, and no diagnostic named one of their files"
_CONTRADICTION = "ended with exit status 0, although diagnostics named some of their files"
_SOME = "named some of the models that they refused"
_MENDS = {
    _SOME: "print a diagnostic of each model, or write {model} for {models}",
    _TOO_LONG: "print less of each",
    _NO_ANSWER: "the report shows which model it was, if it happened again",
    _UNNAMED: "let each diagnostic name its file, correct 'diagnostic' in [check], or write {model} for {models}",
    _CONTRADICTION: "refuse with an exit status, or begin the text after the line number with 'warning' or 'note'",
}


def _not_clear(ended: Ended, command: Command, named: bool) -> str:
    """Why a call with several models does not say which it refuses; empty if it does. ``named``: diagnostics name some."""
    if ended.incident or oddity(ended.status, ended.output, command):
        return _NO_ANSWER
    if len(ended.output.encode()) >= _OUTPUT_OF_SEVERAL:
        return _TOO_LONG
    if (ended.status == 0) != named:
        return ""
    return _CONTRADICTION if named else _UNNAMED


def _odd_status(status: int | None, command: Command) -> Incident | None:
    if status is None or status == 0 or status in command.refuses:
        return None
    if status < 0:
        return Incident("crash", f"killed by {_signal_name(-status)}")
    listed = ", ".join(map(str, command.refuses))
    return Incident("exit", f"exit status {status}, which neither accepts (0) nor refuses ({listed})")


def _signal_name(number: int) -> str:
    """Real-time signals have no names of their own."""
    try:
        return signal.Signals(number).name
    except ValueError:
        beyond = number - signal.SIGRTMIN
        return f"SIGRTMIN+{beyond}" if beyond > 0 else f"signal {number}"


_REMARK = re.compile(r"\s*(warning|note|info|information|remark|hint)\b", re.IGNORECASE)
"""What begins a diagnostic that refuses nothing."""

_DEATHS = re.compile(
    r"^(Traceback \(most recent call last\):|Exception in thread |panic: |thread '.*' panicked at |.*Segmentation fault"
    r"|terminate called |=+[0-9]+=+ERROR: \w+Sanitizer)",
    re.MULTILINE,
)
"""What run-time systems print when a program dies; its exit status may be one that refuses a model."""


def _died(status: int | None, output: str) -> Incident | None:
    found = _DEATHS.search(output) if status else None
    return Incident("crash", f"it died: {found[0].strip()}") if found else None


def _files(out: Path) -> dict[str, str]:
    """The text files below ``out``; links, what cannot be read and what is beyond the limits are left out."""
    found: dict[str, str] = {}
    left = _FILES_BYTES
    for path in sorted(_paths(out)):
        if len(found) == _FILES:
            break
        with suppress(OSError):
            left -= path.stat().st_size
            if left < 0:
                break
            name = os.fsencode(path.relative_to(out)).decode(errors="backslashreplace")
            found[name] = path.read_text(encoding="utf-8", errors="replace")
    return found


def _paths(out: Path) -> Iterator[Path]:
    """The plain files below ``out``, as far as its folders nest and hold entries within the limits."""
    waiting = [] if out.is_symlink() else [(out, 0)]
    entries = 0
    while waiting:
        folder, depth = waiting.pop()
        with suppress(OSError), os.scandir(folder) as inside:
            for entry in inside:
                entries += 1
                if entries > _ENTRIES:
                    return
                if entry.is_dir(follow_symlinks=False) and depth < _DEEPEST:
                    waiting.append((Path(entry.path), depth + 1))
                elif entry.is_file(follow_symlinks=False):
                    yield Path(entry.path)
