"""Documents, options and names that no user means: each gets one clear line and exit status 2, and nothing waits for ever."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from aftermath import nothing_left  # noqa: F401 - a fixture
from command_line import report_of, ucm_cts, within

from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.models.core_models import compare
from ucm_cts.harness.results.statement import default_statement

pytestmark = pytest.mark.usefixtures("nothing_left")

SCRIPT = """
- scenario: one
  components: {{{name}: {{probe: sink}}}}
  steps:
    - {{op: add_component, component: {name}}}
    - {{op: {step}}}
"""
TOOLS = 'product = "p"\nversion = "1"\n{limits}\n[check]\ncommand = ["{program}", "{{model}}"]\n{more}\n'
NO_FILE = "pipe: is no plain file; write what it holds to a file, and give its name"
RE2 = "the diagnostic is no regular expression of RE2, which has no look-around and no back-references: "


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    within(tmp_path, monkeypatch)
    os.mkfifo(tmp_path / "pipe")
    os.mkfifo(tmp_path / "pipe.toml")
    os.symlink("/dev/zero", tmp_path / "zero")
    (tmp_path / "large").touch()
    os.truncate(tmp_path / "large", 1 << 40)
    (tmp_path / "ok.yaml").write_text(SCRIPT.format(name="a", step="start"))
    return tmp_path


def script(text: str) -> Callable[[Path], None]:
    return lambda folder: (folder / "s.yaml").write_text(text) and None


def tools(limits: str = "", more: str = "", program: str = "true") -> Callable[[Path], None]:
    text = TOOLS.format(limits=limits, more=more, program=program)
    return lambda folder: (folder / "t.toml").write_text(text) and None


def stated(text: str) -> Callable[[Path], None]:
    return lambda folder: (folder / "i.toml").write_text(text) and None


def nothing(folder: Path) -> None:
    """No further file."""


INPUTS: dict[str, tuple[str, Callable[[Path], None], str]] = {
    "statement is a pipe": ("run reference-py --ics pipe", nothing, NO_FILE),
    "statement is a device": ("run reference-py --ics zero", nothing, NO_FILE.replace("pipe", "zero")),
    "statement is a folder": ("run reference-py --ics .", nothing, ".*File '.' is a directory."),
    "statement is large": ("run reference-py --ics large", nothing, "large: is larger than 262144 bytes; .*"),
    "known failures are a pipe": ("run reference-py --known-failures pipe", nothing, NO_FILE),
    "scenarios are a pipe": ("replay pipe reference-py", nothing, NO_FILE),
    "scenarios are large": ("replay large reference-py", nothing, "large: is larger than 4194304 bytes; .*"),
    "report is a pipe": ("compare pipe pipe", nothing, NO_FILE),
    "tool chain is a pipe": ("run --toolchain pipe", nothing, NO_FILE),
    "statement is written to a pipe": (
        "ics reference-py --force --out pipe",
        nothing,
        "'pipe' cannot be written: No such device or address; choose another file with --out",
    ),
    "timeout": (
        "run reference-py --timeout 1e308",
        nothing,
        "Invalid value for '--timeout': '1e308' is longer than a day; give at most 86400 seconds.",
    ),
    "time for incidents": (
        "run reference-py --incident-time 1e308",
        nothing,
        "Invalid value for '--incident-time': '1e308' is longer than a day; give at most 86400 seconds.",
    ),
    "memory": ("run reference-py --memory 1e308", nothing, ".*'1e308' is not a valid integer range."),
    "budget": ("explore reference-py --budget 99999999999999999999h", nothing, ".*--budget.*"),
    "seconds of a tool": (
        "run --toolchain t.toml",
        tools("seconds = 1e308"),
        "t.toml:3: seconds is greater than 0 and at most 86400",
    ),
    "no seconds of a tool": (
        "run --toolchain t.toml",
        tools("seconds = nan"),
        "t.toml:3: seconds is greater than 0 and at most 86400",
    ),
    "seconds of a tool without end": (
        "run --toolchain t.toml",
        tools("seconds = inf"),
        "t.toml:3: seconds is greater than 0 and at most 86400",
    ),
    "memory of a tool": (
        "run --toolchain t.toml",
        tools(f"memory = {2**62}"),
        r"t.toml:3: memory is greater than 0 and at most 1048576 \(MiB\)",
    ),
    "stated time": (
        "run reference-py --ics i.toml",
        stated("[ixit]\npatience = 1e308\n"),
        r"i.toml:2: patience is a number of ms from 1 to 3.6e\+06",
    ),
    "pause": (
        "replay s.yaml reference-py",
        script(SCRIPT.format(name="a", step="pause, milliseconds: 1e308")),
        "s.yaml:6: .*",
    ),
    "long pause": (
        "replay s.yaml reference-py",
        script(SCRIPT.format(name="a", step="pause, milliseconds: 9223372036854775807")),
        "s.yaml:6: .*",
    ),
    "NUL in a program": (
        "run --toolchain t.toml",
        tools(program="a\\u0000b"),
        r"t.toml:5: a command holds the character U\+0000, which no word can; take it out",
    ),
    "NUL in a path of a model": (
        "run reference-py --profile core --ics i.toml",
        stated('[models]\ncore = ["a\\u0000b"]\n'),
        "i.toml:2: core is a list of texts in quotes, in brackets",
    ),
    "NUL in an adapter": ("run a\0b:C", nothing, "'a\u2400b:C' names no adapter.*"),
    "NUL in a socket": ("run unix:/a\0b", nothing, "no adapter answers at unix:/a\u2400b: .*"),
    "NUL in a path": ("run /a\0b", nothing, "there is no file '/a\u2400b'"),
    "NUL in a requirement": ("explain R\0", nothing, "no requirement, clause or operation 'R\u2400'.*"),
    "long path of a socket": (
        f"run unix:/{'x' * 300}",
        nothing,
        "the path of a socket has at most 107 bytes; choose another for 'unix:/x+'",
    ),
    "long path": (f"run /{'x' * 300}", nothing, "there is no file '/x+'"),
    "long name": (f"run {'x' * 300}", nothing, "'x+' names no adapter.*"),
    "expression that looks ahead": (
        "run --toolchain t.toml",
        tools(more="diagnostic = '(?=x)(?P<line>1)'"),
        re.escape(f"t.toml:6: {RE2}invalid perl operator: (?="),
    ),
    "expression that takes memory": (
        "run --toolchain t.toml",
        tools(more="diagnostic = '(?P<line>((a{999}){999}){999})'"),
        re.escape(f"t.toml:6: {RE2}") + ".*(repetition size|too large).*",
    ),
    "expression without end": (
        "run --toolchain t.toml",
        tools(more="diagnostic = '" + "(" * 100_000 + "'"),
        re.escape(f"t.toml:6: {RE2}") + ".*",
    ),
}


def files(folder: Path) -> set[Path]:
    return {path for path in folder.rglob("*") if not path.is_dir()}


@pytest.mark.parametrize(("command", "prepare", "line"), INPUTS.values(), ids=INPUTS)
def test_input_gets_one_line(here: Path, command: str, prepare: Callable[[Path], None], line: str) -> None:
    prepare(here)
    before = files(here)
    outcome = ucm_cts(*command.split(" "))
    *usage, last = outcome.err.splitlines()
    assert outcome.status == 2
    said = last.removeprefix("ucm-cts: ").removeprefix("Error: ")
    assert re.fullmatch(line, said), last
    assert all(one.startswith(("Usage: ", "Try ")) or not one for one in usage)
    assert files(here) == before, "nothing is written"


def started(command: str) -> tuple[int, str, str]:
    """Exit status and outputs of a shell's ``command``, in which ``$RUN`` runs a few scenarios."""
    run = shlex.join([sys.executable, "-m", "ucm_cts", "run", "reference-py", "-k", "R-11.2.2.1-13"])
    done = subprocess.run(["sh", "-c", command.replace("$RUN", run)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def test_folder_that_is_gone_gets_one_line(here: Path) -> None:
    status, out, err = started(f"mkdir gone; cd gone; rmdir ../gone; $RUN --out {here}/out")
    assert (status, out) == (2, "")
    assert err.endswith("the current folder cannot be used: No such file or directory; go to another one\n")
    assert "Traceback" not in err


def test_too_few_open_files_get_one_line(here: Path) -> None:
    status, out, err = started(f"ulimit -n 16; $RUN --out {here}/out")
    remedy = "64 are needed: ulimit -n 64, or what your system has for that"
    assert (status, out, err) == (2, "", f"ucm-cts: at most 16 files may be open at once; {remedy}\n")


def test_usual_limit_of_open_files_is_raised(here: Path) -> None:
    status, _, err = started("ulimit -S -n 16; $RUN --out out")
    assert (status, err) == (0, "")
    assert report_of(here / "out")["verdict"] == "conformant"


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
def test_closed_streams_lose_nothing(here: Path, closed: str) -> None:
    status, _, err = started(f"$RUN --out out {closed}")
    assert (status, err) == (0, "")
    assert report_of(here / "out")["verdict"] == "conformant"


def test_names_may_hold_anything(here: Path) -> None:
    (here / "s.yaml").write_text(SCRIPT.format(name='"a\\0\\e[2J"', step="start"))
    outcome = ucm_cts("replay", "s.yaml", "reference-py")
    assert (outcome.status, outcome.err) == (0, "")
    assert "\0" not in outcome.out
    assert "\x1b" not in outcome.out


def test_model_that_is_a_pipe_gets_one_line(here: Path) -> None:
    with pytest.raises(DocumentError) as caught:
        compare([here / "pipe"], default_statement().readings)
    assert str(caught.value) == f"{here}/{NO_FILE}"


@pytest.mark.parametrize(
    ("attack", "line"),
    [("PrintsAndBreaks", "value of x: 42"), ("AsksForPdb", r"> .*attacking.py\(\d+\)start\(\)")],
)
def test_what_a_framework_prints_is_seen_in_a_replay(here: Path, attack: str, line: str) -> None:
    (here / "s.yaml").write_text(SCRIPT.format(name="a", step="start"))
    outcome = ucm_cts("replay", "s.yaml", f"hostile.attacking:{attack}")
    printed = outcome.out.splitlines()
    first = printed.index("printed by the host")
    assert re.fullmatch(rf"  \| {line}", printed[first + 1])
    assert f"debug it with: ucm-cts replay s.yaml hostile.attacking:{attack} --in-process" in printed
    if attack == "PrintsAndBreaks":
        assert re.fullmatch(
            r"  \| breakpoint\(\) at .*attacking.py:\d+: a host has no debugger; .*", printed[first + 2]
        )
        assert outcome.status == 0, "a breakpoint is no failure"
