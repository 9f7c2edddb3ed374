"""A tool chain as its vendor describes it: a TOML file with a command line for each task (docs/toolchains.md)."""

from __future__ import annotations

import difflib
import shutil
import sys
from pathlib import Path
from typing import Any, Literal

import msgspec
from lxml import etree

from ucm_cts.adapters.contract.metamodel.spelling import SPELLINGS
from ucm_cts.adapters.contract.metamodel.writing import CANONICAL, Dialect
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, convert, read_toml
from ucm_cts.harness.toolchains.commands.expressions import WrongExpression, compiled

Task = Literal["check", "idl", "cpp11", "cpp03"]
"""What a tool chain can do with a model."""

MODEL, MODELS, OUT = "{model}", "{models}", "{out}"

DIAGNOSTIC = r"^(?P<file>.*?)[:(](?P<line>[0-9]+)(?:[:,][0-9]+)?\)?\s*:"
"""Finds file and line in a diagnostic such as ``model.xml:12: ...``, ``model.xml:12:5: ...`` or ``model.xml(12,5): ...``."""

LARGEST = 256 * 1024
"""Bytes that a description may have."""

MOST_SECONDS, MOST_MEMORY = 86_400, 1 << 20
"""The greatest limits of a call: seconds, and MiB."""


class Command(Value, frozen=True):
    """How one task is done. The last five fields are for C++ only.

    ``command``: words with ``{model}`` and, for generators, ``{out}``, an empty folder. A checker that takes several models
    in one call has ``{models}`` instead, and names the file in each diagnostic.
    ``refuses``: exit statuses of a refused model; 0 means accepted, any other is a failure of the tool.
    ``diagnostic``: a regular expression with a group ``line`` and, for several models, ``file``.
    ``compiler``: the compiler and its options; empty for the default one.
    ``include``: folders of headers below ``{out}``.
    ``headers``: patterns of headers below ``{out}``.
    ``sources``: patterns of source files below ``{out}``; None leaves the choice to the linker.
    ``libraries``: words for the linker that follow.
    """

    command: tuple[str, ...]
    refuses: tuple[int, ...] = (1,)
    diagnostic: str = DIAGNOSTIC
    compiler: tuple[str, ...] = ()
    include: tuple[str, ...] = (".",)
    headers: tuple[str, ...] = ("**/*.h", "**/*.hh", "**/*.hpp", "**/*.hxx")
    sources: tuple[str, ...] | None = None
    libraries: tuple[str, ...] = ()


class ToolChain(Value, frozen=True):
    """A product, its commands, and its spelling of models.

    ``product``, ``version``: the product.
    ``check``, ``idl``, ``cpp11``, ``cpp03``: the command of each task; None if the product does not have it.
    ``dialect``: its spelling of models.
    ``seconds``: the time that each call may take.
    ``memory``: the MiB of resident memory that each call may use.
    ``folder``: the folder of the description.
    ``source``: the file of the description.
    """

    product: str
    version: str
    check: Command | None = None
    idl: Command | None = None
    cpp11: Command | None = None
    cpp03: Command | None = None
    dialect: Dialect = CANONICAL
    seconds: float = 20.0
    memory: int = 1024
    folder: str = ""
    source: str = ""

    def takes_several(self, task: Task) -> bool:
        """Does the command for ``task`` take several models at once?"""
        command = self.command_for(task)
        return command is not None and MODELS in command.command

    def command_for(self, task: Task) -> Command | None:
        """How ``task`` is done, None if the vendor does not say."""
        commands: dict[Task, Command | None] = {
            "check": self.check,
            "idl": self.idl,
            "cpp11": self.cpp11,
            "cpp03": self.cpp03,
        }
        return commands[task]


def read_toolchain(path: Path) -> ToolChain:
    """The tool chain that the file at ``path`` describes. Raises ``DocumentError``."""
    document, lines = read_toml(path, LARGEST)
    _check_keys(path, document, lines)
    places = {"$": 1} | {f"$.{place}": line for place, line in lines.items()}
    described = convert(path, document, ToolChain, places)
    check_description(path, described, lines)
    folder = path.parent.resolve()
    beside = {task: _beside(folder, described.command_for(task)) for task in ("cpp11", "cpp03")}
    return msgspec.structs.replace(described, **beside, folder=str(folder), source=str(path))


