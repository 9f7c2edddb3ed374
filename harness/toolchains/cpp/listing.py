"""Has headers read by libclang, to find declarations that should not be there, which no probe can find.

What is asked about is found as user code finds it: the compiler resolves a name. Nothing is judged, and that is said, where
libclang cannot be used, does not understand the headers, or does not end within the limits of a compiler.
"""

from __future__ import annotations

import re
import sys
import tempfile
from collections import Counter
from pathlib import Path

import msgspec

from ucm_cts.harness.toolchains.cpp import lister
from ucm_cts.harness.toolchains.cpp.compiling import STANDARDS, Compiler, Headers, run
from ucm_cts.harness.toolchains.cpp.disguise import Disguise
from ucm_cts.harness.toolchains.cpp.lister import ASKED, Answers, Question, Request
from ucm_cts.harness.toolchains.cpp.probes.prelude import SHARED, SHARED_POINTERS, names_in, prelude, taken_first
from ucm_cts.harness.toolchains.cpp.probes.text import class_text, class_words, connection_declared
from ucm_cts.harness.toolchains.differences import Difference
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.classes import Class, Connected
from ucm_cts.reference_models.mapping.cpp.expected import Expected, ExpectedCpp

Listed = tuple[list[Difference], dict[str, int], dict[str, str]]
"""Differences, how often each requirement was exercised, and why others were not."""

RULE = "cpp_unexpected"
LISTED = (
    claims.NotCorba,
    claims.NothingElse,
    claims.InheritsElement,
    claims.NoOperations,
    claims.NotInHeader,
    claims.NoOtherEnumerators,
    claims.FixedType,
)
"""The claims that libclang decides."""

_OF_ENUMERATIONS = (claims.NoOtherEnumerators, claims.FixedType)

COMMAND = (sys.executable, "-P", "-m", lister.__name__)
"""The program that uses libclang; a file with a request follows."""

_FOLDERS = re.compile(r"#include <\.\.\.> search starts here:\n(.*?)End of search list", re.DOTALL)
_CLANG = ("clang", "clang_major", "clang_minor", "clang_patchlevel", "clang_version", "llvm")


def listed(expected: ExpectedCpp, headers: Headers, compiler: Compiler) -> Listed:
    """What libclang has against the headers. Raises ``NoCompiler``."""
    wanted = [e for e in expected.expected if isinstance(e.claim, LISTED)]
    if not wanted:
        return [], {}, {}
    disguise = Disguise()
    answers = _answered(_request(wanted, expected.standard, headers, compiler, disguise), compiler)
    if answers.problem:
        return [], {}, {e.requirement: answers.problem for e in wanted}
    differences: list[Difference] = []
    counted: Counter[str] = Counter()
    unjudged: dict[str, str] = {}
    for one, answer in zip(wanted, answers.answers, strict=True):
        if answer.missing:
            unjudged.setdefault(one.requirement, disguise.taken_off(answer.missing))
            continue
        counted[one.requirement] += 1
        for found in answer.found:
            place = (found.file, found.line)
            differences.append(
                Difference(one.requirement, RULE, one.element, one.line, _says(one), found.observed, *place)
            )
    return differences, dict(counted), unjudged


def _says(one: Expected) -> str:
    match one.claim:
        case claims.NotCorba(owner):
            return f"{class_words(owner)} derives from nothing of CORBA"
        case claims.NothingElse(owner, _):
            return f"no pure virtual function of {class_words(owner)} that the model does not ask for"
        case claims.NotInHeader(name):
            return f"no header gives {name} its value"
        case claims.NoOtherEnumerators(name, names):
            return f"{name} has no values but {', '.join(names)}"
        case claims.FixedType(name):
            return f"{name} is declared with the type of its values"
        case claims.InheritsElement(owner):
            return f"{class_words(owner)} derives from PortElementObject"
    return "PortElementObject has no operations"


def _answered(request: Request, compiler: Compiler) -> Answers:
    """What the program answers; it goes beyond no limit that a compiler has."""
    with tempfile.TemporaryDirectory(prefix="ucm-cts-cpp-") as folder:
        path = Path(folder) / "request.json"
        path.write_bytes(msgspec.json.encode(request))
        needed = (Path(lister.__file__), Path(request.folder))  # a sandbox hides the harness otherwise
        ended = run([*COMMAND, str(path)], Path(folder), compiler, needed)
    if ended.problem:
        return Answers(problem=f"libclang does not come to an end with the headers: {ended.problem}")
    try:
        answers = msgspec.json.decode(ended.output, type=Answers)
    except msgspec.MsgspecError:
        last = next((s for s in reversed(ended.errors.splitlines()) if s.strip()), "without a word")
        return Answers(problem=f"libclang does not survive the headers: status {ended.status}, {last.strip()[:200]}")
    if not answers.problem and [a.number for a in answers.answers] != [q.number for q in request.questions]:
        return Answers(problem="libclang cannot be used: it left questions without an answer")
    return answers


