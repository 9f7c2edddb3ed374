"""The machinery of generated mutants: how mutants are made, selected, run and counted."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

import pytest
from files import ROOT

from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.purposes.selection import select
from ucm_cts.harness.selftest.generated import cpp_programs, python_programs
from ucm_cts.harness.selftest.generated.mutants import (
    DUPLICATE,
    GENERATED,
    NO_PROGRAM,
    NONSENSE,
    SAME,
    GeneratedMutant,
    generate,
)
from ucm_cts.harness.selftest.generated.page import Tally, page
from ucm_cts.harness.selftest.generated.quick_trial import QuickTrials
from ucm_cts.harness.selftest.generated.record import Result, append, read_equivalents, read_results
from ucm_cts.harness.selftest.generated.trial import Outcome, ordered, stated

SOURCE = "def f(a: int) -> int:\n    x = a\n    if a:\n        x = a\n    return x\n"


def mutant(line: str, becomes: str, nth: int = 1, number: int = 0, file: str = "framework.py") -> GeneratedMutant:
    return GeneratedMutant(file, line, becomes, nth, number, "")


def of_framework(line: str, becomes: str) -> GeneratedMutant:
    lines = (python_programs.HOME / "framework.py").read_text().splitlines()
    return mutant(line, becomes, number=[text.strip() for text in lines].index(line) + 1)


def test_one_line_is_another_one() -> None:
    second = mutant("x = a", "x = 0\nbreak;", nth=2, number=4)
    expected = "def f(a: int) -> int:\n    x = a\n    if a:\n        x = 0\n        break;\n    return x\n"
    assert second.source(SOURCE.splitlines(keepends=True)) == expected
    assert second.key == "framework.py: x = a (2) ==> x = 0\nbreak;"


class Tool:
    """Stands for universalmutator: rewrites each line by ``rules``, and says so while it works."""

    def __init__(self, *rules: tuple[str, str]) -> None:
        self.rules = rules

    def mutants_regexp(self, source: list[str], **options: object) -> list[tuple[int, str, tuple[str, str]]]:
        print("MUTATING")
        return [
            (number, line.replace(old, new), (f"{old} ==> {new}", "here"))
            for number, line in enumerate(source, 1)
            for old, new in self.rules
            if old in line
        ]


@pytest.fixture
def tool(monkeypatch: pytest.MonkeyPatch) -> Tool:
    found = Tool(
        ("manager.numbers", "manager.thumbs"),
        ("itertools.count(1)", "itertools.count(2)"),
        ("itertools.count(1)", "itertools.count( 2 )"),
        ("itertools.count(1)", "itertools.count("),
        ("class State(Enum):", "class State(Enum):  # it is"),
    )
    module = ModuleType("universalmutator")
    module.__dict__["mutator"] = found
    monkeypatch.setitem(sys.modules, "universalmutator", module)
    return found


def test_generated_candidates_are_sorted(tool: Tool, capsys: pytest.CaptureFixture[str]) -> None:
    candidates, census = python_programs.candidates()
    assert [(m.file, m.becomes, m.rule) for m in candidates] == [
        ("framework.py", "self.numbers = itertools.count(2)", "itertools.count(1) ==> itertools.count(2)")
    ]
    assert census == {GENERATED: 5, NONSENSE: 1, DUPLICATE: 1, NO_PROGRAM: 1, SAME: 1}
    assert capsys.readouterr().out == ""


def test_equal_lines_differ_by_their_number(tool: Tool, tmp_path: Path) -> None:
    tool.rules = (("a", "b"), ("a", "b"), ("a", "c\n    break;"))
    (tmp_path / "x.py").write_text("    a\nif a:\n    a\n")
    made = list(generate(tmp_path / "x.py", ()))
    assert [m.key for m in made if m.number != 2] == [
        "x.py: a ==> b",
        "x.py: a ==> c\nbreak;",
        "x.py: a (2) ==> b",
        "x.py: a (2) ==> c\nbreak;",
    ]


@pytest.mark.parametrize(
    "alike",
    [
        SOURCE.replace("a: int", "a: str"),
        SOURCE.replace("-> int", "-> None"),
        SOURCE.replace("    x = a\n    if", "    x = a  # why\n    if"),
        SOURCE.replace("    if", '    "said"\n    if'),
    ],
)
def test_indistinguishable_changes_are_the_same_program(alike: str) -> None:
    assert python_programs.meaning(alike) == python_programs.meaning(SOURCE)


def test_words_of_messages_make_no_program_but_their_kind_does() -> None:
    said = "def f():\n    raise ValueError('one')\n"
    assert python_programs.meaning(said.replace("one", "two")) == python_programs.meaning(said)
    assert python_programs.meaning(said.replace("ValueError", "KeyError")) != python_programs.meaning(said)


def test_other_programs_and_none() -> None:
    assert python_programs.meaning(SOURCE.replace("if a", "if not a")) != python_programs.meaning(SOURCE)
    assert python_programs.meaning(SOURCE.replace("if a:", "if a")) is None


def test_a_quick_trial_kills_a_mutant_and_passes_the_framework() -> None:
    statement = stated(python_programs.HOME / "ics.toml")
    purposes = select(tuple(ordered(statement, ("12.10",))), "R-11.2.2.1-07")[:5]
    quick_trials = QuickTrials(statement, purposes, 1)
    quick_trials.learn(Engine(ReferenceAdapter))
    with python_programs.python_endpoint(None) as endpoint:
        right = quick_trials.try_out(endpoint, ())
    with python_programs.python_endpoint(of_framework("self.members[member.id] = member", "pass")) as endpoint:
        forgets = quick_trials.try_out(endpoint, ())
    with python_programs.python_endpoint(of_framework("import itertools", "import iter_tools")) as endpoint:
        broken = quick_trials.try_out(endpoint, ())
    assert right.outcome is None
    assert not right.suspect
    assert forgets.outcome is not None
    assert forgets.outcome.fate == "failed"
    assert broken.outcome is not None
    assert broken.outcome.fate == "not loaded"


def test_a_framework_that_hangs_is_suspect() -> None:
    statement = stated(python_programs.HOME / "ics.toml")
    quick_trials = QuickTrials(statement, ordered(statement, ())[:1], 1, silence=1)
    hangs = of_framework("self._shut_down(self.started.pop(), failures)", "pass")
    with python_programs.python_endpoint(hangs) as endpoint:
        assert quick_trials.try_out(endpoint, ()).suspect == ordered(statement, ())[0].id


def test_results_are_kept_one_by_one_and_the_last_word_counts(tmp_path: Path) -> None:
    one, other = mutant("a", "b"), mutant("a", "c")
    path = tmp_path / "results.jsonl"
    assert read_results(path) == {}
    for tried, outcome in (one, Outcome("open")), (other, Outcome("survived")), (one, Outcome("failed", "R-1")):
        append(path, tried, outcome)
    assert read_results(path) == {one.digest: Outcome("failed", "R-1"), other.digest: Outcome("survived")}
    with path.open("a") as file:
        file.write("{}\n")
    with pytest.raises(DocumentError, match=r"results.jsonl:4: is no result"):
        read_results(path)


def test_a_mutant_is_explained_once(tmp_path: Path) -> None:
    path = tmp_path / "equivalent.yaml"
    path.write_text("- {reason: so, mutants: ['f: a ==> b']}\n- {reason: or so, mutants: ['f: a ==> b']}\n")
    with pytest.raises(DocumentError, match="is there twice"):
        read_equivalents(path)


def test_figures_of_a_page() -> None:
    fates = (Outcome("failed", "R-1"), Outcome("incident", "hang"), Outcome("survived"), Outcome("survived"))
    results = [Result(mutant("a", str(number)), outcome) for number, outcome in enumerate(fates)]
    tally = Tally(
        {"generated by the tool": 9},
        5,
        results,
        {results[2].mutant.key: "nobody can tell", results[0].mutant.key: "wrong"},
    )
    assert (len(tally.killed), len(tally.equivalent), len(tally.open)) == (2, 1, 1)
    assert tally.rate == pytest.approx(100 * 2 / 3)
    assert tally.wrongly_listed == [results[0]]
    reported = page("Title", "Why.", tally)
    assert "**nobody can tell**\n\n- `framework.py: a ==> 2`" in reported
    assert "## Survivors that are open\n\n- `framework.py: a ==> 3`" in reported
    assert "66.7 %" in reported


@pytest.mark.parametrize(
    ("listed", "sources"),
    [
        (python_programs.EQUIVALENTS, python_programs.HOME),
        (cpp_programs.EQUIVALENTS, ROOT / "adapters" / "reference" / "cpp" / "framework" / "src"),
    ],
    ids=["python", "cpp"],
)
def test_listed_equivalents_are_lines_of_the_sources(listed: Path, sources: Path) -> None:
    reasons = read_equivalents(listed)
    assert reasons
    for key in reasons:
        file, _, rest = key.partition(": ")
        line = rest.partition(" ==> ")[0]
        written = [text.strip() for text in next(sources.rglob(file)).read_text().splitlines()]
        nth = int(line.rpartition(" (")[2].rstrip(")")) if line not in written else 1
        line = line if nth == 1 else line.rpartition(" (")[0]
        assert written.count(line) >= nth, f"{listed.name} speaks of a line that is no longer there: {key}"
