"""The command line: exit statuses, files, known failures, repeats, explanations, replays; never a traceback."""

from __future__ import annotations

import json
import os
import re
import select
import shlex
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from command_line import Outcome, report_of, ucm_cts, within

from ucm_cts.harness.catalogue.requirements import Requirement, load_interpretations, load_requirements
from ucm_cts.harness.execution.judging import may_judge_aside

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("here")]

SUBJECT, REQUIREMENT = "subjects:stops_in_startup_order", "R-11.2.2.1-13"
OTHER = "R-11.2.3-15"
KNOWN = [{"requirement": REQUIREMENT, "observed": "stop shut down *", "reason": "known to us", "expires": "2099-12-31"}]
SCRIPT = """\
- scenario: one
  components: {server: {probe: sink}}
  steps:
    - {op: add_component, component: server}
    - {op: start}
    - {op: add_component, component: server, bind: second}
- scenario: two
  components: {'a "server"\\': {probe: sink}}
  steps:
    - {op: add_component, component: 'a "server"\\'}
    - {op: start}
    - {op: stop}
"""


@pytest.fixture(scope="module")
def failed(tmp_path_factory: pytest.TempPathFactory) -> tuple[Outcome, Path]:
    """A whole run of a framework with one defect."""
    folder = tmp_path_factory.mktemp("failed")
    with pytest.MonkeyPatch.context() as patch:
        within(folder, patch)
        return ucm_cts("run", SUBJECT, "--out", folder / "out"), folder / "out"


# run


def test_conformant_framework_without_a_terminal(here: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "ucm_cts", "run", "reference-py", "--seed", "7", "--out", "new/out"],
        capture_output=True, text=True, encoding="utf-8", check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    first, *rest = (line for line in done.stdout.splitlines() if line)
    assert first.startswith("UCM-CTS ")
    assert first.endswith("profile container, seed 7")
    result = [line for line in rest if not re.match(r"\d+ s: ", line)]  # a line of progress each ten seconds
    assert len(result) == 5
    assert result[0].startswith("✓ CONFORMANT")
    assert result[3].startswith("  hosts ran ")
    assert result[-1] == rest[-1] == "report  new/out/report.html"
    assert not {"\x1b", "\r"} & set(done.stdout)
    report = report_of(here / "new/out")
    assert (report["verdict"], report["seed"]) == ("conformant", 7)
    assert {path.name for path in (here / "new/out").iterdir()} == {
        "report.html", "report.json", "junit.xml", "failures", "ucm-cts-manifest.json"
    }  # fmt: skip


def test_closed_output_does_not_stop_a_run(here: Path) -> None:
    read, write = os.pipe()
    os.close(read)
    command = [sys.executable, "-m", "ucm_cts", "run", "reference-py", "-k", REQUIREMENT, "--out", "out"]
    done = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, text=True, check=False)
    os.close(write)
    assert (done.returncode, done.stderr) == (0, "")
    assert report_of(here / "out")["verdict"] == "conformant"


