"""Typed component bodies (13.9): the C++ reference framework hosts what the reference tool chain generates."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

import msgspec
import pytest
from cpp_builds import FRAMEWORK, FRAMEWORK_SOURCES, NATIVE, STRICT, Builds, concurrent_scenarios, run, talk
from files import ROOT
from typed_files import COMMAND, GENERATED, PARTS, generated

from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.reference.cpp import TYPED_COMMAND, TYPED_STATEMENT
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Answer, Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.probes import PROBE_MODEL, load_probe_types
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.statement.files import read_statement
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.native

BODIES = "UCM_CTS_LWUCM_BODIES"
README = FRAMEWORK / "README.md"


# what is generated


def test_generated_files_are_those_of_the_probe_models() -> None:
    files = generated()
    assert {*GENERATED.iterdir()} == {path for path in files if path.parent == GENERATED}
    for path, text in files.items():
        assert path.read_bytes() == text.encode(), f"{path.relative_to(ROOT)} is out of date; run '{COMMAND}'"


def test_each_probe_of_the_models_has_a_typed_body() -> None:
    parts = re.findall(r'<AtomicComponentImplementation name="(\w+)_body"', PARTS.read_text())
    types = list(load_probe_types())
    assert re.findall(r"class Abstract_(\w+)_body \{", (GENERATED / "probes.hpp").read_text()) == [*parts, *types]
    assert re.findall(r"::probes::Abstract_(\w+)_body>", (GENERATED.parent / "probes.hpp").read_text()) == types
    assert re.findall(r"::parts::Abstract_(\w+)_body>", (GENERATED.parent / "parts.hpp").read_text()) == parts


@pytest.mark.parametrize("wrong", ["", "UCM_CTS_NOTHING"])
def test_the_task_refuses_wrong_models(wrong: str) -> None:
    files, reported = reference().generate("lwucm", f"<Model>{wrong}<X/></Model>".encode(), "x.xml")
    assert not files
    assert reported


# what the framework makes of it


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """With lwucm's object file, and what is generated from the models of the programs."""
    if shutil.which("c++") is None:
        pytest.skip("needs a C++ compiler")
    folder = tmp_path_factory.mktemp("typed")
    (folder / "framework.cpp").write_text("".join(f'#include "{source}"\n' for source in FRAMEWORK_SOURCES))
    run(["c++", "-std=c++11", "-g1", *_INCLUDED, "-c", folder / "framework.cpp", "-o", folder / "framework.o"])
    for model in ("schools", "libraries"):
        generate(NATIVE / f"{model}.xml", folder)
    return folder


_INCLUDED: list[str | Path] = ["-I", FRAMEWORK / "include", "-I", FRAMEWORK / "src"]


def generate(model: Path, folder: Path) -> None:
    folder.mkdir(exist_ok=True)
    for task in ("cpp11", "lwucm"):
        files, reported = reference().generate(task, model.read_bytes(), model.name)
        assert not reported
        for name, text in files.items():
            (folder / name).write_text(text)


def build(source: Path, folder: Path, program: Path, *headers: Path) -> Path:
    included: list[str | Path] = [option for header in headers for option in ("-I", header)]
    run(["c++", *STRICT, *included, *_INCLUDED, source, folder / "framework.o", "-pthread", "-o", program])
    return program


@pytest.mark.parametrize("name", ["lwucm_typed", "lwucm_typed_calls"])
def test_typed_bodies_are_hosted_as_documented(name: str, folder: Path) -> None:
    program = build(NATIVE / f"{name}.cpp", folder, folder / name, folder)
    done = subprocess.run([program], capture_output=True, text=True, check=False, timeout=60)
    assert (done.stderr, done.returncode) == ("", 0)


_LESSON = "connections.required< ::school_api::Abstract_lesson >"
WRONG = {
    "connections are exchanged": ("schools", f"{_LESSON}(0), {_LESSON}(1)", f"{_LESSON}(1), {_LESSON}(0)"),
    "one getter for two": ("schools", "return body.get_extra_hello();", "return body.get_main_hello();"),
    "a stand-in forgets": ("schools", "{ this->target_->mood(value); }", "{ static_cast<void>(value); }"),
    "one result for two": ("libraries", "::from(results.at(1));", "::from(results.at(0));"),
    "an exception of another name": ("libraries", 'raised.name == "closed"', 'raised.name == "close"'),
    "an enumerator of another name": ("libraries", "kind_t::atlas) { return", "kind_t::novel) { return"),
}
"""What is written wrong in the header of which model: the right text, and the wrong one."""
PROGRAMS = {"schools": "lwucm_typed.cpp", "libraries": "lwucm_typed_calls.cpp"}


