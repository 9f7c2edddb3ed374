"""The systematic suites find every wrong machine, by the machine's own outputs and by the monitor."""

from __future__ import annotations

import itertools
import random
import re
from collections import Counter
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

import pytest
from command_line import report_of, ucm_cts
from files import ROOT

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.mutants.python.subjects import MUTANTS, VARIANTS
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_options
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.scripts import Part, Script, problems
from ucm_cts.harness.purposes.systematic.comparison import (
    CASES,
    READINGS,
    Comparison,
    compare,
    keeps_its_guarantee,
    table_of,
)
from ucm_cts.harness.purposes.systematic.derivation import derive
from ucm_cts.harness.purposes.systematic.faults import Fault, Subject, Tried
from ucm_cts.harness.purposes.systematic.identification import (
    NotReduced,
    characterisation_set,
    distinguishing_length,
    harmonised_identifiers,
    reduced,
)
from ucm_cts.harness.purposes.systematic.machine import Machine, Move, Observation, Permitted
from ucm_cts.harness.purposes.systematic.purposes import systematic_purposes
from ucm_cts.harness.purposes.systematic.settings import NAMES, Setting, relays, setting
from ucm_cts.harness.purposes.systematic.simulation import RIGHT, can_happen, simulate
from ucm_cts.harness.purposes.systematic.suites import Method, Suite, hsi, tour, transition_cover, w, wp
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

Build = Callable[[], Setting]

one, two, below, across = IDENTIFIED = [partial(setting, name) for name in NAMES]

DECLARATIONS = ({}, dict(READINGS))
"""A vendor who declares nothing, and one who declares every choice."""

ADAPTER = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"

PAGE = ROOT / "docs" / "systematic.md"
TABLES = ROOT / "docs" / "systematic-comparison.txt"

of_vendors = pytest.mark.parametrize("readings", DECLARATIONS, ids=["undeclared", "declared"])
of_settings = pytest.mark.parametrize("build", IDENTIFIED, ids=NAMES)


def machine_of(build: Build, readings: dict[str, str] = DECLARATIONS[1]) -> Machine:
    machine = derive(load_life_cycle(), build(), readings)
    return reduced(machine) if machine.final else machine


def survivors(subject: Subject, suite: Suite, faults: Iterable[Fault]) -> Counter[str]:
    """How many of each kind are wrong and not found out."""
    tried = Tried(subject, suite)
    return Counter(f.kind for f in faults if tried.kills(f) is None and subject.is_wrong(f))


def single_faults(subject: Subject) -> list[Fault]:
    return [*subject.output_faults(), *subject.transfer_faults(), *subject.missing_states()]


# the machines


def test_a_component_lives_as_the_table_says() -> None:
    machine = machine_of(one)
    seen = [
        machine.outputs[move.output].observations[0]
        for _, _, move in machine.path([machine.inputs.index(i) for i in ("add server", "start", "remove server")])
    ]
    assert seen == [
        Observation("return", (("server", ("on_init",)),)),
        Observation("return", (("server", ("on_startup",)),)),
        Observation("UCM_ERROR"),
    ]


def test_undeclared_choices_are_permitted_and_left_out_where_states_differ() -> None:
    free, bound = (machine_of(two, readings) for readings in DECLARATIONS)
    assert free.transitions < bound.transitions
    started = free.after([free.inputs.index(i) for i in ("add server", "start")])
    assert started is not None
    again = free.outputs[free.moves[started][free.inputs.index("start")].output]
    assert {seen.answer for seen in again.observations} == {"return", "UCM_ERROR"}
    assert free.inputs.index("remove server") not in free.moves[started]
    assert free.inputs.index("add client") not in free.moves[started]


def test_components_in_any_number_make_the_known_numbers_of_states() -> None:
    """Stopped, each of k components is connected to any of k or to none; started, each to any; started and empty is left out."""
    assert len(machine_of(lambda: relays(2)).moves) == (1 + 2 * 2 + 9) + (2 * 1 + 4)
    assert len(machine_of(lambda: relays(3)).moves) == (1 + 3 * 2 + 3 * 9 + 64) + (3 * 1 + 3 * 4 + 27)


# the promise


@of_vendors
@of_settings
@pytest.mark.parametrize("method", [hsi, wp, w], ids=lambda method: method.__name__)
def test_all_single_faults_and_pairs_of_faults_are_found_out(
    build: Build, readings: dict[str, str], method: Method
) -> None:
    subject = Subject(machine_of(build, readings))
    faults = [*single_faults(subject), *subject.two_faults(400, seed=1)]
    assert {f.kind for f in faults} == {"output", "transfer", "missing state", "two faults"}
    assert not survivors(subject, method(subject.machine, 0), faults)


