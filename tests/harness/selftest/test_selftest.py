"""The self-test distinguishes kills for the right reason from others, and spared variants from failed ones."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from command_line import ucm_cts, within
from performing import answer, scenario

from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Enter, Trace
from ucm_cts.adapters.mutants.python.subjects import MUTANTS
from ucm_cts.harness.selftest.divergence import divergence
from ucm_cts.harness.selftest.matrix import Matrix
from ucm_cts.harness.selftest.models_killing import all_models, examine_models
from ucm_cts.harness.selftest.page import to_html
from ucm_cts.harness.selftest.running import SelfTest
from ucm_cts.harness.selftest.trials import Thoroughness, all_mutants, examine_mutant, examine_variant
from ucm_cts.reference_models.findings import Finding

pytestmark = pytest.mark.slow

ASKED = scenario(
    {"server": {"provides": ["in.api"]}, "client": {"requires": ["out.api"]}},
    [
        "add_component component=server",
        "add_component component=client",
        "get_port_element id=server port=in.api bind=api",
        "connect id=client port=out.api to=api bind=link",
        "start",
        "get_components",
        "stop",
        "remove_component id=client",
    ],
)
START, STOP = 4, 6
QUICK = Thoroughness(quick=True)


def trace_of(adapter: str = "", asked: Scenario = ASKED) -> Trace:
    replied = answer(asked, MUTANTS[adapter].adapter) if adapter else answer(asked)
    assert isinstance(replied, Traced)
    return replied.events


def finding(*events: int, step: int | None = None) -> Finding:
    return Finding("R-1", "rule", "cause", "this", "that", events, step)


# where traces part


def test_ids_times_and_threads_are_no_divergence() -> None:
    right = trace_of()
    other = tuple(msgspec.structs.replace(event, t=event.t + 5, thread=event.thread + 1) for event in right)
    parted = divergence(ASKED, right, other)
    assert (parted.events, parted.steps) == (frozenset(), frozenset())
    assert not parted.explains(finding(1, 2, step=START))


def test_missing_event_is_explained_by_its_step_only() -> None:
    right = trace_of()
    shutdown = next(e for e in right if isinstance(e, Enter) and e.hook == "on_shutdown")
    lost = {shutdown.n, shutdown.n + 1}
    kept = [event for event in right if event.n not in lost]
    wrong = tuple(msgspec.structs.replace(event, n=number) for number, event in enumerate(kept, 1))
    parted = divergence(ASKED, right, wrong)
    assert parted.events == frozenset()
    assert parted.steps == {STOP}
    assert parted.explains(finding(step=STOP))
    assert parted.explains(finding(shutdown.n))
    assert not parted.explains(finding(step=START))
    assert not parted.explains(finding(1, 2))


def test_additional_event_is_explained_by_itself() -> None:
    right = trace_of()
    wrong = trace_of("initialises_at_stop")
    parted = divergence(ASKED, right, wrong)
    again = [e.n for e in wrong if isinstance(e, Enter) and e.hook == "on_init"][2:]
    assert parted.events >= set(again)
    assert parted.explains(finding(again[0]))
    assert not parted.explains(finding(step=START))


# mutants and variants


def test_mutant_is_killed() -> None:
    result = examine_mutant(all_mutants()["initialises_at_stop"], QUICK)
    assert (result.is_killed, result.survives, result.spills, result.trouble) == (True, (), (), "")
    (kill,) = result.kills
    assert kill.names_the_place
    assert (kill.requirement, result.clause) == ("R-11.2.1.2-04", "11.2.1.2")


def test_failure_of_another_requirement_is_no_kill() -> None:
    mutant = replace(all_mutants()["initialises_at_stop"], breaks=("R-11.2.1.2-01",), clauses=("11.2.1.2",))
    result = examine_mutant(mutant, QUICK)
    assert (result.is_killed, result.survives) == (False, ("R-11.2.1.2-01",))
    assert [kill.requirement for kill in result.further] == ["R-11.2.1.2-04"], "it names the defect"
    assert result.spills == ()
    excused = examine_mutant(replace(mutant, also=("R-11.2.1.2-04",)), QUICK)
    assert (excused.is_killed, excused.further, excused.spills) == (False, (), ())


def test_finding_about_other_events_does_not_kill(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ucm_cts.harness.selftest.divergence.Divergence.explains", lambda *_: False)
    result = examine_mutant(replace(all_mutants()["initialises_at_stop"], clauses=("11.2.1.2",)), QUICK)
    assert not result.is_killed
    assert [kill.names_the_place for kill in result.kills] == [False]
    other = examine_mutant(
        replace(all_mutants()["initialises_at_stop"], breaks=("R-11.2.1.2-01",), clauses=("11.2.1.2",)), QUICK
    )
    assert [kill.requirement for kill in other.spills] == ["R-11.2.1.2-04"]
    assert other.further == ()


def test_wrong_framework_is_no_conformant_variant() -> None:
    mutant = all_mutants()["initialises_at_stop"]
    result = examine_variant(replace(mutant, breaks=(), clauses=("11.2.1.2",)), QUICK)
    assert not result.is_spared
    assert [kill.requirement for kill in result.failed] == ["R-11.2.1.2-04"]


def test_subject_that_cannot_be_had_is_not_killed_and_no_others_suffer() -> None:
    there, gone = all_mutants()["initialises_at_stop"], replace(all_mutants()["delivers_twice"], adapter="no.such:One")
    conduct = SelfTest([gone, replace(there, clauses=("11.2.1.2",))], [], QUICK, jobs=2)
    received: list[str] = []
    conduct.run(lambda result: received.append(result.name))
    assert sorted(received) == ["delivers_twice", "initialises_at_stop"]
    assert [mutant.name for mutant in conduct.matrix.survivors] == ["delivers_twice"]
    assert "no.such:One" in conduct.matrix.survivors[0].trouble
    assert not conduct.matrix.is_proved


# the command


def test_command_writes_the_matrix(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    within(tmp_path, monkeypatch)
    named = ["initialises_at_stop", "attributes_after_init", "sorts_its_list"]
    outcome = ucm_cts("selftest", *named, "--quick", "--out", "out", "--jobs", "1")
    assert (outcome.status, outcome.err) == (0, "")
    assert "0 of 0 conformant variants spared" in outcome.out, "the quick self-test leaves them out"
    matrix = msgspec.json.decode(Path("out/matrix.json").read_bytes(), type=Matrix)
    assert [mutant.name for mutant in matrix.mutants if mutant.is_killed] == sorted(named[:2])
    page = Path("out/matrix.html").read_text()
    assert "2 of 2 mutants killed" in page
    assert len(re.findall(r'<rect class="killed"[^>]*><title>initialises_at_stop, R-11.2.1.2-04: ', page)) == 1
    assert json.loads(Path("out/matrix.json").read_text())["testable"]


def test_interrupted_self_test_keeps_its_results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    within(tmp_path, monkeypatch)
    named = ["initialises_at_stop", "attributes_after_init", "delivers_twice", "notes_every_call"]
    command = [sys.executable, "-u", "-m", "ucm_cts", "selftest", *named, "--jobs", "1", "--out", "out"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        first = next(line for line in process.stdout if "examined" in line)
        process.send_signal(signal.SIGINT)
        rest, err = process.communicate()
    assert (process.returncode, err) == (1, "")
    assert first.startswith("1 of 4 examined")
    assert "interrupted: the matrix holds what was found so far" in rest
    matrix = msgspec.json.decode(Path("out/matrix.json").read_bytes(), type=Matrix)
    assert 1 <= len(matrix.mutants) < 4
    assert matrix.left_out == 4 - len(matrix.mutants)
    assert not matrix.is_proved
    assert "subjects not examined" in Path("out/matrix.html").read_text()


def test_whole_matrix_needs_a_killed_mutant_for_each_requirement() -> None:
    matrix = Matrix("1", 1, 1.0, ("R-11.2.1.2-01",), (), (), False)
    assert matrix.is_proved
    assert not msgspec.structs.replace(matrix, is_all=True).is_proved
    assert msgspec.structs.replace(matrix, is_all=True).unproved == ("R-11.2.1.2-01",)


def test_models_are_spoilt_for_each_requirement() -> None:
    for requirement in all_models():
        result = examine_models(requirement)
        assert result.is_killed, requirement
        assert not result.spills, requirement


def test_page_names_survivors_and_spills() -> None:
    mutant = replace(all_mutants()["initialises_at_stop"], breaks=("R-11.2.1.2-01",), clauses=("11.2.1.2",))
    with pytest.MonkeyPatch.context() as patch:  # no finding names the defect
        patch.setattr("ucm_cts.harness.selftest.divergence.Divergence.explains", lambda *_: False)
        result = examine_mutant(mutant, QUICK)
    wronged = examine_variant(replace(mutant, breaks=(), name="<b>"), QUICK)
    matrix = Matrix("1", 1, 1.0, ("R-11.2.1.2-01",), (result,), (wronged,), False)
    page = to_html(matrix)
    assert "0 of 1 mutants killed" in page
    assert "survives (R-11.2.1.2-01)" in page
    assert "also fails R-11.2.1.2-04" in page
    assert "<code>&lt;b&gt;</code> is conformant and fails R-11.2.1.2-04" in page
    assert page.count('class="missed"') == page.count('class="spill"') == 2  # one of each is the key's


def test_names_are_listed_and_wrong_ones_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    within(tmp_path, monkeypatch)
    listed = ucm_cts("selftest", "--list")
    assert listed.status == 0
    assert all(name in listed.out for name in MUTANTS)
    assert "models of R-10.1.3.1-03 are spoilt" in listed.out
    assert ucm_cts("selftest", "--list", "hides_errors").out.startswith("hides_errors cheats: ")
    wrong = ucm_cts("selftest", "nobody")
    assert wrong.status == 2
    assert "'nobody'" in wrong.err
    nothing = ucm_cts("selftest", "--quick", "sorts_its_list")
    assert nothing.status == 2
    assert "--quick leaves conformant variants out" in nothing.err
    unwritable = ucm_cts("selftest", "initialises_at_stop", "--out", "/proc/nowhere")
    assert unwritable.status == 2
    assert "cannot be written to '/proc/nowhere'" in unwritable.err
    assert "examined" not in unwritable.out
    assert not list(tmp_path.iterdir())