def check_description(path: Path, described: ToolChain, lines: dict[str, int]) -> None:
    """Check what types do not say of ``described``, which was read from ``path``, with its keys in ``lines``. Raises ``DocumentError``."""
    _check_dialect(path, described.dialect, lines)
    for task in ("check", "idl", "cpp11", "cpp03"):
        _check(path, task, described.command_for(task), lines)
    if not described.product.strip():
        raise DocumentError(path, lines.get("product"), "product is empty; say what is to be certified")
    if not 0 < described.seconds <= MOST_SECONDS:
        raise DocumentError(path, lines.get("seconds"), f"seconds is greater than 0 and at most {MOST_SECONDS}")
    if not 0 < described.memory <= MOST_MEMORY:
        raise DocumentError(path, lines.get("memory"), f"memory is greater than 0 and at most {MOST_MEMORY} (MiB)")


def _beside(folder: Path, command: Command | None) -> Command | None:
    """``command`` with libraries, and a compiler, that have a slash as files below ``folder``."""
    if command is None:
        return None
    files = (str(folder / w) if "/" in w and not w.startswith("-") else w for w in command.libraries)
    first = (str(folder / w) if "/" in w else w for w in command.compiler[:1])
    return msgspec.structs.replace(command, libraries=tuple(files), compiler=(*first, *command.compiler[1:]))


_OURS = ("folder", "source")
"""Fields that no file gives."""


_OF_CPP = ("compiler", "include", "headers", "sources", "libraries")
"""Fields of a command that only tasks of C++ have."""


def _check_keys(path: Path, document: dict[str, Any], lines: dict[str, int]) -> None:
    """Refuse unknown keys, and commands that are no lists, before their values are read."""
    kinds: dict[str, type[msgspec.Struct]] = {
        **dict.fromkeys(("check", "idl", "cpp11", "cpp03"), Command),
        "dialect": Dialect,
    }
    tables: dict[str, tuple[dict[str, Any], type[msgspec.Struct]]] = {"": (document, ToolChain)}
    tables |= {f"{key}.": (document[key], kind) for key, kind in kinds.items() if isinstance(document.get(key), dict)}
    for prefix, (table, kind) in tables.items():
        known = [field.name for field in msgspec.structs.fields(kind) if field.name not in _OURS]
        for key in table:
            if key not in known:
                close = difflib.get_close_matches(str(key), known, 1)
                hint = f"did you mean '{close[0]}'?" if close else f"there is {', '.join(known)}"
                raise DocumentError(path, lines.get(f"{prefix}{key}"), f"there is no key '{str(key)[:60]}'; {hint}")
            if key in _OF_CPP and prefix in ("check.", "idl."):
                message = f"{key} says how C++ is compiled; it belongs in [cpp11] or [cpp03]"
                raise DocumentError(path, lines.get(f"{prefix}{key}"), message)
        if kind is Command:
            _check_lists(path, prefix, table, lines)


_LISTS = ("command", "compiler", "include", "headers", "sources", "libraries", "refuses")


def _check_lists(path: Path, prefix: str, table: dict[str, Any], lines: dict[str, int]) -> None:
    for key in _LISTS:
        value = table.get(key, [])
        called = "a command" if key == "command" else key
        place = lines.get(f"{prefix}{key}")
        if isinstance(value, (str, int, float)):
            each = "the numbers" if key == "refuses" else "each word in quotes"
            message = f"{called} is a list: write {each}, with commas between them, in brackets"
            raise DocumentError(path, place, message)
        if isinstance(value, list) and any(isinstance(word, str) and "\0" in word for word in value):
            raise DocumentError(path, place, f"{called} holds the character U+0000, which no word can; take it out")


def _check_dialect(path: Path, dialect: Dialect, lines: dict[str, int]) -> None:
    """A dialect may only give other spellings to what clause 9 spells."""
    attributes = {name for spelling in SPELLINGS.values() for name in spelling.attributes}
    tags = {spelling.tag for spelling in SPELLINGS.values()}
    words = {word for spelling in SPELLINGS.values() for known in spelling.literals.values() for word in known.values()}
    for table, given, known in (
        ("tags", dialect.tags, tags),
        ("attributes", dialect.attributes, attributes | {f"{tag}.{name}" for tag in tags for name in attributes}),
        ("literals", dialect.literals, words),
    ):
        for key in given:
            if key not in known:
                close = difflib.get_close_matches(key, known, 1)
                hint = f"did you mean '{close[0]}'?" if close else "it maps clause 9's spelling to yours"
                line = lines.get(f"dialect.{table}.{key}") or lines.get(f"dialect.{table}")
                raise DocumentError(path, line, f"clause 9 spells nothing '{key[:60]}'; {hint}")
    for table, given in (("tags", dialect.tags), ("attributes", dialect.attributes)):
        for key, name in given.items():
            if not _is_name(name):
                line = lines.get(f"dialect.{table}.{key}") or lines.get(f"dialect.{table}")
                message = f"'{name[:60]}' for {key} is no name of XML; write letters, digits, '_', '-' and '.', a letter first"
                raise DocumentError(path, line, message)
    for key, word in dialect.literals.items():
        if not word.isprintable():
            line = lines.get(f"dialect.literals.{key}") or lines.get("dialect.literals")
            raise DocumentError(path, line, f"the word for {key} holds a character that is not printed; take it out")
    _check_distinct(path, dialect, lines)


