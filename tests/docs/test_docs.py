"""README and docs are correct: links have targets, and commands and examples run as printed."""

from __future__ import annotations

import importlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import textwrap
import tomllib
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any, get_args

import click
import jsonschema
import msgspec
import pytest
from command_line import report_of, ucm_cts
from distributed import LocalCluster
from files import ROOT, guide_files

import ucm_cts as package
from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.metamodel.writing import Dialect
from ucm_cts.adapters.mutants.toolchain.registry import mutants as wrong_tool_chains
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.campaigns.plan import SelfTest, Settings
from ucm_cts.harness.catalogue.profiles import TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_requirements
from ucm_cts.harness.cli.commands import cli
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.probes import load_probe_types
from ucm_cts.harness.purposes.scripts import read_scripts, to_scenario
from ucm_cts.harness.report.published import by_product, read_published
from ucm_cts.harness.results.values import Isolation, Verdict
from ucm_cts.harness.selftest.kill_record import read_record
from ucm_cts.harness.toolchains.commands.description import Command, ToolChain
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.usefixtures("here")

FRAMEWORK = ROOT / "adapters" / "reference" / "cpp" / "framework"
PAGES = [*sorted(ROOT.glob("*.md")), FRAMEWORK / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
ROOMS = {"suite", "reference_models", "harness", "adapters", "docs", "src", "tests"}
PACKAGE = Path(package.__file__).parent
TOOLCHAIN = "ucm-cts-toolchain-0.1.0"
SCHEMA = ROOT / "adapters" / "contract" / "protocol.schema.json"
TOX = (ROOT / "tox.ini").read_text()
each_page = pytest.mark.parametrize("page", PAGES, ids=[str(page.relative_to(ROOT)) for page in PAGES])


def text_of(name: str) -> str:
    return (ROOT / name).read_text()


def column(page: str, pattern: str) -> list[Any]:
    """What ``pattern`` finds at the beginnings of table rows."""
    return re.findall(rf"(?m)^\| {pattern} \|", text_of(page))


def marked(page: str, marker: str) -> str:
    """The one code block that stands below ``<!-- marker -->``."""
    (block,) = re.findall(rf"(?ms)^<!-- {re.escape(marker)} -->\n```\w+\n(.*?)^```$", text_of(page))
    return str(block)


def write_files(page: str) -> None:
    """Every file that the page shows or takes for an example, under its name, into this folder."""
    for name, text in guide_files(ROOT / page).items():
        Path(name).write_text(text)


def prose(page: Path) -> str:
    return re.sub(r"(?ms)^```.*?^```$", "", page.read_text())


def spans(page: Path) -> list[str]:
    """What stands between backquotes; lines may break there."""
    return [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", prose(page))]


def commands(program: str) -> list[str]:
    """Every command line of ``program`` that any page shows."""
    found = []
    for page in PAGES:
        found += re.findall(rf"(?m)^\s*({re.escape(program)}.*)$", page.read_text())
        found += [span for span in spans(page) if span.startswith(program)]
    return found


def shell(command: str, **environment: str) -> str:
    """Run ``command`` in this folder as somebody would who has the environment activated; what it printed."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", command],
        env={**os.environ, "PATH": path, **environment}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    return done.stdout


@each_page
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)]+)\)", prose(page)):
        path, _, anchor = target.partition("#")
        there = page.parent / path if path else page
        assert "://" in path or there.is_file() or any(there.glob("*")), target
        headings = re.findall(r"(?m)^#+ (.+)$", prose(there)) if anchor else ()
        assert not anchor or anchor in {re.sub(r"[^\w -]", "", h.lower()).replace(" ", "-") for h in headings}, target


@pytest.mark.parametrize("page", sorted((ROOT / "docs").glob("*.md")), ids=lambda page: page.name)
def test_page_begins_with_five_lines_of_summary(page: Path) -> None:
    title, empty, *lines = page.read_text().splitlines()
    assert title.startswith("# ")
    assert not empty
    assert lines.index("") == 5


@each_page
def test_excerpts_are_from_their_files(page: Path) -> None:
    for name, excerpt in re.findall(r"(?ms)^<!-- from: (\S+) -->\n```\w+\n(.*?)^```$", page.read_text()):
        assert excerpt in text_of(name)


@each_page
def test_named_things_exist(page: Path) -> None:
    for span in spans(page):
        if re.fullmatch(r"[\w.*-]+(/[\w.*-]*)+", span) and span.split("/")[0] in ROOMS:
            assert any(ROOT.glob(span.rstrip("/"))) or any(page.parent.glob(span)), span
    assert set(re.findall(r"R-\d[\d.]*-\d+", page.read_text())) <= {r.id for r in load_requirements()}
    for name in re.findall(r"\btox -e (\w+)", page.read_text()):
        assert f"[testenv:{name}]" in TOX, name


def test_every_module_has_a_purpose() -> None:
    lines = shell(f"{shlex.quote(sys.executable)} {ROOT}/docs/modules.py").splitlines()
    assert [line for line in lines if len(line.split()) < 3 or not line.endswith(".")] == []
    assert any(line.startswith("harness/results/tally.py ") for line in lines)


def test_former_module_of_the_python_host_still_serves() -> None:
    command = (
        "echo x | python -m ucm_cts.adapters.python.host ucm_cts.adapters.mutants.python:serialises_calls 2> warning"
    )
    assert json.loads(shell(command))["type"] == "refused"
    assert Path("warning").read_text().endswith("is deprecated: use ucm_cts.adapters.sdk.python.host\n")


def test_tables_name_existing_things() -> None:
    for folder, _, holds in column("docs/design.md", r"`(\w+/)` \| (.+) \| (.+)"):
        for span in re.findall(r"`([^`]+)`", holds):
            assert any((ROOT / folder).glob(span.rstrip("/"))), f"{folder}{span}"
    values = column("docs/design.md", r"(`\w[^|]*`) \| `(\w+/[^|]*)\.py`")
    assert len(values) > 5
    for names, path in values:
        module = importlib.import_module(f"ucm_cts.{path.replace('/', '.')}")
        assert [name for name in re.findall(r"\w+", names) if not hasattr(module, name)] == []
    assert set(column("docs/verdicts.md", "`(.+?)`")) == {*get_args(Verdict), *get_args(Isolation)}
    (short,) = column("docs/commands.md", r"(.+), \.\.\. \| takes a bundled adapter.*")
    assert set(re.findall(r"`(.+?)`", short)) <= entry_points(group="ucm_cts.adapters").names


@pytest.mark.parametrize("command", commands("ucm-cts "))
def test_command_is_one(command: str) -> None:
    name, *arguments = shlex.split(command)[1:]
    assert name in cli.commands
    if arguments:
        cli.commands[name].make_context(name, arguments)


def test_pytest_command_is_the_one_that_test_pytest_plugin_runs() -> None:
    assert commands("pytest --pyargs") == ["pytest --pyargs ucm_cts.suite --iut ADAPTER"]


def test_commands_page_is_that_of_the_commands() -> None:
    printed = shell(f"{shlex.quote(sys.executable)} {ROOT}/docs/commands.py")
    assert printed.startswith("## Commands\n")
    assert text_of("docs/commands.md").partition("## Commands\n")[2] == printed.removeprefix("## Commands\n")
    assert {o for command in cli.commands.values() for p in command.params for o in options_of(p)} == {
        span.split()[0] for span in column("docs/commands.md", "`(-.+?)`")
    }


def options_of(parameter: click.Parameter) -> list[str]:
    return parameter.opts if isinstance(parameter, click.Option) else []


@pytest.mark.parametrize("name", ["", *cli.commands])
def test_help_is_complete(name: str) -> None:
    command = cli.commands[name] if name else cli
    context = click.Context(command)
    assert not name or not command.get_short_help_str(62).endswith("..."), "the list of commands would cut it off"
    for option in (p for p in command.params if isinstance(p, click.Option)):
        assert option.help, option.opts
    assert "harness" not in command.get_help(context).lower(), "a word of those who develop UCM-CTS"


@pytest.mark.native
def test_certify_command_leaves_the_files_of_the_readme(here: Path) -> None:
    (command,) = re.findall(r"(?ms)^\[testenv:certify\]$[^\[]*?^commands = (.+?)$", TOX)
    assert marked("README.md", "certify command").rstrip().endswith(" && pipx run tox -e certify")
    for hole, value in {"{tox_root}": str(here), "{/}": "/", "{posargs}": ""}.items():
        command = command.replace(hole, value)
    outcome = ucm_cts(*shlex.split(command)[1:])
    assert (outcome.status, outcome.err) == (0, "")
    (folder,) = re.findall(r"`(reports/[^`]+)/`", text_of("README.md"))
    for name in re.findall(r"`(report\.\w+|junit\.xml)`", text_of("README.md")):
        assert (here / folder / name).is_file()
    assert report_of(here / folder)["suite_version"] == package.__version__


def test_ci_runs_the_test_command_of_the_readme(here: Path) -> None:
    calls, stubs = here / "calls", here / "stubs"
    stubs.mkdir()
    for name in ("apt-get", "pipx"):
        (stubs / name).write_text(f'#!/bin/sh\necho {name} "$@" >> {calls}\n')
        (stubs / name).chmod(0o755)
    shutil.copytree(ROOT / ".ci", here / "clone" / ".ci")
    shutil.copy(ROOT / "README.md", here / "clone")
    printed = shell("clone/.ci/run", PATH=f"{stubs}:/usr/bin:/bin")
    command = marked("README.md", "test command")
    assert printed == f"+ {command}"
    assert calls.read_text().splitlines() == command.strip().split(" && ")


def test_protocol_is_that_of_the_types() -> None:
    assert shell("python -m ucm_cts.adapters.contract.messages") == SCHEMA.read_text()
    there = {(way, tag) for way, types in (("to", m.ToHost), ("from", m.FromHost)) for tag in tags(types)}
    assert set(column("docs/protocol.md", r"(to|from) host \| `(\w+)`")) == there


def tags(types: Any) -> set[str]:
    return {t.__struct_config__.tag for t in get_args(types) or types}


def answer(message: m.ToHost) -> Any:
    """What a host says, without the times."""
    line = Engine(ReferenceAdapter).answer(m.encode(message))
    return m.from_host_decoder().decode(re.sub(rb'"t":\d+', b'"t":0', line))


def test_conversation_is_one_that_takes_place() -> None:
    lines = marked("docs/protocol.md", "conversation").splitlines()
    for line in lines:
        jsonschema.validate(json.loads(line), json.loads(SCHEMA.read_text()))
    hello, run = (m.to_host_decoder().decode(line) for line in lines[::2])
    assert isinstance(run, m.Run)
    traced: Any
    welcome, traced = (m.from_host_decoder().decode(line) for line in lines[1::2])
    assert contradiction(run.scenario, traced.events) is None
    verdicts = Monitor(load_life_cycle()).judge(run.scenario, traced.events)
    assert verdicts.exercises
    assert not verdicts.findings
    assert hello == m.Hello(m.PROTOCOL)
    assert welcome == msgspec.structs.replace(answer(hello), product="example", version="1.0")
    assert [msgspec.structs.replace(event, t=0) for event in traced.events] == list(answer(run).events)


def test_example_scenario(here: Path) -> None:
    write_files("docs/scenarios.md")
    (command,) = [c for c in commands("ucm-cts replay") if "example.yaml" in c]
    outcome = ucm_cts(*command.split()[1:])
    assert (outcome.status, outcome.err) == (0, "")
    assert "\nno findings" in outcome.out
    (script,) = read_scripts(here / "example.yaml")
    scenario = to_scenario(script)
    trace = answer(m.Run(1, scenario)).events
    assert set(script.exercises) <= set(Monitor(load_life_cycle()).judge(scenario, trace).exercises)


@pytest.mark.parametrize(
    ("page", "clause", "example"),
    [
        ("request-response", "10.4.1", "requests.yaml"),
        ("shared-data", "10.4.2", "shared.yaml"),
        ("execution-policies", "10.5", "paced.yaml"),
    ],
)
def test_guide_to_a_part_of_extensions(here: Path, page: str, clause: str, example: str) -> None:
    write_files(f"docs/{page}.md")
    (replayed,) = [c for c in commands("ucm-cts replay") if example in c]
    outcome = ucm_cts(*replayed.split()[1:])
    assert (outcome.status, outcome.err) == (0, "")
    assert "\nno findings" in outcome.out
    (script,) = read_scripts(here / example)
    with Driver(locate("reference-py", in_process=True), 1) as driver:
        (answered,) = driver.run([("an example", to_scenario(script))])
    judged = Monitor(load_life_cycle()).judge(answered.disguised, answered.trace)
    assert set(script.exercises) <= set(judged.exercises)
    (ran,) = [c for c in commands("ucm-cts run") if f"--profile extensions -k {clause}" in c]
    # in virtual time, as other tests keep the processors busy
    assert ucm_cts(*ran.split()[1:], "--explore", "0s", "--virtual-time").status == 0
    assert report_of(here / "ucm-cts-report")["profile"] == "extensions"


def test_words_of_scenarios() -> None:
    page = " ".join(text_of("docs/scenarios.md").split())
    (probes,) = re.findall(r"probes\.xml` \((.+?)\)", page)
    (hooks,) = re.findall(r"entered at a hook \((.+?)\)", page)
    assert set(probes.split(", ")) == set(load_probe_types())
    assert set(re.findall(r"\w+", hooks)) == set(get_args(s.Hook))
    assert set(re.findall(r"`{do: (\w+)", page)) == tags(s.Action)
    others = set(re.findall(r"`(\w+)`", page.partition("**steps**")[2].partition("`bind`")[0]))
    assert others == tags([step for step in get_args(s.Step) if not issubclass(step, s.ContainerCall)])


def test_campaign_of_the_page(here: Path) -> None:
    write_files("docs/campaigns.md")
    dry, ran = dict.fromkeys(c for c in commands("ucm-cts campaign plan.toml") if "tcp" not in c)
    outcome = ucm_cts(*dry.split()[1:])
    assert (outcome.status, outcome.err) == (0, "")
    with LocalCluster(
        n_workers=1, processes=False, protocol="tcp", host="127.0.0.1", resources={"core": 1}, dashboard_address=None
    ) as cluster:
        outcome = ucm_cts(*ran.split()[1:], "--scheduler", cluster.scheduler_address)
    assert (outcome.status, outcome.err) == (0, "")
    for place in column("docs/campaigns.md", r"`([^`]+/)`"):
        assert any(here.glob(f"ucm-cts-campaign/{re.sub('NAME|PROFILE|N/', '*', place)}")), place
    keys = set(column("docs/campaigns.md", r"(`[a-z].*?)"))
    named = {key for cell in keys for key in re.findall(r"`([a-z-]+)`", cell)}
    known = {field.encode_name for kind in (Settings, SelfTest) for field in msgspec.structs.fields(kind)}
    assert known - {"adapter", "profiles", "seeds", "names", "quick", "whole", "real-time", "sandbox"} <= named


def test_known_failures(here: Path) -> None:
    write_files("docs/known-failures.md")
    options = "-k 11.2.2.1-13 --known-failures known.yaml --out out"
    ucm_cts("run", "subjects:stops_in_startup_order", *options.split())
    (reason,) = re.findall(r"(?m)^  reason: (.+)$", Path("known.yaml").read_text())
    failing = [r for r in report_of(here / "out")["requirements"] if r["verdict"] == "fail"]
    assert {f["waived"] for r in failing for f in r["findings"]} == {reason}


def test_statement(here: Path) -> None:
    write_files("docs/statement.md")
    (writes, runs) = (c.replace("ADAPTER", "reference-py") for c in commands("ucm-cts") if "my-ics.toml" in c)
    outcome = ucm_cts(*shlex.split(runs)[1:], "-k", "R-11.2.3-11", "--out", "out")
    assert (outcome.err, report_of(here / "out")["statement"]["source"]) == ("", "my-ics.toml")
    assert "fail" not in {r["verdict"] for r in report_of(here / "out")["requirements"]}
    assert ucm_cts(*shlex.split(writes)[1:]).status == 2, "it is there already"
    assert ucm_cts(*shlex.split(writes)[1:], "--force", "--full").status == 0
    keys = {key for row in column("docs/statement.md", r"(`.+?`) \| .+ \| .+") for key in re.findall(r"[\w]+", row)}
    assert keys == tomllib.loads((here / "my-ics.toml").read_text()).keys()


def test_toolchain_guide(here: Path) -> None:
    write_files("docs/toolchains.md")
    (command,) = [c for c in commands("ucm-cts run") if "--out pim-report" in c]
    outcome = ucm_cts(*shlex.split(command)[1:], "-k", "R-9.2.4.3-02")
    assert (outcome.err, report_of(here / "pim-report")["product"]) == ("", "My tool chain")
    (result,) = [r for r in report_of(here / "pim-report")["requirements"] if r["id"] == "R-9.2.4.3-02"]
    assert result["verdict"] == "pass"
    (written,) = [c for c in commands("ucm-cts ics") if "my-toolchain.toml" in c]
    assert ucm_cts(*shlex.split(written)[1:]).status == 0
    assert 'product = "My tool chain"' in (here / "ucm-cts-ics.toml").read_text()
    rows = column("docs/toolchains.md", r"(`.+?`.*?) \| .+ \| .+")
    described = {key for row in rows for key in re.findall(r"`\[?([a-z0-9_]+)", row)} - {"pim"}
    fields = {f.name for kind in (ToolChain, Command, Dialect) for f in msgspec.structs.fields(kind)}
    assert described == fields - {"folder", "source", "tags", "attributes", "literals"}


def test_standard_properties_guide(here: Path) -> None:
    write_files("docs/standard-properties.md")
    runs = [command for command in commands("ucm-cts run") if "documenting-ics.toml" in command]
    asked: dict[str, list[str]] = {}
    for command in runs:
        outcome = ucm_cts(*shlex.split(command)[1:])
        assert (outcome.status, outcome.err) == (0, "")
        report = report_of(here / "ucm-cts-report")
        asked[report["profile"]] = [r["id"] for r in report["requirements"] if r["verdict"] == "pass"]
    assert asked == {"pim": ["R-10.2-10", "R-10.2-11", "R-10.2-12"], "idl": ["R-10.2-13"]}


@pytest.mark.slow
def test_python_guide(here: Path) -> None:
    write_files("docs/adapter-python.md")
    assert "ucm-cts run my_adapter:BeansAdapter" in commands("ucm-cts run")
    outcome = ucm_cts("run", "my_adapter:BeansAdapter", "--out", "out")
    assert (outcome.status, outcome.err) == (1, "")
    assert "✗ NOT CONFORMANT  Beans 1.0" in outcome.out
    blameless(report_of(here / "out"))


def blameless(report: dict[str, Any]) -> set[str]:
    """The failing requirements, none of them the adapter's fault."""
    assert report["verdict"] == "not conformant"
    assert not report["incidents"]
    assert "error" not in {r["verdict"] for r in report["requirements"]}
    return {r["id"] for r in report["requirements"] if r["verdict"] == "fail"}


@pytest.mark.native
@pytest.mark.slow
def test_virtual_time_of_executables(here: Path) -> None:
    """Each requirement that the C++ reference framework keeps in real time it keeps in virtual time, and each arises there."""
    (said,) = {c for c in commands("ucm-cts run") if "reference-cpp" in c and "--virtual-time" in c}
    ran = ucm_cts(*said.split()[1:], "--explore", "0s", "--out", "out")
    assert ran.status == 0, ran.out
    report = report_of(here / "out")
    assert {one["verdict"] for one in report["requirements"]} <= {"pass", "not applicable", "not testable"}
    assert "virtual time" in report["warnings"][0]


def test_python_guide_other_ways(here: Path) -> None:
    write_files("docs/adapter-python.md")
    write_files("docs/scenarios.md")
    (debugged,) = [c for c in commands("ucm-cts replay") if "my_adapter" in c]
    assert "no findings" in shell(debugged.replace("FILE", "example.yaml"))
    (virtual,) = {c for c in commands("ucm-cts run") if "my_adapter" in c and "--virtual-time" in c}
    assert "no findings" in ucm_cts("replay", "example.yaml", "my_adapter:BeansAdapter", "--virtual-time").out
    alike = ("--seed", "1", "--explore", "0s")
    ucm_cts(*virtual.split()[1:], *alike, "--out", "virtual")
    report = report_of(here / "virtual")
    assert "virtual time" in report["warnings"][0]
    ucm_cts("run", "my_adapter:BeansAdapter", *alike, "--out", "real")
    assert blameless(report) == blameless(report_of(here / "real"))
    (served,) = commands("python -m ucm_cts.adapters.sdk.python.host")
    command = [sys.executable, *served.replace(":4000", ":0").split()[1:]]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout
        address = server.stdout.readline().removeprefix("listening on ").strip()
        try:
            assert "no findings" in ucm_cts("replay", "example.yaml", address).out
        finally:
            server.terminate()
    (toml,) = re.findall(r"(?ms)^```toml\n(.*?)^```$", text_of("docs/adapter-python.md"))
    ((group, names),) = tomllib.loads(toml)["project"]["entry-points"].items()
    info = here / "beans-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: beans\nVersion: 1\n")
    (info / "entry_points.txt").write_text(f"[{group}]\n" + "".join(f"{k} = {v}\n" for k, v in names.items()))
    assert "ucm-cts run beans" in commands("ucm-cts run")
    assert "connected-pair on Beans 1.0" in shell("python -m ucm_cts replay example.yaml beans")


@pytest.fixture
def vendor(here: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the C++ guide's files and the headers of the frameworks that it takes for given."""
    if not all(map(shutil.which, ("g++", "ar", "cmake"))) or not (PACKAGE / "include").exists():
        pytest.skip("needs cmake, g++ and the installed package")
    write_files("docs/adapter-cpp.md")
    (here / "acme").mkdir()
    (here / "acme" / "ucm.hpp").write_text("#include <lwucm/runtime.hpp>\nnamespace acme = lwucm;\n")
    (here / "acmeConfig.cmake").write_text("add_library(acme::ucm INTERFACE IMPORTED)\n")
    monkeypatch.setenv("acme_DIR", str(here))
    headers = (here, FRAMEWORK / "include", ROOT / "adapters" / "sdk" / "cpp" / "example")
    monkeypatch.setenv("CPLUS_INCLUDE_PATH", ":".join(map(str, headers)))
    monkeypatch.setenv("LIBRARY_PATH", str(here))
    return here


def test_cpp_guide_with_cmake(vendor: Path) -> None:
    """The project is configured as the guide says; what comes of it when built is for test_cpp_guide.py."""
    (configure,) = commands("cmake -S")
    targets = "cmake --build build --target help"
    shell(configure)
    assert {"acme_adapter", "acme_adapter_host"} <= set(shell(targets).split())
    lists = marked("docs/adapter-cpp.md", "file: CMakeLists.txt").replace("target_link_libraries(acme_adapter ", "# ")
    (vendor / "CMakeLists.txt").write_text(lists.replace("adapter(acme_adapter", "adapter(acme_adapter NO_PYTHON"))
    shell(configure)
    assert {"acme_adapter", "acme_adapter_host"} & set(shell(targets).split()) == {"acme_adapter_host"}


def test_cpp_guide_with_a_plain_compiler(vendor: Path) -> None:
    """Both adapters, one compiler call beside the other."""
    acme, _sanitized = commands("g++ -std")
    beans = acme.replace("acme_adapter.cpp -lacme", "beans_adapter.cpp -o beans")
    sources = f"""printf '#include "%s"\\n' {FRAMEWORK}/src/*/*.cpp > acme.cpp"""  # at once, in a tenth of the time
    framework = f"{sources}; g++ -std=c++11 -I {FRAMEWORK}/src -c acme.cpp; ar rc libacme.a acme.o"
    shell(f"{beans} & {framework}; {acme}; mkdir build; mv a.out build/acme_adapter; wait $!")
    assert "ucm-cts run build/acme_adapter" in commands("ucm-cts run")
    outcome = ucm_cts("run", "build/acme_adapter")
    assert (outcome.status, outcome.err) == (0, "")
    assert "✓ CONFORMANT  Acme UCM 4.2" in outcome.out
    assert ucm_cts("run", "./beans", "--out", "out").status == 1
    lacking = {"R-11.2.1.2-05", "R-11.2.1.3-02", "R-11.2.1.4-02", "R-11.2.2.2-02", "R-12.10-26", "R-11.2.2.2-05"}
    assert lacking <= blameless(report_of(vendor / "out"))


@pytest.mark.native
def test_cpp_guide_step_by_step() -> None:
    (code,) = re.findall(r"(?m)^ +import acme_adapter\n(?: +.*\n)+", text_of("docs/adapter-cpp.md"))
    alias = "import sys, ucm_cts.adapters._reference_cpp as module; sys.modules['acme_adapter'] = module\n"
    check = "\nassert runtime.get_components() == [clock, display]; assert acme_adapter.life_cycles(10) > 0"
    subprocess.run([sys.executable, "-c", alias + textwrap.dedent(code) + check], check=True)


@pytest.mark.slow
def test_example_of_profile_core_serves(here: Path) -> None:
    write_files("docs/adapter-python.md")
    write_files("docs/profile-core.md")
    shell(f"{marked('docs/profile-core.md', 'wired beans').strip()} || test $? -eq 1")
    entries = json.loads(Path("ucm-cts-report/report.json").read_text())["requirements"]
    verdicts = {entry["id"]: entry["verdict"] for entry in entries}
    assert {verdicts[f"R-10.1.5.1-{number}"] for number in ("01", "03", "05", "08")} == {"pass"}
    assert [one for one, verdict in verdicts.items() if verdict == "fail"] == ["R-10.1-01"]


def test_fragment_connectors_of_profile_core(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_files("docs/profile-core.md")
    monkeypatch.syspath_prepend(here)
    adapter = importlib.import_module("acme_links").AcmeAdapter
    assert adapter.end_fragments.keys() < {s.SERVICE_CONNECTOR, s.MESSAGE_CONNECTOR}
    assert adapter.__abstractmethods__ == {"create_runtime"}


_DEFECTS = {
    "#include <string>\n": "#include <string>\n#include <thread>\n",
    "        running_ = true;\n": """
        std::thread other([this] { ++last_line_; });
        ++last_line_;
        other.join();
        int* const gone = new int(1);
        delete gone;
        running_ = *gone != 2;
""",
}
"""A race and a use of freed memory whenever Beans start."""


@pytest.mark.native
def test_sanitizers_of_the_cpp_guide_tell_what_is_wrong(here: Path) -> None:
    write_files("docs/adapter-cpp.md")
    beans = Path("beans.hpp").read_text()
    for good, bad in _DEFECTS.items():
        assert good in beans
        beans = beans.replace(good, bad, 1)
    Path("beans.hpp").write_text(beans)
    recipe = marked("docs/adapter-cpp.md", "sanitizers")
    recipe = re.sub(r"(?m)^include=.*$", f"include={shlex.quote(str(ROOT / 'adapters/sdk/cpp/include'))}", recipe)
    shell(re.sub(r"(?m)^(    ucm-cts .*)$", r"\1 -k R-11.2.2.1-13 || test $? -eq 1", recipe))
    for kind, text in (
        ("address,undefined", "AddressSanitizer: heap-use-after-free"),
        ("thread", "ThreadSanitizer: data race"),
    ):
        incidents = report_of(here / f"report-{kind}")["incidents"]
        assert any(text in json.dumps(incident) for incident in incidents), kind


def test_published_self_tests_are_proved_as_detection_says() -> None:
    frameworks, toolchains = (
        read_record(ROOT / f"results/detection/{of}.jsonl") for of in ("frameworks", "toolchains")
    )
    assert frameworks.is_proved
    assert toolchains.is_proved
    assert {mutant.name for mutant in toolchains.mutants} <= wrong_tool_chains().keys()
    assert len([cheat for cheat in frameworks.cheats if not cheat.requirements]) == 8, "that no observation can show"


@pytest.mark.parametrize("profile", TOOLCHAIN_PROFILES)
def test_the_reference_tool_chain_is_published_as_conformant(profile: str) -> None:
    (result,) = (r for r in by_product(read_published(ROOT / "results"))[TOOLCHAIN] if r.profile == profile)
    assert result.verdict == "conformant"
    assert result.requirements
    assert {entry.verdict for entry in result.requirements} <= {"pass", "not applicable"}
