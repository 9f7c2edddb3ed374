"""Calls of a checker with several models: how its output is read, and when each model gets a call of its own."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from ucm_cts.harness.toolchains.commands.description import read_toolchain
from ucm_cts.harness.toolchains.commands.processing import CommandLine, Response, diagnostics_in, named_lines

MODELS = [("good", "<a/>\n"), ("bad", "<a/>\n<wrong/>\n"), ("fine", "<a/>\n")]


def checked(
    folder: Path, script: str, diagnostic: str = "", models: Sequence[tuple[str, str]] = MODELS
) -> tuple[list[Response], tuple[str, ...]]:
    """What becomes of ``models`` by the shell script, and the warnings."""
    program = folder / "check.sh"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    described = folder / "chain.toml"
    expression = f"diagnostic = '''{diagnostic}'''\n" if diagnostic else ""
    described.write_text(f'product = "p"\nversion = "1"\n[check]\ncommand = ["./check.sh", "{{models}}"]\n{expression}')
    chain = CommandLine(read_toolchain(described))
    return chain.process_all("check", models), chain.warnings()


EACH = 's=0; for m in "$@"; do n=$(grep -n wrong "$m" | cut -d: -f1); [ -n "$n" ] && s=1 && {}; done; exit $s'


@pytest.mark.parametrize(
    ("prints", "diagnostic"),
    [
        ('echo "$m:$n: wrong"', ""),
        ('echo "[E1] file $m line $n"', r"file (?P<file>\S+) line (?P<line>[0-9]+)"),
        ('printf "%s\\n  at line %s\\n" "$m" "$n"', r"^(?P<file>.*)\n  at line (?P<line>[0-9]+)"),
        ('echo "$(basename $m):$n: wrong"', ""),
    ],
    ids=["first-in-the-line", "inside-the-line", "over-two-lines", "without-folder"],
)
def test_a_diagnostic_is_found_wherever_it_stands(tmp_path: Path, prints: str, diagnostic: str) -> None:
    responses, warnings = checked(tmp_path, EACH.format(prints), diagnostic)
    assert [r.accepted for r in responses] == [True, False, True]
    assert responses[1].lines == {2}
    assert responses[1].processed.output
    assert warnings == ()


@pytest.mark.parametrize(
    ("script", "reason"),
    [
        (EACH.format('echo "line $n is wrong"'), "no diagnostic named"),
        ('for m in "$@"; do echo "$m:1: good"; done; grep -q wrong "$@" && exit 1 || exit 0', ""),
        ('grep -q wrong "$@" && { echo "$2:2: wrong"; exit 0; }; exit 0', "although diagnostics named"),
        ('[ $# -gt 1 ] && exit 70; grep -q wrong "$@" && exit 1 || exit 0', "came to no answer"),
        ('[ $# -gt 1 ] && head -c 5000000 /dev/zero | tr "\\0" x; grep -q wrong "$@" && exit 1 || exit 0', "MiB"),
    ],
    ids=["unnamed", "names-all", "contradiction", "dies", "too-long"],
)
def test_what_is_not_clear_is_asked_one_by_one_with_a_warning(tmp_path: Path, script: str, reason: str) -> None:
    responses, warnings = checked(tmp_path, script)
    if not reason:
        assert [r.accepted for r in responses] == [False] * 3, "what names every file refuses every model"
        return
    assert responses[1].accepted is ("although" in reason)
    assert [responses[0].accepted, responses[2].accepted] == [True, True]
    (warning,) = warnings
    assert "1 of 1 calls" in warning
    assert reason in warning


MANY = [(f"m{n}", "<a/>\n<wrong/>\n" if n % 3 else "<a/>\n") for n in range(8)]


@pytest.mark.parametrize("kept", ["head -1", "tail -1", "shuf -n 1"], ids=["first", "last", "any"])
def test_a_checker_that_prints_one_finding_a_call_is_asked_again(tmp_path: Path, kept: str) -> None:
    script = f'found=$(grep -n wrong "$@" /dev/null | {kept}); [ -z "$found" ] || {{ echo "$found"; exit 1; }}'
    responses, warnings = checked(tmp_path, script, models=MANY)
    assert [r.accepted for r in responses] == [n % 3 == 0 for n in range(8)]
    assert all(r.lines == {2} for r in responses if not r.accepted)
    (warning,) = warnings
    assert "1 of 2 calls" in warning
    assert "named some of the models" in warning


def test_a_checker_that_stops_at_the_first_refused_model_of_two_is_asked_for_the_other(tmp_path: Path) -> None:
    script = 'found=$(grep -n wrong "$@" /dev/null | head -1); [ -z "$found" ] || { echo "$found"; exit 1; }'
    responses, warnings = checked(tmp_path, script, models=MANY[1:3])
    assert [r.accepted for r in responses] == [False, False]
    assert "1 of 1 calls" in warnings[0]


def test_remarks_name_no_lines() -> None:
    output = (
        "model.xml:1: warning: long\nmodel.xml:2: error: wrong\nother.xml:3: error: elsewhere\nmodel.xml:9: beyond\n"
    )
    expression = r"^(?P<file>.*?):(?P<line>[0-9]+):"
    assert named_lines(output, expression, "<a>\n\n</a>") == {2}
    assert [text for _, _, text in diagnostics_in(output, expression, ("other.xml",))] == [
        "other.xml:3: error: elsewhere"
    ]