@pytest.mark.parametrize(("build", "extra"), [(one, 1), (one, 2), (two, 1)], ids=["one, 1", "one, 2", "two, 1"])
def test_extra_states_are_found_out(build: Build, extra: int) -> None:
    subject = Subject(machine_of(build))
    faults = itertools.islice(subject.extra_states(extra), 0, None, 3)
    assert not survivors(subject, hsi(subject.machine, extra), faults)


@pytest.mark.parametrize("build", [below, across], ids=["below", "across"])
def test_extra_states_of_larger_machines_are_found_out(build: Build) -> None:
    """A sample; the comparison tries more."""
    subject = Subject(machine_of(build))
    assert not survivors(subject, hsi(subject.machine, 1), itertools.islice(subject.extra_states(1), 0, None, 67))


@of_settings
def test_suites_without_state_identification_let_transfer_faults_survive(build: Build) -> None:
    subject = Subject(machine_of(build))
    faults = single_faults(subject)
    blind = survivors(subject, transition_cover(subject.machine), faults)
    assert blind.keys() == {"transfer"}
    assert blind["transfer"] > 0.9 * sum(f.kind == "transfer" for f in faults)
    assert survivors(subject, tour(subject.machine), faults).keys() == {"transfer"}


@pytest.mark.parametrize("without", range(3))
def test_suites_that_lack_a_third_of_their_words_let_some_survive(without: int) -> None:
    subject = Subject(machine_of(two))
    rest = tuple(word for n, word in enumerate(hsi(subject.machine, 0)) if n % 3 != without)
    assert survivors(subject, rest, single_faults(subject))


def test_suites_for_fewer_extra_states_let_some_survive() -> None:
    subject = Subject(machine_of(one))
    for extra in (1, 2):
        assert survivors(subject, hsi(subject.machine, extra - 1), subject.extra_states(extra))


@of_settings
def test_identifiers_tell_each_two_states_apart(build: Build) -> None:
    machine = machine_of(build)
    identifiers = harmonised_identifiers(machine)
    states = [state for state in range(len(machine.moves)) if state not in machine.final]
    for pair in itertools.combinations(states, 2):
        shared = {word[:n] for word in identifiers[pair[0]] for n in range(1, len(word) + 1)}
        others = {word[:n] for word in identifiers[pair[1]] for n in range(1, len(word) + 1)}
        assert any(distinguishing_length(machine, pair, word) for word in shared & others), pair
        assert any(distinguishing_length(machine, pair, word) for word in characterisation_set(machine))


def test_states_that_nothing_distinguishes_are_said_to_be_so() -> None:
    output = Permitted((Observation("return"),)), Permitted((Observation("return"), Observation("UCM_ERROR")))
    machine = Machine(("go", "stay"), output, ({0: Move(1, 0), 1: Move(0, 0)}, {0: Move(0, 1), 1: Move(1, 0)}))
    with pytest.raises(NotReduced, match="no word distinguishes the states after '' and after 'go'"):
        hsi(machine, 0)
    assert reduced(machine).moves == ({0: Move(1, 0), 1: Move(0, 0)}, {})


def test_every_declaration_has_a_suite() -> None:
    reported = {outcome.reading.partition("=")[0] for row in load_life_cycle().rows for outcome in row.outcomes} - {""}
    assert len(reported) > 12
    for option in sorted(reported):
        for value in load_options()[option]:
            assert len(systematic_purposes({option: value})) == len(IDENTIFIED), (option, value)


@pytest.mark.parametrize("count", [2, 3])
def test_tours_take_every_transition_and_hardly_any_twice(count: int) -> None:
    machine = machine_of(lambda: relays(count))
    words = tour(machine)
    assert {(state, asked) for word in words for state, asked, _ in machine.path(word)} == {
        (state, asked) for state, moves in enumerate(machine.moves) for asked in moves
    }
    assert sum(map(len, words)) <= 1.05 * machine.transitions
    with pytest.raises(ValueError, match="no word of 3 inputs"):
        tour(machine, longest=3)


# the monitor


@of_vendors
@of_settings
def test_the_monitor_finds_nothing_wrong_with_the_right_machine(build: Build, readings: dict[str, str]) -> None:
    setting, machine = build(), machine_of(build, readings)
    monitor, subject = Monitor(load_life_cycle(), Ics(readings)), Subject(machine)
    for word in (*hsi(machine, 0), *tour(machine)):
        verdicts = monitor.judge(*simulate(setting, subject, RIGHT, word))
        assert not verdicts.findings, [machine.inputs[i] for i in word]


@of_vendors
@of_settings
def test_the_monitor_finds_the_faults_that_the_suite_finds(build: Build, readings: dict[str, str]) -> None:
    setting, subject = build(), Subject(machine_of(build, readings))
    monitor = Monitor(load_life_cycle(), Ics(readings))
    tried = Tried(subject, hsi(subject.machine, 0))
    judged = 0
    faults = single_faults(subject)
    for fault in random.Random(1).sample(faults, min(200, len(faults))):
        word = tried.kills(fault)
        assert word is not None
        if can_happen(setting, subject, fault, word):
            judged += 1
            assert monitor.judge(*simulate(setting, subject, fault, word)).findings, (fault, word)
    assert judged > 100