def _request(
    wanted: list[Expected], standard: str, headers: Headers, compiler: Compiler, disguise: Disguise
) -> Request:
    modern = standard == "cpp11"
    asked = [_text(number, one) for number, one in enumerate(wanted)]
    helpers = dict.fromkeys(_helper(one) for one in wanted)
    included = "\n".join([taken_first(), *headers.all_included])
    tools = [prelude(modern, names_in("\n".join([*asked, *helpers]))), SHARED % SHARED_POINTERS[standard], *helpers]
    first = "\n".join([included, *tools]).count("\n") + 2
    whole = disguise.put_on("\n".join([included, *tools, *asked, ""]).replace("<::", "< ::"))
    return Request(
        whole,
        included.count("\n") + 1,
        str(headers.folder),
        _attempts(standard, headers, compiler),
        tuple(_question(number, first + number, one, disguise) for number, one in enumerate(wanted)),
    )


def _text(number: int, one: Expected) -> str:
    """One line that makes ``asked`` what the claim is about."""
    claim = one.claim
    if isinstance(claim, claims.NotInHeader):
        return f"namespace ucts_asked_{number} {{ inline void {ASKED}() {{ (void){claim.name}; }} }}"
    asked = claim.name if isinstance(claim, _OF_ENUMERATIONS) else class_text(_owner(claim))
    return f"namespace ucts_asked_{number} {{ typedef {asked} {ASKED}; }}"


def _owner(claim: claims.Claim) -> Class:
    assert isinstance(claim, claims.NotCorba | claims.NothingElse | claims.InheritsElement | claims.NoOperations)
    return claim.owner


def _helper(one: Expected) -> str:
    """What must be declared before; a text without a line end of its own."""
    of_class = not isinstance(one.claim, (claims.NotInHeader, *_OF_ENUMERATIONS))
    owner = _owner(one.claim) if of_class else None
    return connection_declared(owner.owner, owner.connection) if isinstance(owner, Connected) else ""


def _question(number: int, line: int, one: Expected, disguise: Disguise) -> Question:
    place = f"{disguise.name}_asked_{number}"
    match one.claim:
        case claims.NotCorba():
            return Question(number, line, place, "not-corba")
        case claims.NothingElse(_, members):
            return Question(number, line, place, "nothing-else", members)
        case claims.NotInHeader():
            return Question(number, line, place, "not-in-header")
        case claims.NoOtherEnumerators(_, names):
            return Question(number, line, place, "no-other-enumerators", names)
        case claims.FixedType():
            return Question(number, line, place, "fixed-type")
        case claims.InheritsElement():
            return Question(number, line, place, "is-element")
    return Question(number, line, place, "no-operations")


def _attempts(standard: str, headers: Headers, compiler: Compiler) -> tuple[tuple[str, ...], ...]:
    """Options for libclang: first without its own name, if that is not the compiler's, so that headers show both the same; with it
    only if it does not understand the system's headers otherwise.
    """
    folders, macros = _compiler_defaults(standard, compiler)
    options = (STANDARDS[standard], "-x", "c++", "-ferror-limit=0", "-w", *headers.options)
    options += tuple(word for folder in folders for word in ("-isystem", folder))
    if "__clang__" in macros:
        return (options,)
    return (*options, *(f"-U__{name}__" for name in _CLANG)), options


_KNOWN: dict[tuple[tuple[str, ...], str], tuple[list[str], frozenset[str]]] = {}


def _compiler_defaults(standard: str, compiler: Compiler) -> tuple[list[str], frozenset[str]]:
    """The compiler's own header folders, because libclang has no standard library of its own, and the compiler's own macros."""
    key = (compiler.command, standard)
    if key not in _KNOWN:
        with tempfile.TemporaryDirectory(prefix="ucm-cts-cpp-") as folder:
            words = [*compiler.command, STANDARDS[standard], "-E", "-v", "-dM", "-x", "c++", "/dev/null"]
            ended = run(words, Path(folder), compiler)
        match = _FOLDERS.search(ended.errors)
        macros = frozenset(re.findall(r"^#define (\w+)", ended.output, re.MULTILINE))
        _KNOWN[key] = ([line.strip() for line in match[1].splitlines()] if match else [], macros)
    return _KNOWN[key]