def _is_name(text: str) -> bool:
    """Whether it is a name of XML without a prefix."""
    try:
        return "{" not in text and etree.QName(text).localname == text
    except ValueError:
        return False


def _check_distinct(path: Path, dialect: Dialect, lines: dict[str, int]) -> None:
    """No element may have two attributes of one name."""
    for spelling in SPELLINGS.values():
        called: dict[str, str] = {}
        for attribute in spelling.attributes:
            keys = [key for key in (f"{spelling.tag}.{attribute}", attribute) if key in dialect.attributes]
            name = dialect.attributes[keys[0]] if keys else attribute
            if name in called:
                key = keys[0] if keys else next(k for k, v in dialect.attributes.items() if v == name)
                line = lines.get(f"dialect.attributes.{key}") or lines.get("dialect.attributes")
                message = (
                    f"{called[name]} and {attribute} of {spelling.tag} are both called '{name}'; give them two names"
                )
                raise DocumentError(path, line, message)
            called[name] = attribute


def _check(path: Path, task: Task, command: Command | None, lines: dict[str, int]) -> None:
    if command is None:
        return

    def wrong(key: str, problem: str) -> DocumentError:
        return DocumentError(path, lines.get(f"{task}.{key}") or lines.get(task), problem)

    words = " ".join(command.command)
    if not command.command:
        raise wrong("command", f"the command for {task} is empty; write the program and its arguments, each in quotes")
    several = task == "check" and MODELS in command.command
    if several and MODEL in words:
        raise wrong(
            "command", f"the command for check names {MODEL} and {MODELS}; write {MODELS} if it takes several at once"
        )
    if MODELS in words and not several:
        instead = (
            f"write {MODELS} as a word of its own" if task == "check" else f"only checkers take several; write {MODEL}"
        )
        raise wrong("command", f"the command for {task} names {MODELS}; {instead}")
    if MODEL not in words and not several:
        raise wrong("command", f"the command for {task} does not name {MODEL}, which stands for the model's file")
    if task != "check" and OUT not in words:
        raise wrong("command", f"the command for {task} does not name {OUT}, which stands for the folder to write to")
    if 0 in command.refuses or not command.refuses:
        raise wrong("refuses", "refuses lists the exit statuses that refuse a model; 0 accepts it")
    if not all(0 < status < 256 for status in command.refuses):
        raise wrong("refuses", "refuses lists exit statuses, which are from 1 to 255; take the others out")
    try:
        groups = compiled(command.diagnostic).groupindex
    except WrongExpression as error:
        raise wrong("diagnostic", str(error)) from None
    for group in ("line", "file") if several else ("line",):
        if group not in groups:
            raise wrong("diagnostic", f"the diagnostic has no group (?P<{group}>...)")


def program(toolchain: ToolChain, command: Command) -> list[str]:
    """The words of ``command`` with the program as the operating system finds it.

    A program with a slash is searched below the description's folder, any other on the path and beside this Python. Raises
    ``DocumentError`` if there is none, or no compiler that is named.
    """
    compiler = command.compiler[0] if command.compiler else None
    if compiler is not None and shutil.which(compiler) is None:
        raise DocumentError(Path(toolchain.source), None, f"no compiler '{compiler}' can be run; correct 'compiler'")
    name = command.command[0]
    beside = str(Path(sys.executable).parent)
    at = str(Path(toolchain.folder) / name) if "/" in name else name
    found = shutil.which(at) or shutil.which(at, path=beside)
    if found is None:
        where = f"{at} cannot be run" if "/" in name else f"no program '{name}' on the path"
        raise DocumentError(Path(toolchain.source), None, f"{where}; correct the command")
    return [found, *command.command[1:]]
