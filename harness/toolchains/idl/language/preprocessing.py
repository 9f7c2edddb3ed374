"""The preprocessor of IDL: removes comments, directives and branches that are not taken, and replaces macros.

Each line stays where it was. A file is seen as it is where it is included first; one that none includes stands for itself.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ucm_cts.harness.toolchains.idl.language.conditions import holds
from ucm_cts.harness.toolchains.idl.language.macros import Expander, Macro, Refused, defined
from ucm_cts.harness.toolchains.idl.language.problems import NotIdl, Problem, problem_at

LARGEST = 4 * 1024 * 1024
"""Characters that a file of IDL may have."""

MOST_READ = 16 * LARGEST
"""Characters that are read of the files of a model, which count anew for each file that includes them and is not included."""

DEEPEST_INCLUDES = 200
"""Files that may include one another in a row."""


@dataclass
class Preprocessed:
    """By file: what is left of it; where it includes others that are there; why it cannot be preprocessed. And those that were read
    for themselves, and those that are missing.
    """

    texts: dict[str, str] = field(default_factory=dict)
    includes: dict[str, list[tuple[int, str]]] = field(default_factory=dict)
    problems: dict[str, Problem] = field(default_factory=dict)
    roots: list[str] = field(default_factory=list)
    missing: set[str] = field(default_factory=set)


def preprocessed(files: Mapping[str, str]) -> Preprocessed:
    """What is left of ``files`` (name to text), which may include one another. Never raises."""
    done = Preprocessed()
    lines: dict[str, list[Line]] = {}
    for name, text in files.items():
        try:
            lines[name] = list(logical_lines(without_comments(text, name)))
        except NotIdl as error:
            done.problems[name] = error.problem
    expander = Expander()
    left = [MOST_READ]
    for name in _outermost_first(lines):
        if name not in done.texts and name not in done.problems:
            done.roots.append(name)
            _Unit(lines, done, expander, left).read(name)
    return done


_COMMENT = re.compile(
    r'"(?:\\.|[^"\\\n])*"|\'(?:\\[^\n]|[^\'\\\n])+\'|(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)|(?P<open>/\*)', re.DOTALL
)


def without_comments(text: str, file: str = "") -> str:
    """``text`` with blanks instead of comments; where a comment goes on, so does the line. Raises ``NotIdl``."""
    if len(text) > LARGEST:
        raise NotIdl(Problem(file, 1, 1, f"has more than {LARGEST} characters; split it"))
    if "\0" in text:
        raise NotIdl(problem_at(text, text.index("\0"), file, "a NUL is not IDL; remove it"))
    text = text.removeprefix("\ufeff").replace("\r\n", "\n")
    pieces = []
    at = 0
    for match in _COMMENT.finditer(text):
        if match["open"]:
            raise NotIdl(problem_at(text, match.start(), file, "this comment does not end; close it"))
        if match["comment"]:
            blank = re.sub(r"[^\n]", " ", match[0]).replace("\n", "\\\n")
            pieces += [text[at : match.start()], blank]
            at = match.end()
    return "".join([*pieces, text[at:]])


@dataclass(frozen=True)
class Line:
    """A line of text with those that go on with it."""

    number: int
    text: str
    directive: str = ""
    operand: str = ""


_DIRECTIVE = re.compile(r"\s*#\s*([^\W\d]\w*)?(.*)", re.DOTALL)


def logical_lines(text: str) -> Iterator[Line]:
    """The logical lines of ``text``: a directive may go on over several, as may a comment."""
    pending: list[str] = []
    physical = text.split("\n")
    for number, line in enumerate(physical, 1):
        if line.endswith("\\") and number < len(physical):
            pending.append(line[:-1] + " ")
            continue
        whole = "\n".join([*pending, line])
        found = _DIRECTIVE.match(whole)
        first = number - len(pending)
        if found:
            yield Line(
                first, "\n" * len(pending), found[1] or "#", found[2].replace(" \n", " ").replace("\n", " ").strip()
            )
        else:
            yield Line(first, whole)
        pending = []


def _outermost_first(files: Mapping[str, list[Line]]) -> list[str]:
    """The names of ``files``, those that others include after these, so that they are seen as they are included."""
    includes = {name: set(_named(lines, name, files)) - {name} for name, lines in files.items()}
    included = {other for others in includes.values() for other in others}
    outer = [name for name in files if name not in included]
    reached = _reached(outer, includes)
    circles = [name for name in files if name not in reached]
    circles.sort(key=lambda name: -len(_reached([name], includes)))
    return [*outer, *circles, *(name for name in files if name in reached and name in included)]


def _reached(begin: list[str], includes: Mapping[str, set[str]]) -> set[str]:
    reached = set(begin)
    waiting = list(begin)
    while waiting:
        new = includes[waiting.pop()] - reached
        reached |= new
        waiting += new
    return reached


_TARGET = re.compile(r"\s*[\"<]([^\">\n]+)[\">]")


def _named(lines: list[Line], name: str, files: Mapping[str, object]) -> Iterator[str]:
    """The files that ``name`` includes, if all branches are taken."""
    for line in lines:
        target = _TARGET.match(line.operand) if line.directive == "include" else None
        found = _file(target[1], name, files) if target is not None else None
        if found is not None:
            yield found


def _file(target: str, includer: str, files: Mapping[str, object]) -> str | None:
    """Which of ``files`` is included: beside the one that does, or where the name says, or else anywhere under its last name."""
    beside = posixpath.normpath(posixpath.join(posixpath.dirname(includer), target))
    plain = posixpath.normpath(target)
    for candidate in (beside, plain):
        if candidate in files:
            return candidate
    last = posixpath.basename(plain)
    ends = [name for name in files if posixpath.basename(name) == last]
    return next((name for name in ends if name.endswith(f"/{plain}")), ends[0] if ends else None)


@dataclass
class _Branch:
    """An #if that is open: whether it stands where text counts, whether a branch has been taken, and whether this one is."""

    line: int
    outside: bool
    taken: bool
    active: bool
    last: bool = False