# the scenarios


def test_scenarios_are_well_formed_and_each_input_is_given() -> None:
    for purpose in (*systematic_purposes({}), *systematic_purposes(READINGS)):
        asked: set[type[s.Step]] = set()
        for name, scenario in purpose.scenarios:
            parts = {n: Part("", d.provides, d.requires, {}, d.connectable) for n, d in scenario.components.items()}
            assert problems(Script(name, parts, scenario.steps)) == [], name
            asked |= set(map(type, scenario.steps))
        assert {s.AddComponent, s.RemoveComponent, s.GetPortElement, s.Start, s.Stop, s.Destroy} <= asked


def test_more_extra_states_make_more_scenarios() -> None:
    plain, more = ({p.id: len(p.scenarios) for p in systematic_purposes({}, extra)} for extra in (0, 1))
    assert all(more[name] > 4 * plain[name] for name in plain)
    assert more.keys() - plain.keys() == {"systematic/relays-3"}
    for counts in (plain, more):
        assert f"{sum(counts.values()):,} scenarios" in PAGE.read_text()


def failing(adapter: type[Adapter], readings: dict[str, str]) -> set[str]:
    """The requirements that the systematic suites find violated."""
    engine, disguise = Engine(adapter), Disguise(1, "{port}_{element}")
    monitor = Monitor(load_life_cycle(), Ics(readings))
    found: set[str] = set()
    for purpose in systematic_purposes(readings):
        for name, plain in purpose.scenarios:
            scenario = disguise.scenario(plain)
            answer = from_host_decoder().decode(engine.answer(encode(Run(0, scenario))))
            assert isinstance(answer, Traced)
            assert contradiction(scenario, answer.events, answer.stuck) is None, name
            found |= {finding.requirement for finding in monitor.judge(scenario, answer.events).findings}
    return found


@pytest.mark.parametrize(
    ("name", "readings"),
    [
        ("", dict(READINGS, **{"remove-while-connected": "cascade"})),
        ("cascades", {"remove-while-ready": "cascade", "remove-provider-in-use": "cascade"}),
        ("adds_later", {"late-add": "deferred"}),
        ("starts_late_additions", {"late-add": "start-immediately"}),
        ("starts_the_unconfigured", {"start-unconfigured": "tolerate"}),
        ("refuses_repetition", {"double-start": "error", "stop-when-stopped": "error"}),
        ("manager_reaches_down", {"manager-start": "cascade"}),
        ("everything_goes", {}),
    ],
)
def test_conformant_frameworks_are_spared_under_all_declarations(name: str, readings: dict[str, str]) -> None:
    adapter = VARIANTS[name].adapter if name else ReferenceAdapter
    assert failing(adapter, readings) == set()


def test_wrong_frameworks_are_found_out() -> None:
    mutant = MUTANTS["tells_providers_too"]
    assert failing(mutant.adapter, {}) == {*mutant.requirements, *mutant.also}


def test_a_run_takes_more_words_for_more_states(tmp_path: Path) -> None:
    counts = []
    for extra in ("0", "1"):
        outcome = ucm_cts(
            "run", ADAPTER, "--in-process", "-k", "systematic/one", "--systematic", extra, "--out", tmp_path
        )
        assert not outcome.err
        report = report_of(tmp_path)
        assert not any(r["verdict"] == "fail" for r in report["requirements"])
        counts.append(report["scenarios"])
    assert counts == [len(systematic_purposes({}, extra)[0].scenarios) for extra in (0, 1)]


# the comparison


def test_a_broken_promise_is_noticed() -> None:
    comparison = compare(one(), READINGS, 1, seed=1, most=300)
    assert keeps_its_guarantee(comparison)
    short = Comparison(
        comparison.setting, comparison.machine, 0.0, {**comparison.faults, "output": 10_000}, comparison.rows
    )
    assert not keeps_its_guarantee(short)
    assert [row.suite for row in comparison.rows][-1] == "hypothesis, same budget"
    assert comparison.rows[-1].inputs == comparison.rows[-2].inputs == comparison.rows[0].inputs


def test_the_published_tables_are_those_of_the_comparison() -> None:
    """But for times, and for what hypothesis does, which depends on its version."""
    reported = [_without_times(line) for line in TABLES.read_text().splitlines()]
    for name, extra in (("two", 0),):
        assert (name, extra) in CASES
        lines = [_without_times(line) for line in table_of(compare(setting(name), READINGS, extra, seed=1, most=3_000))]
        assert len(lines) > 8
        for line in lines:
            assert "hypothesis" in line or line in reported, line


def _without_times(line: str) -> str:
    return re.sub(r"\d+\.\d+", "", line)
