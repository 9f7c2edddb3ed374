"""Mutants of the C++ reference framework are found out by the ordinary pipeline; the slow ones by ``harness/selftest/native.py``."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from cpp_builds import Builds

from ucm_cts.adapters.mutants.cpp import VARIABLE, NativeMutant, native_mutants
from ucm_cts.adapters.mutants.python.subjects import MUTANTS
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.selftest.trials import Thoroughness, examine_mutant, native_subject

pytestmark = pytest.mark.native

QUICK = {
    "crashes_in_remove": "whole-life",
    "hangs_in_second_stop": "late-addition-is-connected",
    "messages_share_a_buffer": "burst/2 to 2",
    "thread_runs_on_after_stop": "self-executing/alone",
    "unlocks_too_early": "protected passive/one port",
    "uses_freed_connection": "unforeseen",
    "uses_freed_member": "whole-life",
}
"""What finds some of them out in a second or two: purposes whose name begins so."""

OF_EXTENSIONS = (
    "answers_the_first_request",
    "cancels_no_data",
    "cannot_release_data",
    "doubles_distances_of_calls",
    "each_third_timer_is_lost",
    "executes_paced_calls_side_by_side",
    "forgets_data_that_was_read",
    "forgets_each_third_request",
    "forgets_offsets_of_calls",
    "forgets_offsets_of_runs",
    "freezes_data_once",
    "freezes_no_data",
    "halves_distances_of_calls",
    "halves_periods_of_runs",
    "keeps_the_first_data",
    "misses_data_while_frozen",
    "passes_on_second_responses",
    "reads_go_back",
    "releases_to_the_first_missed_data",
    "repeats_the_first_response",
    "repeats_the_first_result",
    "runs_beside_calls",
    "runs_in_the_background_for_ever",
    "sets_no_data_after_cancelling",
    "stretches_periods_of_calls",
    "stretches_periods_of_runs",
    "takes_unknown_responses",
    "timers_are_early",
    "timers_are_late",
    "timers_are_not_cancelled",
    "timers_pass_the_guard",
    "two_open_requests_have_one_number",
)
"""Those of 10.3, 10.4 and 10.5."""


@pytest.fixture(scope="module")
def command(builds: Builds) -> Path:
    return builds.prefix / "adapters" / "bin" / "reference-cpp-mutants"


@pytest.fixture(scope="module")
def known(command: Path) -> dict[str, NativeMutant]:
    return native_mutants(command)


def test_each_mutant_names_its_requirements(known: dict[str, NativeMutant]) -> None:
    requirements = {requirement.id for requirement in load_requirements()}
    assert len(known) >= 10
    assert not known.keys() & MUTANTS.keys(), "the self-test knows mutants by name"
    for mutant in known.values():
        assert mutant.lie.endswith(".")
        assert mutant.requirements
        assert {*mutant.requirements, *mutant.also} <= requirements
        assert any(purpose.clause.startswith(mutant.clauses) for purpose in load_purposes("extensions"))


@pytest.mark.parametrize("name", QUICK)
def test_mutant_is_found_out(command: Path, known: dict[str, NativeMutant], name: str) -> None:
    result = examine_mutant(native_subject(known[name], command), Thoroughness(beginning=QUICK[name]))
    assert not result.spills
    assert not result.wrongly_said
    assert {kill.requirement for kill in result.kills if kill.names_the_place} & set(known[name].requirements)


@pytest.mark.slow
@pytest.mark.parametrize("name", OF_EXTENSIONS)
def test_mutant_of_extensions_fails_for_the_right_reason(
    command: Path, known: dict[str, NativeMutant], name: str
) -> None:
    result = examine_mutant(native_subject(known[name], command), Thoroughness(quick=True))
    assert result.is_killed, (result.survives, result.trouble, result.incidents)
    assert not result.spills
    assert not result.wrongly_said


def test_all_mutants_of_extensions_are_examined(known: dict[str, NativeMutant]) -> None:
    assert {*OF_EXTENSIONS} == {
        name for name, mutant in known.items() if mutant.clauses[0].startswith(("10.3", "10.4", "10.5"))
    }


def test_unknown_mutant_is_refused(command: Path) -> None:
    done = subprocess.run([command], env={VARIABLE: "nobody"}, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr == f"there is no mutant 'nobody'; {VARIABLE}=list names them all\n"