class _Unit:
    """A file with all that it includes: macros go on from one to the next."""

    def __init__(
        self, files: Mapping[str, list[Line]], done: Preprocessed, expander: Expander, left: list[int]
    ) -> None:
        self._files = files
        self._done = done
        self._expander = expander
        self._left = left
        self._macros: dict[str, Macro] = {}
        self._seen: set[str] = set()
        self._depth = 0

    def read(self, name: str) -> None:
        """Preprocess the file ``name`` and what it includes; what is left of them counts if it is the first time."""
        reading = [self._file(name)]
        while reading:
            included = next(reading[-1], None)
            if included is None:
                reading.pop()
            else:
                reading.append(self._file(included))

    def _file(self, name: str) -> Iterator[str]:
        """Preprocess one file, and hand out those that have to be read before it goes on."""
        self._seen.add(name)
        self._depth += 1
        includes: list[tuple[int, str]] = []
        pieces: list[str] = []
        try:
            yield from self._read(name, pieces, includes)
        except NotIdl as error:
            self._done.problems.setdefault(name, error.problem)
        else:
            if name not in self._done.texts:
                self._done.texts[name] = "\n".join(pieces)
                self._done.includes[name] = includes
        self._depth -= 1

    def _read(self, name: str, pieces: list[str], includes: list[tuple[int, str]]) -> Iterator[str]:
        branches: list[_Branch] = []
        waiting: list[Line] = []
        for line in self._files[name]:
            self._left[0] -= len(line.text) + len(line.operand) + 1
            if self._left[0] < 0:
                raise NotIdl(Problem(name, line.number, 1, "the files include more text than this suite reads"))
            active = not branches or branches[-1].active
            if not line.directive:
                waiting.append(line if active else Line(line.number, "\n" * line.text.count("\n")))
                continue
            pieces += self._plain(name, waiting)
            waiting = []
            pieces.append(line.text)
            try:
                if self._condition(line, branches, active) or not active:
                    continue
                if line.directive == "include":
                    yield from self._included(name, line, includes)
                else:
                    self._directive(line)
            except Refused as refused:
                raise NotIdl(Problem(name, line.number, 1, str(refused))) from None
        pieces += self._plain(name, waiting)
        if branches:
            raise NotIdl(Problem(name, branches[-1].line, 1, "this condition does not end; write #endif"))

    def _plain(self, name: str, lines: list[Line]) -> list[str]:
        """What macros make of text between two directives."""
        if not lines:
            return []
        text = "\n".join(line.text for line in lines)
        try:
            return [self._expander.expanded(text, self._macros)]
        except Refused as refused:
            raise NotIdl(Problem(name, lines[0].number, 1, f"in the text that begins here, {refused}")) from None

    def _condition(self, line: Line, branches: list[_Branch], active: bool) -> bool:
        """Whether ``line`` begins, changes or ends a branch, which is done."""
        what = line.directive
        if what in ("if", "ifdef", "ifndef"):
            taken = active and self._holds(line)
            branches.append(_Branch(line.number, active, taken, taken))
            return True
        if what not in ("elif", "else", "endif", "elifdef", "elifndef"):
            return False
        if not branches or (what != "endif" and branches[-1].last):
            raise Refused(f"#{what} is not expected here")
        if what == "endif":
            branches.pop()
            return True
        branch = branches[-1]
        branch.active = branch.outside and not branch.taken and (what == "else" or self._holds(line))
        branch.taken = branch.taken or branch.active
        branch.last = what == "else"
        return True

    def _holds(self, line: Line) -> bool:
        if line.directive.endswith("def"):
            name = re.match(r"[^\W\d]\w*", line.operand)
            if name is None:
                raise Refused(f"#{line.directive} needs the name of a macro")
            return (name[0] in self._macros) != line.directive.endswith("ndef")
        return holds(line.operand, self._macros, self._expander)

    def _directive(self, line: Line) -> None:
        """Do what a directive says. Those that are for compilers, or unknown, say nothing here."""
        match line.directive:
            case "define":
                name, macro = defined(line.operand)
                self._macros[name] = macro
            case "undef":
                self._macros.pop(line.operand.split()[0] if line.operand else "", None)
            case "error":
                raise Refused(f"#error {line.operand[:100]}".rstrip())

    def _included(self, file: str, line: Line, includes: list[tuple[int, str]]) -> Iterator[str]:
        """The file that ``line`` includes, if it is there and not read yet: each file once, with and without a guard."""
        target = _TARGET.match(line.operand) or _TARGET.match(self._expander.expanded(line.operand, self._macros))
        if target is None:
            return
        name = _file(target[1], file, self._files)
        if name is None:
            if _file(target[1], file, self._done.problems) is None:
                self._done.missing.add(target[1])
            return
        includes.append((line.number, name))
        if name in self._seen:
            return
        if self._depth >= DEEPEST_INCLUDES:
            raise Refused("files include one another deeper than this suite reads; make it simpler")
        yield name