@pytest.mark.parametrize("defect", WRONG)
def test_wrong_glue_is_found_out(defect: str, folder: Path, tmp_path: Path) -> None:
    model, right, wrong = WRONG[defect]
    header = f"{model}_lwucm.hpp"
    text = (folder / header).read_text()
    assert right in text
    (tmp_path / header).write_text(text.replace(right, wrong))
    program = build(NATIVE / PROGRAMS[model], folder, tmp_path / "wrong", tmp_path, folder)
    done = subprocess.run([program], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 1
    assert re.search(r"^line \d+: ", done.stderr)


def test_glue_of_every_kind_of_component_compiles(folder: Path, tmp_path: Path) -> None:
    for name in ("bindings", "interfaces", "policies", "ports", "refinement"):
        generate(PROBE_MODEL.parents[1] / "mapping" / f"{name}.xml", tmp_path)
    every = tmp_path / "every.cpp"
    every.write_text("".join(f'#include "{glue.name}"\n' for glue in tmp_path.glob("*_lwucm.hpp")))
    run(["c++", *STRICT, "-fsyntax-only", *_INCLUDED, every])


def test_the_readme_s_application_runs(folder: Path, tmp_path: Path) -> None:
    text = README.read_text()
    for name in ("clocks.xml", "clocks.cpp"):
        (block,) = re.findall(rf"<!-- file: {name} -->\n```\w+\n(.*?)```", text, re.DOTALL)
        (tmp_path / name).write_text(block)
    commands = re.findall(r"(?m)^    ucm-cts-toolchain (\w+) clocks\.xml --out generated$", text)
    assert commands == ["cpp11", "lwucm"]
    generate(tmp_path / "clocks.xml", tmp_path / "generated")
    run([build(tmp_path / "clocks.cpp", folder, tmp_path / "clocks")])


# what the suite finds


@pytest.fixture
def typed(builds: Builds) -> str:
    return str(builds.prefix / "adapters" / "bin" / TYPED_COMMAND.name)


def answers(host: str, scenarios: Iterable[tuple[str, s.Scenario]]) -> Iterator[Answer]:
    with Driver(locate(host), seed=7) as driver:
        for answer in driver.run(list(scenarios)):
            assert answer.incident is None, (answer.name, answer.incident)
            yield answer


def scenarios(profile: str) -> dict[str, s.Scenario]:
    return {name: case for purpose in load_purposes(profile) for name, case in purpose.scenarios}


def reported(answer: Answer) -> list[object]:
    """The trace without times."""
    return [{**msgspec.to_builtins(event), "t": 0} for event in answer.trace]


def test_profile_container_needs_no_generic_body(typed: str, builds: Builds, monkeypatch: pytest.MonkeyPatch) -> None:
    """Typed bodies leave the traces of generic ones, wherever no threads run beside each other."""
    every = scenarios("container")
    monitor = Monitor(load_life_cycle(), Ics(read_statement(TYPED_STATEMENT).readings))
    monkeypatch.setenv(BODIES, "typed")
    compared = {}
    for answer in answers(typed, every.items()):
        assert monitor.judge(answer.disguised, answer.trace).findings == [], answer.name
        if not any(step.thread for step in answer.scenario.steps):
            compared[answer.name] = reported(answer)
    assert len(compared) > len(every) * 0.9
    monkeypatch.setenv(BODIES, "generic")
    for answer in answers(typed, every.items()):
        if answer.name in compared:
            assert reported(answer) == compared[answer.name], answer.name


def test_parts_of_profile_extensions_have_typed_bodies(typed: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Requests, shared data, timers and what 10.5 paces, in virtual time: nearly all scenarios have nothing but typed bodies."""
    monitor = Monitor(load_life_cycle(), read_statement(TYPED_STATEMENT).ics)
    monkeypatch.setenv(BODIES, "typed")
    parts = [
        purpose
        for purpose in load_purposes("extensions")
        if purpose.clause in ("10.3.1", "10.3.2", "10.4.1", "10.4.2", "10.5")
    ]
    every = [
        (f"{purpose.clause} {name}", case)
        for purpose in parts
        for name, case in purpose.scenarios
        if not name.startswith("calls from")  # these have all that components can call at once: no model has that
    ]
    typed_ones = Counter[str]()
    with Driver(locate(typed, virtual_time=True), seed=7) as driver:
        for answer in driver.run(every):
            if answer.incident is None:
                assert monitor.judge(answer.disguised, answer.trace).findings == [], answer.name
                typed_ones[answer.name.split()[0]] += 1
            else:  # another type of data, several ports, policies that a component may not have
                assert "no component type of the models" in answer.incident.detail, answer.name
    for clause, share in {"10.3.1": 0.8, "10.3.2": 0.8, "10.4.1": 0.5, "10.4.2": 0.75, "10.5": 0.9}.items():
        assert typed_ones[clause] > share * sum(name.startswith(f"{clause} ") for name, _ in every), clause


def test_components_outside_models_have_generic_bodies(typed: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monitor = Monitor(load_life_cycle(), Ics(read_statement(TYPED_STATEMENT).readings))
    every = {name: case for name, case in scenarios("core").items() if any(c.ports for c in case.components.values())}
    meeting = dict(list(every.items())[::16])
    for answer in answers(typed, [(n, msgspec.structs.replace(c, patience=500)) for n, c in meeting.items()]):
        assert monitor.judge(answer.disguised, answer.trace).findings == [], answer.name
    monkeypatch.setenv(BODIES, "typed")
    (name, first), *_ = meeting.items()
    with Driver(locate(typed), seed=7) as driver:
        (answer,) = driver.run([(name, first)])
    assert answer.incident is not None
    assert "no component type of the models" in answer.incident.detail


@pytest.mark.parametrize("sanitizer", ["asan", "tsan"])
def test_sanitizers_have_nothing_to_say_of_typed_bodies(builds: Builds, sanitizer: str) -> None:
    runs = [m.Run(n, scenario, stream=n % 2 == 0) for n in range(10) for scenario in concurrent_scenarios()]
    (welcome, *others), err, status = talk(builds.program(sanitizer), m.Hello(m.PROTOCOL), *runs)
    assert (err, status) == ("", 0)
    assert isinstance(welcome, m.Welcome)
    assert welcome.product.endswith("typed bodies")
    traces = [other for other in others if isinstance(other, m.Traced)]
    assert len(traces) == len(runs)
    assert all(trace.stuck == () for trace in traces)