def test_terminal_that_knows_no_symbols(here: Path) -> None:
    environment = {**os.environ, "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "LC_ALL": "POSIX"}
    environment.pop("PYTHONIOENCODING", None)
    (here / "script.yaml").write_text(SCRIPT)
    for arguments in f"run {SUBJECT} --out out", "replay script.yaml reference-py", f"explain {REQUIREMENT}":
        done = subprocess.run(
            [sys.executable, "-m", "ucm_cts", *arguments.split()], capture_output=True, check=False, env=environment
        )
        assert (done.returncode, done.stderr) == (int(SUBJECT in arguments), b"")
        assert done.stdout.isascii()
        assert (b"x NOT CONFORMANT" in done.stdout) == (SUBJECT in arguments)


def test_lost_output_is_an_error_and_the_report_is_kept(here: Path) -> None:
    command = [sys.executable, "-m", "ucm_cts", "run", "reference-py", "-k", REQUIREMENT, "--out", "out"]
    with open("/dev/full", "w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 3
    assert done.stderr == (
        "ucm-cts: standard output cannot be written: No space left on device; the report is in out\n"
    )
    assert report_of(here / "out")["verdict"] == "conformant"


def test_not_conformant(failed: tuple[Outcome, Path]) -> None:
    outcome, out = failed
    assert (outcome.status, outcome.err) == (1, "")
    assert "✗ NOT CONFORMANT" in outcome.out
    assert f"✗ {REQUIREMENT}" in outcome.out
    assert "observed  stop shut down " in outcome.out
    verdicts = {r["id"]: r["verdict"] for r in report_of(out)["requirements"]}
    assert [name for name, verdict in verdicts.items() if verdict == "fail"] == [REQUIREMENT]


BAD_SCRIPT = SCRIPT.replace("op: stop", "op: halt")
WRONG_USES: dict[str, tuple[str, str]] = {
    "no adapter": ("run", "no ADAPTER is named"),
    "no adapter to replay": ("replay script.yaml", "Short names here: "),
    "no adapter to explore": ("explore", "how to write one for your framework"),
    "adapter": ("run nobody", "'nobody' names no adapter"),
    "nearly an adapter": ("run refernce-py", "Did you mean 'reference-py'?"),
    "class": ("run subjects:Nobody", "module subjects has no Nobody"),
    "spelling": ("run subjects:Misspelled", "'{gate}'; that must hold {port} and {element}"),
    "executable in process": ("run reference-cpp --in-process", "cannot run in the harness process"),
    "profile": ("run reference-py --profile all", "'all' is not one of 'container', 'core'"),
    "profile of tool chains": ("run reference-py --profile pim", "name the file that describes one with --toolchain"),
    "selection": ("run reference-py -k nothing-like-it", "no test purpose matches -k 'nothing-like-it'"),
    "nearly a selection": (f"run reference-py -k {REQUIREMENT}x", f"near it: {REQUIREMENT}"),
    "nothing to resume": ("run reference-py --resume", "holds no interrupted run; leave out --resume"),
    "seed": ("run reference-py --seed x", "'x' is not a valid integer"),
    "timeout": ("run reference-py --timeout 0", "0.0 is not in the range"),
    "timeout below nothing": ("run reference-py --timeout -1", "-1.0 is not in the range"),
    "timeout without end": ("run reference-py --timeout inf", "'inf' is no number of seconds"),
    "timeout that is none": ("replay script.yaml reference-py --timeout nan", "'nan' is no number of seconds"),
    "time for incidents": ("run reference-py --incident-time nan", "'nan' is no number of seconds"),
    "out is nothing": ("run reference-py --out ''", "name a folder for the report"),
    "option": ("run reference-py --frobnicate", "No such option"),
    "no list": ("run reference-py --known-failures none.yaml", "none.yaml: cannot be read"),
    "out is a file": ("run reference-py --out script.yaml", "Directory 'script.yaml' is a file"),
    "out is below a file": ("run reference-py --out script.yaml/out", "written to 'script.yaml/out': Not a directory"),
    "no script": ("replay none.yaml reference-py", "none.yaml: cannot be read: No such file"),
    "a folder": ("replay . reference-py", "is a directory"),
    "bad script": ("replay bad.yaml reference-py", "bad.yaml:12: Invalid value 'halt'"),
    "empty list": ("replay empty.json reference-py", "empty.json:1: holds no scenario"),
    "no adapter to replay on": ("replay script.yaml nobody", "'nobody' names no adapter"),
    "requirement": ("explain R-99-01", "no requirement 'R-99-01'"),
    "nearly a requirement": (f"explain {REQUIREMENT}3", f"near it: {REQUIREMENT}"),
    "command": ("approve", "No such command 'approve'"),
}


@pytest.mark.parametrize(("command", "message"), WRONG_USES.values(), ids=WRONG_USES.keys())
def test_wrong_use_has_status_2_and_a_message(here: Path, command: str, message: str) -> None:
    (here / "script.yaml").write_text(SCRIPT)
    (here / "bad.yaml").write_text(BAD_SCRIPT)
    (here / "empty.json").write_text("[]")
    outcome = ucm_cts(*shlex.split(command))
    assert outcome.status == 2
    assert message in " ".join(outcome.err.split())
    assert "CONFORMANT" not in outcome.out
    assert not (here / "ucm-cts-report" / "report.html").exists()


def test_report_that_finds_its_folder_gone_is_kept_elsewhere(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REPORT", str(here / "out"))
    outcome = ucm_cts("run", "subjects:Vandal", "--no-sandbox", "-k", REQUIREMENT, "--out", "out")
    assert outcome.status == 3
    assert len(outcome.err.splitlines()) == 1
    match = re.fullmatch(r"ucm-cts: the report cannot be written: 'out': .+; it is in '(.+)'\n", outcome.err)
    assert match is not None, outcome.err
    assert report_of(here / match[1])["verdict"] == "conformant"
    assert (here / "out").read_text() == ""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_interrupted_run_reports_its_results_and_is_no_success(
    here: Path, monkeypatch: pytest.MonkeyPatch, number: signal.Signals
) -> None:
    calls = here / "calls"
    os.mkfifo(calls)
    pipe = os.open(calls, os.O_RDWR)
    monkeypatch.setenv("CALL_RECORD", str(calls))
    command = [sys.executable, "-m", "ucm_cts", "run", "subjects:Waiting", "--timeout", "60", "--out", "out"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert select.select([pipe], [], [], 30)[0], "the subject was never called"
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        process.send_signal(number)
        out, err = process.communicate()
    os.close(pipe)
    assert (process.returncode, err) == (1, "")
    assert len(children) == 1 + may_judge_aside(), "the template of hosts and, where there is another core, the judge"
    assert not [child for child in children if Path(f"/proc/{child}").exists()]
    assert "interrupted: the report holds what was measured so far" in out
    assert report_of(here / "out")["verdict"] == "inconclusive"


def verdicts(report: dict[str, Any]) -> dict[str, str]:
    return {result["id"]: result["verdict"] for result in report["requirements"]}


def test_a_seed_repeats_a_run(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def run(name: str, seed: int) -> tuple[dict[str, Any], set[str]]:
        monkeypatch.setenv("CALL_RECORD", str(here / name))
        outcome = ucm_cts(
            "run", "subjects:Listening", "--no-sandbox", "-k", "11.2.1", "--seed", str(seed), "--out", f"{name}-out"
        )
        assert f"seed {seed}\n" in outcome.out
        report = report_of(here / f"{name}-out")
        del report["started"], report["seconds"], report["seconds_by_clause"], report["seed"]
        for result in report["requirements"]:
            del result["seconds"]
        return report, {word for line in (here / name).read_text().splitlines() for word in line.split()[1:]}

    report, names = run("first", 11)
    assert run("second", 11) == (report, names)
    other_report, other_names = run("other", 12)
    assert verdicts(other_report) == verdicts(report), "some scenarios are drawn from the seed, too"
    assert names
    assert not names & other_names


def test_verdict_that_flips_between_runs_is_unstable(here: Path) -> None:
    def run(*options: str) -> dict[str, Any]:
        ucm_cts("run", "subjects:Moody", "-k", "self-connection", "--out", "out", *options)
        return report_of(here / "out")

    def removal(report: dict[str, Any]) -> dict[str, Any]:
        (result,) = (r for r in report["requirements"] if r["id"] == "R-11.2.1.2-06")
        return result

    alone = [removal(run("--seed", str(seed)))["verdict"] for seed in range(1, 9)]
    assert set(alone) == {"pass", "fail"}, "its mood changes with the names that it sees"
    flips = next(seed for seed in range(1, 8) if alone[seed - 1] != alone[seed])
    report = run("--seed", str(flips), "--repeat", "2")
    assert (report["verdict"], report["runs"]) == ("inconclusive", 2)
    assert removal(report)["verdict"] == "inconclusive"
    assert sorted(re.findall(r"(\w+) in 1", removal(report)["reason"])) == ["fail", "pass"]
    assert [finding["unstable"] for finding in removal(report)["findings"]] == [removal(report)["reason"]]
    assert all(finding["trace"] and finding["steady"] for finding in removal(report)["findings"])
    assert "What happened when the same scenario was run again" in (here / "out" / "report.html").read_text()
    steady = next(seed for seed in range(1, 8) if alone[seed - 1] == alone[seed])
    assert removal(run("--seed", str(steady), "--repeat", "2"))["verdict"] == alone[steady]


OTHERWISE_LATER = """
from pathlib import Path
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

class Later(ReferenceAdapter):
    pass

if Path("loaded").exists():
    {what}
Path("loaded").touch()
"""


@pytest.mark.parametrize(
    ("what", "why"),
    [
        ("raise SystemExit(3)", "run 2 of 3 could not begin: "),
        ("Later.product = 'Another'", "run 2 of 3 was of another product, 'Another 1'"),
    ],
)
def test_aborted_series_keeps_its_results(here: Path, monkeypatch: pytest.MonkeyPatch, what: str, why: str) -> None:
    monkeypatch.setenv("PYTHONPATH", str(here))
    Path("otherwise.py").write_text(OTHERWISE_LATER.format(what=what))
    outcome = ucm_cts(
        "run", "otherwise:Later", "--no-sandbox", "-k", "self-connection", "--repeat", "3", "--out", "out"
    )
    assert outcome.status == 1
    assert why in outcome.out
    report = report_of(here / "out")
    assert report["runs"] == 1
    assert report["scenarios"] > 0


def test_selection_checks_only_matching_purposes(here: Path) -> None:
    outcome = ucm_cts("run", "reference-py", "-k", f"{REQUIREMENT} or stop-during-a-call", "--out", "out")
    assert outcome.status == 0, "what was selected is conformant"
    assert f"only -k {REQUIREMENT} or stop-during-a-call" in outcome.out
    report = report_of(here / "out")
    assert (report["verdict"], report["selection"]) == ("conformant", f"{REQUIREMENT} or stop-during-a-call")
    assert {r["verdict"] for r in report["requirements"]} <= {"pass", "not applicable"}
    assert 2 <= report["scenarios"] <= 20, "of more than a thousand"
    assert {r["verdict"] for r in report["requirements"] if r["id"] == REQUIREMENT} == {"pass"}


def test_in_process_starts_no_host(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CALL_RECORD", str(here / "calls"))
    for options, own in (["--in-process"], True), (["--no-sandbox"], False):
        (here / "calls").write_text("")
        ucm_cts("run", "subjects:Listening", "-k", REQUIREMENT, "--out", "out", *options)
        assert {line.split()[0] == str(os.getpid()) for line in (here / "calls").read_text().splitlines()} == {own}


# known failures


def run_with_known(entries: object, *options: str) -> Outcome:
    Path("known.yaml").write_text(json.dumps(entries, indent=1))
    return ucm_cts("run", SUBJECT, "--known-failures", "known.yaml", "--out", "out", *options)


def test_known_failures_change_the_status_and_not_the_verdict(here: Path) -> None:
    outcome = run_with_known(KNOWN)
    assert outcome.status == 0
    assert "✗ NOT CONFORMANT (all failures known)" in outcome.out
    assert "\n  known     known to us\n" in outcome.out
    report = report_of(here / "out")
    assert report["verdict"] == "not conformant"
    (result,) = [r for r in report["requirements"] if r["verdict"] == "fail"]
    assert {finding["waived"] for finding in result["findings"]} == {"known to us"}


@pytest.mark.parametrize(
    "entry",
    [{**KNOWN[0], "requirement": OTHER}, {**KNOWN[0], "observed": "stop shut down nobody"}],
    ids=["another requirement", "another observation"],
)
def test_entry_that_matches_nothing_is_an_error_and_named(entry: dict[str, str]) -> None:
    outcome = run_with_known([*KNOWN, entry])
    assert outcome.status == 1
    message = f"known failure of {entry['requirement']} no longer occurs ({entry['observed']}): remove it\n"
    assert message in outcome.out
    partly = run_with_known([*KNOWN, entry], "-k", REQUIREMENT)
    assert "no longer occurs" not in partly.out, "a run of a part cannot tell"


def test_only_a_star_is_special_in_an_observed_text() -> None:
    subject, observed = (
        "subjects:lists_a_stranger",
        "get_components(manager) returned *: it holds [987654], which are no members",
    )
    Path("known.json").write_text(json.dumps([{**KNOWN[0], "requirement": "R-11.2.2.1-14", "observed": observed}]))
    outcome = ucm_cts("run", subject, "--known-failures", "known.json", "--out", "out")
    assert "no longer occurs" not in outcome.out


@pytest.mark.parametrize(
    ("change", "line", "problem"),
    [
        ({"expires": "2020-01-31"}, 2, "expired on 2020-01-31"),
        ({"expires": "tomorrow"}, 2, "'tomorrow' is no date"),
        ({"requirement": "R-1"}, 2, "no requirement 'R-1'"),
        ({"reason": 5}, 5, "str"),
        ({"because": "x"}, 7, "because"),
    ],
    ids=["expired", "no date", "no requirement", "wrong type", "unknown field"],
)
def test_list_that_cannot_be_used_is_wrong_use(change: dict[str, object], line: int, problem: str) -> None:
    outcome = run_with_known([{**KNOWN[0], **change}])
    assert outcome.status == 2
    assert outcome.err.startswith(f"ucm-cts: known.yaml:{line}: ")
    assert problem in outcome.err


# explain


@pytest.mark.parametrize("profile", sorted({r.profile for r in load_requirements()}))
def test_each_requirement_explains_itself(profile: str) -> None:
    for requirement in load_requirements():
        if requirement.profile == profile:
            _explains_itself(requirement)


def _explains_itself(requirement: Requirement) -> None:
    outcome = ucm_cts("explain", requirement.id)
    assert (outcome.status, outcome.err) == (0, "")
    text = " ".join(outcome.out.split())
    expected = [requirement.id, requirement.title, f"clause {requirement.clause},", requirement.meaning]
    expected += [requirement.untestable, requirement.pending, requirement.observed]
    expected += [f"Checked by {name}:" for name in requirement.rules]
    expected += [line for i in load_interpretations() if i.id in requirement.interpretations for line in i.lines]
    for words in expected:
        assert " ".join(words.split()) in text
    assert ("Not tested:" in text) == bool(requirement.untestable)
    assert ("Not checked yet:" in text) == bool(requirement.pending)


def test_explain_takes_short_spellings_and_lists_the_catalogue() -> None:
    assert (
        ucm_cts("explain", "11.2.2.1-13") == ucm_cts("explain", REQUIREMENT.lower()) == ucm_cts("explain", REQUIREMENT)
    )
    overview = ucm_cts("explain").out
    assert [line.split()[0] for line in overview.splitlines() if line.startswith("R-")] == [
        r.id for r in load_requirements()
    ]


# replay


def test_saved_failure_fails_again_the_same_way(failed: tuple[Outcome, Path]) -> None:
    (finding,) = [f for r in report_of(failed[1])["requirements"] for f in r["findings"]]
    saved = failed[1] / finding["replay"]
    again = ucm_cts("replay", saved, SUBJECT)
    assert (again.status, again.err) == (1, "")
    assert "1 finding" in again.out
    assert again.out.count(" add_component ") == 2, "the trace is printed once"
    (title,) = [r.title for r in load_requirements() if r.id == REQUIREMENT]
    assert f"\n✗ {REQUIREMENT}  {title} (rule stop_order, at " in again.out
    assert "\n  expected  stop shuts down " in again.out
    assert len(json.loads(saved.read_text())["steps"]) == 4, "two members, start, stop"
    report = report_of(failed[1])
    assert len([r for r in report["requirements"] if r["verdict"] == "fail"]) == 1
    right = ucm_cts("replay", saved, "reference-py")
    assert (right.status, right.err) == (0, "")
    assert "no findings" in right.out


@pytest.mark.parametrize("adapter", ["reference-py", "reference-cpp", "reference-cpp-module"])
def test_scripts_are_replayed_one_by_one_in_their_own_names(here: Path, adapter: str) -> None:
    (here / "script.yaml").write_text(SCRIPT)
    outcome = ucm_cts("replay", "script.yaml", adapter)
    assert (outcome.status, outcome.err) == (0, "")
    assert outcome.out.startswith("one on ")
    assert "\ntwo on " in outcome.out
    assert "add_component server as second" in outcome.out
    assert 'add_component a "server"\\' in outcome.out
    assert outcome.out.count("no findings") == 2


def test_replay_of_a_crash_shows_the_events_before(here: Path) -> None:
    (here / "script.yaml").write_text(SCRIPT.replace("op: stop", "op: start"))
    outcome = ucm_cts("replay", "script.yaml", "subjects:Crashing")
    assert (outcome.status, outcome.err) == (1, "")
    crashed = outcome.out[outcome.out.index("\ntwo on ") :]
    assert "on_startup()" in crashed
    assert "\ncrash: SIGSEGV" in crashed
    assert "subjects.py" in crashed, "the stack leads to the place"
