"""Compares generated headers with the claims of a model: compiles and runs one translation unit of probes."""

from __future__ import annotations

import re
import secrets
import tempfile
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from ucm_cts.harness.toolchains.commands.bounded import Ended
from ucm_cts.harness.toolchains.cpp import compiling
from ucm_cts.harness.toolchains.cpp.linking import Linked, in_two_units, linked
from ucm_cts.harness.toolchains.cpp.listing import LISTED, Listed, listed
from ucm_cts.harness.toolchains.cpp.probes.bodies import implementation, implemented, runs
from ucm_cts.harness.toolchains.cpp.probes.check import (
    HEADERS,
    Check,
    calls,
    inside,
    needed_support,
    outside,
    results,
    rule_of,
)
from ucm_cts.harness.toolchains.cpp.probes.checks import render
from ucm_cts.harness.toolchains.cpp.probes.keywords import keyword_of, redefined
from ucm_cts.harness.toolchains.cpp.probes.needs import lacks, line_of
from ucm_cts.harness.toolchains.cpp.probes.observations import in_words
from ucm_cts.harness.toolchains.cpp.probes.prelude import (
    ARRAY,
    SAFE_ENUM,
    SHARED,
    SHARED_POINTERS,
    UCM_ARRAY,
    names_in,
    prelude,
    taken_first,
)
from ucm_cts.harness.toolchains.cpp.probes.text import Text
from ucm_cts.harness.toolchains.differences import Comparison, Difference
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.classes import Class
from ucm_cts.reference_models.mapping.cpp.expected import ExpectedCpp

_ROUNDS = 4
_THREADS = 2


@dataclass
class Seen:
    """What is known so far: what each check observed that it should not have, and where."""

    failed: dict[int, tuple[str, tuple[tuple[str, int], ...]]] = field(default_factory=dict)
    bodies: dict[str, str] = field(default_factory=dict)
    support: dict[str, str] = field(default_factory=dict)
    kept: set[int] = field(default_factory=set)
    loose: list[compiling.Error] = field(default_factory=list)
    problem: str = ""


def check(
    expected: ExpectedCpp,
    folder: Path,
    headers: tuple[str, ...],
    compiler: compiling.Compiler,
    layout: compiling.Layout = compiling.LAYOUT,
) -> Comparison:
    """What the headers, whose names are relative to ``folder``, come to. Raises ``NoCompiler``."""
    return _Comparing(expected, compiling.Headers(folder.resolve(), headers, layout), compiler).compared()


def check_files(
    expected: ExpectedCpp,
    files: Mapping[str, str],
    headers: tuple[str, ...],
    compiler: compiling.Compiler,
    layout: compiling.Layout = compiling.LAYOUT,
) -> Comparison:
    """As ``check`` for ``files``, texts by their names. Raises ``NoCompiler``."""
    with tempfile.TemporaryDirectory(prefix="ucm-cts-cpp-") as folder:
        for name, text in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(compiling.judged_like_all(text), encoding="utf-8")
        return check(expected, Path(folder), headers, compiler, layout)


class _Comparing:
    def __init__(self, expected: ExpectedCpp, headers: compiling.Headers, compiler: compiling.Compiler) -> None:
        self._expected = expected
        self._headers = headers
        self._compiler = compiler
        self._abstract = {a.key: a for a in expected.abstract}
        self._checks = list(self._rendered())
        self._numbered = {check.number: check for check in self._checks}
        self._implemented: dict[str, list[tuple[Class, Check]]] = {}
        for one in self._checks:
            claim = one.expected.claim
            if isinstance(claim, claims.Implemented):
                self._implemented.setdefault(claim.key, []).append((claim.owner, one))
        self._seen = Seen()
        self._linked = Linked()

    def compared(self) -> Comparison:
        with tempfile.TemporaryDirectory(prefix="ucm-cts-probes-") as folder, ThreadPoolExecutor(_THREADS) as threads:
            alone = list(threads.map(lambda name: self._alone(name, Path(folder)), self._headers.names))
            of_headers = [found for one in alone for found in one]
            if not self._seen.problem:
                self._linked = linked(self._headers, self._expected.standard, self._compiler, Path(folder))
                of_headers = of_headers or self._in_two_units(Path(folder))
            if self._seen.problem:
                wanted = (e.requirement for e in self._expected.expected if isinstance(e.claim, LISTED))
                return self._comparison(of_headers, ([], {}, dict.fromkeys(wanted, self._seen.problem)))
            listing = threads.submit(listed, self._expected, self._headers, self._compiler)
            self._probe(Path(folder))
            return self._comparison(of_headers, listing.result())

    def _rendered(self) -> Iterator[Check]:
        for number, expected in enumerate(self._expected.expected):
            claim = expected.claim
            if isinstance(claim, claims.Implemented):
                declared, text = implemented(claim, self._abstract[claim.key])
                says = "a class that implements all functions of the abstract class can be made and is called"
                found: Text | None = Text(says, declared, text, claim.key, judged_last=True)
            elif isinstance(claim, claims.Runs):
                declared, text = runs(claim, self._abstract[claim.key], self._abstract)
                says = f"a component that implements {claim.owner} is started, called and stopped"
                found = Text(says, declared, text, claim.key, judged_last=True)
            else:
                found = render(claim)
            if found is not None:
                yield Check(number, expected, found, rule_of(claim))

    def _alone(self, name: str, folder: Path) -> list[Difference]:
        """Whether a header compiles with nothing before it, is the same when it is included again, and leaves keywords alone."""
        if self._seen.problem:
            return []  # another one took the compiler too long, or too far, for anything more to be asked of it
        own = folder / f"alone-{self._headers.names.index(name)}"
        own.mkdir()
        if not compiling.can_be_named(name):
            return [self._of_header(repr(name), "no #include can name it", ("", 0))]
        twice = f"{self._headers.include(name)}\n" * 2
        text = f"{twice}{redefined(self._expected.standard)}int main() {{ return 0; }}\n"
        compiled = compiling.compile_text(text, own, self._headers, self._expected.standard, self._compiler)
        if compiled.problem:
            self._seen.problem = f"{name}: {compiled.problem}"
            return [self._of_header(name, compiled.problem, (name, 0))]
        return [self._of_header(name, _message_of(e), self._place_in(name, e)) for e in compiled.errors[:1]]

    def _in_two_units(self, folder: Path) -> list[Difference]:
        """Whether all headers compile together in the order of their names turned round, which probes do not include them in,
        and two translation units of a program may include them.
        """
        names = [name for name in self._headers.names if compiling.can_be_named(name)]
        if not names:
            return []
        compiled = in_two_units(names, self._headers, self._expected.standard, self._compiler, folder, self._linked)
        how = f"in the order {', '.join(reversed(names))}, and in two translation units of a program"
        held = [e for e in compiled.errors if not e.message.startswith("undefined reference")]  # which probes report
        return [self._of_header(names[0], _message_of(e), self._place_in(names[0], e), how) for e in held[:1]]

    def _of_header(self, name: str, observed: str, place: tuple[str, int], how: str = "alone and twice") -> Difference:
        standard = {"cpp11": "C++11", "cpp03": "C++03"}[self._expected.standard]
        requirement = HEADERS[self._expected.standard]
        says = f"{name} compiles as {standard}, {how}"
        return Difference(requirement, "cpp_headers", "", 0, says, observed, *place)

    def _probe(self, folder: Path) -> None:
        """Compile and run; what failed to compile is left out of the next round, so that the rest is run at last."""
        for attempt in range(_ROUNDS):
            broken = self._broken_keys()
            left = [c for c in self._checks if self._is_left(c, broken)]
            made, token = folder / f"probes-{attempt}", secrets.token_hex(8)
            compiled = compiling.compile_text(
                self._unit(left, made.with_suffix(".results"), token),
                folder,
                self._headers,
                self._expected.standard,
                self._compiler,
                made,
                self._linked.words,
            )
            if not compiled.errors and not compiled.problem:
                ended = compiling.run([str(made)], folder, self._compiler)
                if self._ran(ended, results(made.with_suffix(".results"), token), left):
                    return
                continue
            if not self._sort(compiled):
                return

    def _is_left(self, one: Check, broken: Collection[str]) -> bool:
        is_broken = one.number in self._seen.failed or one.text.key in broken
        return not is_broken and not self._pointless(one)

    def _failed(self) -> Iterator[Check]:
        """The checks that failed, in their order."""
        return (self._numbered[number] for number in sorted(self._seen.failed) if number in self._numbered)

    def _pointless(self, one: Check) -> str:
        """What a check needs that another one has found missing; nothing if it says something of its own."""
        for other in self._failed():
            if other.number != one.number:
                lacking = lacks(one.expected.claim, other.expected.claim)
                if lacking:
                    return lacking
        return ""

    def _broken_keys(self) -> set[str]:
        """Implementations that do not compile, and those that return references to them."""
        broken = set(self._seen.bodies)
        for abstract in self._expected.abstract:
            if broken & {*(g.interface for g in abstract.getters), *(c.interface for c in abstract.startup)}:
                broken.add(abstract.key)
        return broken

    def _sort(self, compiled: compiling.Compiled) -> bool:
        """Take note of errors; False if they leave nothing to try again."""
        before = len(self._seen.failed) + len(self._seen.bodies) + len(self._seen.support)
        probes_alone = any(error.file.startswith("R-") for error in compiled.errors)
        self._seen.problem = compiled.problem
        for error in compiled.errors:
            kind, _, rest = error.file.partition("#")
            if not compiling.is_tag(error.file):
                self._seen.loose.append(error)  # not of one probe
            elif kind == "body" and not probes_alone:  # else it may follow from what the probe found
                self._seen.bodies.setdefault(rest, in_words(error.message))
            elif kind == "support":
                self._seen.support.setdefault(rest, in_words(error.message))
            elif kind in ("prelude", "running"):
                self._seen.problem = f"{kind}: {error.message}"
            elif kind.startswith("R-"):
                self._seen.failed.setdefault(int(rest), (in_words(error.message), error.notes))
        if compiled.ended_early:
            first = next((e.message for e in compiled.errors if e.fatal), compiled.problem)
            self._seen.problem = first
            return False
        return len(self._seen.failed) + len(self._seen.bodies) + len(self._seen.support) > before

    def _ran(self, ended: Ended, results: Iterable[tuple[str, int, str]], left: Iterable[Check]) -> bool:
        """Take note of what the program found out; False if it died in a check and may go on without it."""
        begun: int | None = None
        finished = False
        for word, number, what in results:
            if word == "begin":
                begun = number
            elif word == "end":
                finished = True
            elif number == begun and word == "broken":
                self._seen.failed.setdefault(number, (what, ()))
            elif number == begun:
                self._seen.kept |= {number} if word == "kept" else set()
                begun = None
        status = ended.status or 0
        how = ended.problem or (f"signal {-status}" if status < 0 else f"status {status}")
        self._seen.problem = f"the program of probes ended early: {how}" if status or not finished else ""
        if begun is not None:
            self._seen.failed.setdefault(begun, (f"the program ended here: {how}", ()))
        self._seen.kept |= {c.number for c in left if not c.text.run}
        return begun is None

    def _unit(self, left: list[Check], results: Path, token: str) -> str:
        """What is compiled; only its ``main`` knows the ``token`` and where the ``results`` are written to."""
        modern = self._expected.standard == "cpp11"
        lines = [taken_first(), *self._headers.all_included]
        probes = self._probes(left, modern)
        began = f'if (!::ucts::began("{results}", "{token}")) {{ return 3; }}'
        main = ['#line 1 "running#0"', "int main() {", began, *calls(left), "return ::ucts::ended(); }", ""]
        lines += ['#line 1 "prelude#0"', prelude(modern, names_in(probes)), probes, *main]
        return "\n".join(lines).replace("<::", "< ::")  # <: is [ in C++03

    def _probes(self, left: list[Check], modern: bool) -> str:
        lines = []
        for name, text in self._support(modern).items():
            if name not in self._seen.support:
                lines += [f'#line 1 "support#{name}"', text]
        numbers = {check.number for check in left}
        lines += [text for check in self._checks for text in outside(check, check.number in numbers)]
        broken = self._broken_keys()
        needed = {check.text.key for check in left}
        wanted = self._with_references(needed)
        for abstract in self._expected.abstract:
            if abstract.key in wanted and abstract.key not in broken:
                lines += [f'#line 1 "body#{abstract.key}"', implementation(abstract).replace("\n", " ")]
        lines += [text for check in left for text in inside(check)]
        return "\n".join(lines)

    def _with_references(self, keys: set[str]) -> set[str]:
        wanted = set(keys)
        for key in keys & self._abstract.keys():
            abstract = self._abstract[key]
            wanted |= {*(g.interface for g in abstract.getters), *(c.interface for c in abstract.startup)}
        return wanted

    def _support(self, modern: bool) -> dict[str, str]:
        """What probes need of class templates that C++03 leaves to the framework, each only if something needs it."""
        if modern:
            return {"shared_ptr": SHARED % SHARED_POINTERS["cpp11"], "array": ARRAY}
        needed = {needed_support(c.expected.claim) for c in self._checks}
        shared = SHARED % SHARED_POINTERS["cpp03"]
        every = {"shared_ptr": shared, "array": UCM_ARRAY, "safe_enum": SAFE_ENUM}
        return {name: text for name, text in every.items() if name in needed}

    def _comparison(self, of_headers: list[Difference], listing: Listed) -> Comparison:
        differences = list(of_headers)
        exercised: Counter[str] = Counter()
        unjudged: dict[str, str] = {}
        exercised[HEADERS[self._expected.standard]] += len(self._headers.names)
        for one in self._checks:
            why = self._not_judged(one)
            if why:
                unjudged.setdefault(one.expected.requirement, why)
                continue
            exercised[one.expected.requirement] += 1
            observed = self._observed_of(one)
            if observed is not None:
                differences.append(self._difference(one, *observed))
        if not differences:  # else it follows from one of these
            for error in self._seen.loose[:1]:
                message = "; ".join([error.message, *self._linked.left_out])
                differences.append(self._of_header("what is generated", message, self._place(error)))
        found, counted, missing = listing
        found = [d for d in found if not self._is_refuted(d)]
        exercised.update(counted)
        unjudged = {**missing, **unjudged}
        return Comparison(dict(exercised), (*differences, *found), unjudged=unjudged, remarks=self._linked.left_out)

    def _is_refuted(self, found: Difference) -> bool:
        """Whether a function that libclang found to be pure is defined somewhere: the class could be implemented without it."""
        requirements = {e.requirement for e in self._expected.expected if isinstance(e.claim, claims.NothingElse)}
        bodies = (c for c in self._checks if isinstance(c.expected.claim, claims.Implemented))
        of_class = [c for c in bodies if c.expected.element == found.element and found.requirement in requirements]
        return any(c.number in self._seen.kept and not self._not_judged(c) for c in of_class)

    def _observed_of(self, one: Check) -> tuple[str, tuple[tuple[str, int], ...]] | None:
        if one.text.key in self._seen.bodies:
            return self._seen.bodies[one.text.key], ()
        return self._seen.failed.get(one.number)

    def _not_judged(self, one: Check) -> str:
        """Why nothing can be said of a check; nothing if something can."""
        lacking = self._pointless(one)
        if lacking:
            return lacking
        observed = self._observed_of(one)
        if observed is None and one.number not in self._seen.kept:
            return self._seen.problem or "what it needs does not compile"
        if one.text.judged_last and observed is not None and any(c.text.of_functions for c in self._failed()):
            return "functions of the abstract classes are not as they should be"
        if one.text.pure and not self._is_implementable(one):
            return "the class cannot be implemented"
        return ""

    def _is_implementable(self, one: Check) -> bool:
        claim = one.expected.claim
        assert isinstance(claim, claims.Pure)
        others = (c for owner, c in self._implemented.get(claim.key, ()) if owner == claim.owner)
        return all(self._observed_of(c) is None and c.number in self._seen.kept for c in others)

    def _difference(self, one: Check, observed: str, notes: tuple[tuple[str, int], ...]) -> Difference:
        expected = one.expected
        place = next((self._relative(f, n) for f, n in notes if f and not compiling.is_tag(f)), None) or self._found(
            one
        )
        return Difference(
            expected.requirement, one.rule, expected.element, expected.line, one.text.says, observed, *place
        )

    def _place_in(self, name: str, error: compiling.Error) -> tuple[str, int]:
        """Where ``error`` is; for a keyword where the header ``name`` defines it."""
        keyword = keyword_of(error.message)
        text = (self._headers.folder / name).read_text(encoding="utf-8", errors="replace") if keyword else ""
        defined = re.search(rf"^[ \t]*#[ \t]*define[ \t]+{keyword}\b", text, re.MULTILINE) if keyword else None
        return (name, text.count("\n", 0, defined.start()) + 1) if defined else self._place(error)

    def _place(self, error: compiling.Error) -> tuple[str, int]:
        places = [(error.file, error.line), *error.notes]
        return next((p for p in (self._relative(f, n) for f, n in places if not compiling.is_tag(f)) if p), ("", 0))

    def _relative(self, file: str, line: int) -> tuple[str, int] | None:
        path = Path(file)
        if path.is_absolute() and path.is_relative_to(self._headers.folder):
            return str(path.relative_to(self._headers.folder)), line
        return None

    def _found(self, one: Check) -> tuple[str, int]:
        """Where the headers speak of what the check is about."""
        for header in self._headers.names:
            text = (self._headers.folder / header).read_text(encoding="utf-8", errors="replace")
            line = line_of(one.expected.claim, text)
            if line:
                return header, line
        return "", 0


def _message_of(error: compiling.Error) -> str:
    keyword = keyword_of(error.message)
    return f"it redefines the keyword {keyword}" if keyword else error.message
