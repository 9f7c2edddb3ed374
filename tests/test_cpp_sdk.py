"""The C++ SDK, the C++ reference framework and the guide to C++ adapters: what is built is what is tested."""

from __future__ import annotations

import copy
import json
import os
import platform
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import msgspec
import pytest

import ucm_cts
from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.reference_cpp import COMMAND

ROOT = Path(__file__).parent.parent
SDK = ROOT / "adapters" / "cpp"
FRAMEWORK = ROOT / "adapters" / "reference_cpp" / "framework"
GUIDE = ROOT / "docs" / "adapter-cpp.md"
PACKAGE = Path(ucm_cts.__file__).parent

STRICT = ["-std=c++11", "-pedantic-errors", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]
REFERENCE = [ROOT / "adapters" / "reference_cpp" / "adapter.cpp", *sorted((FRAMEWORK / "src").glob("*.cpp"))]

RUDE = """
#include <ucm_cts/main.hpp>
#include <cstdio>

// does something bad, which the name of the component to add chooses
class Rude : public ucm_cts::Adapter {
    typedef ucm_cts::ContainerHandle Handle;

  public:
    Handle create_runtime(const std::vector<ucm_cts::Implementation>& all) override {
        if (!all.empty() && all[0].name == "refuse") throw std::runtime_error("no licence");
        return std::make_shared<int>(0);
    }
    ucm_cts::Id add_component(const Handle&, const std::string& what, const ucm_cts::Attributes&) override {
        if (what == "print") { std::printf("{\\"type\\":\\"welcome\\"}\\n"); std::fflush(stdout); }
        if (what == "crash") crash_here();
        if (what == "abort") std::abort();
        if (what == "hang") for (;;) pause();
        if (what == "throw int") throw 42;
        if (what == "throw long") throw std::length_error(std::string(300, 'x') + "\\xff");
        if (what == "throw text") throw ucm_cts::NotFound("\\"quoted\\" \\xc3\\xa4 \\xff");
        return 2147483647;
    }
    void remove_component(const Handle&, ucm_cts::Id id) override { throw ucm_cts::BadParameter(std::to_string(id)); }
    ucm_cts::Reference get_port_element(const Handle&, ucm_cts::Id, const std::string&) override { return nullptr; }
    ucm_cts::Id connect(const Handle&, ucm_cts::Id, const std::string&, const ucm_cts::Reference&) override { return 0; }
    void disconnect(const Handle&, ucm_cts::Id) override {}
    void start(const Handle&) override {}
    void stop(const Handle&) override {}
    std::vector<ucm_cts::Id> get_components(const Handle&) override { return {2147483646}; }
    Handle create_container(const Handle&) override { return nullptr; }
    void remove_container(const Handle&, const Handle&) override {}
    void destroy(const Handle&) override { throw ucm_cts::UcmError("never"); }

    __attribute__((noinline)) static void crash_here() { *static_cast<volatile int*>(nullptr) = 1; }
};

UCM_CTS_ADAPTER(Rude, "rude", "0");
"""


def guide_file(name: str) -> str:
    """The code block of the guide that is marked as file ``name``."""
    found = re.search(rf"<!-- file: {re.escape(name)} -->\n```\w+\n(.*?)```", GUIDE.read_text(), re.DOTALL)
    assert found, f"{GUIDE.name} has no file {name}"
    return found[1]


def run(command: Sequence[str | Path], **options: Any) -> subprocess.CompletedProcess[str]:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, f"{command}\n{done.stdout[-4000:]}\n{done.stderr[-8000:]}"
    return done


class Builds:
    """Everything this file needs built, each in the background from the moment the tests begin."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._pool = ThreadPoolExecutor(os.cpu_count() or 2)
        self._prefix = self._pool.submit(self._install)
        sources = [("rude", RUDE), ("beans", guide_file("beans_adapter.cpp"))]
        for name, text in sources:
            (folder / f"{name}.cpp").write_text(text)
        asan = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g1"]
        self._programs: dict[str, Future[Path]] = {
            "rude": self._compile("rude", [folder / "rude.cpp"], STRICT),
            "tsan": self._compile("tsan", REFERENCE, ["-std=c++11", "-fsanitize=thread", "-g1"]),
            "asan": self._compile("asan", REFERENCE, ["-std=c++11", *asan]),
            "spellings": self._compile("spellings", [SDK / "example" / "other_spellings.cpp"], STRICT),
            "beans": self._compile("beans", [folder / "beans.cpp"], [*STRICT, "-I", str(SDK / "example")]),
        }
        self._vendor = self._pool.submit(self._build_like_a_vendor)

    def program(self, name: str) -> Path:
        return self._programs[name].result()

    @property
    def prefix(self) -> Path:
        """Where the package is installed: site-packages, or a folder made for a plain checkout."""
        return self._prefix.result()

    @property
    def reference(self) -> Path:
        return self.prefix / "adapters" / "bin" / COMMAND.name

    @property
    def vendor(self) -> Path:
        """Where the guide's CMake project was built."""
        return self._vendor.result()

    def _compile(self, name: str, sources: Sequence[Path], flags: Sequence[str]) -> Future[Path]:
        includes: list[str | Path] = ["-I", SDK / "include", "-I", FRAMEWORK / "include"]
        command: list[str | Path] = [
            os.environ.get("CXX", "c++"),
            *flags,
            *includes,
            *sources,
            "-o",
            self.folder / name,
        ]
        return self._pool.submit(lambda: (run([*command, "-pthread", "-rdynamic"]), self.folder / name)[1])

    def _install(self) -> Path:
        if COMMAND.exists() and (PACKAGE / "share" / "cmake" / "ucm_cts").exists():
            return PACKAGE
        build, prefix = self.folder / "package", self.folder / "installed" / "ucm_cts"
        run(["cmake", "-S", ROOT, "-B", build, f"-DCMAKE_INSTALL_PREFIX={prefix}", *self._cmake_options()])
        run(["cmake", "--build", build, "-j2"])
        run(["cmake", "--install", build])
        return prefix

    def _build_like_a_vendor(self) -> Path:
        folder = self.folder / "vendor"
        folder.mkdir()
        for name in ("CMakeLists.txt", "acme_adapter.cpp"):
            (folder / name).write_text(guide_file(name))
        acme = folder / "acme"
        acme.mkdir()
        (acme / "ucm.hpp").write_text("#include <lwucm/runtime.hpp>\nnamespace acme = lwucm;\n")
        sources = "\n".join(f'"{source}"' for source in REFERENCE[1:])
        (folder / "acmeConfig.cmake").write_text(
            f"""add_library(acme_ucm STATIC {sources})
            target_include_directories(acme_ucm PUBLIC "{folder}" "{FRAMEWORK / "include"}")
            set_target_properties(acme_ucm PROPERTIES POSITION_INDEPENDENT_CODE ON)
            add_library(acme::ucm ALIAS acme_ucm)"""
        )
        build = folder / "build"
        package = self.prefix / "share" / "cmake" / "ucm_cts"
        run(
            [
                "cmake",
                "-S",
                folder,
                "-B",
                build,
                f"-Ducm_cts_DIR={package}",
                f"-Dacme_DIR={folder}",
                *self._cmake_options(),
            ]
        )
        run(["cmake", "--build", build, "-j2"])
        return build

    @staticmethod
    def _cmake_options() -> list[str]:
        import pybind11

        return [
            "-DCMAKE_BUILD_TYPE=Debug",
            f"-Dpybind11_DIR={pybind11.get_cmake_dir()}",
            f"-DPython_EXECUTABLE={sys.executable}",
        ]


@pytest.fixture(scope="session")
def builds(tmp_path_factory: pytest.TempPathFactory) -> Builds:
    if shutil.which("cmake") is None or shutil.which(os.environ.get("CXX", "c++")) is None:
        pytest.skip("needs cmake and a C++ compiler")
    return Builds(tmp_path_factory.mktemp("cpp"))


def wire(*lines: bytes | m.ToHost) -> bytes:
    return b"".join(line if isinstance(line, bytes) else m.encode(line) + b"\n" for line in lines)


class Host:
    """A stand-alone adapter in a process of its own."""

    def __init__(self, program: Path) -> None:
        self.process = subprocess.Popen(
            [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0
        )

    def send(self, *lines: bytes | m.ToHost) -> None:
        assert self.process.stdin
        self.process.stdin.write(
            b"".join(line if isinstance(line, bytes) else m.encode(line) + b"\n" for line in lines)
        )

    def end(self, *lines: bytes | m.ToHost) -> tuple[list[m.FromHost], str, int]:
        """Send these last messages and close its input; its answers, standard error and exit status."""
        try:
            out, err = self.process.communicate(wire(*lines), timeout=30)
        finally:
            self.process.kill()
        decoder = m.from_host_decoder()
        return (
            [decoder.decode(line) for line in out.splitlines()],
            err.decode(errors="replace"),
            self.process.returncode,
        )


def talk(program: Path, *lines: bytes | m.ToHost) -> tuple[list[m.FromHost], str, int]:
    return Host(program).end(*lines)


def events(program: Path, scenario: s.Scenario) -> tuple[t.Event, ...]:
    (answer,), _, status = talk(program, m.Run(1, scenario))
    assert status == 0
    assert isinstance(answer, m.Traced), answer
    return answer.events


def story(program: Path, scenario: s.Scenario) -> list[str]:
    """The trace in short: callbacks as ``on_init A``, ends of steps as ``start: UCM_ERROR`` or ``start: None``."""
    told = []
    for event in events(program, scenario):
        if isinstance(event, t.Enter):
            told.append(f"{event.hook} {event.component}{'' if event.instance == 1 else event.instance}")
        elif isinstance(event, t.Return):
            told.append(f"{s.operation(scenario.steps[event.step])}: ok")
        elif isinstance(event, t.Raise):
            told.append(f"{s.operation(scenario.steps[event.step])}: {event.error}")
    return told


PROVIDER = s.Declaration(provides=("p_e",))
CLIENT = s.Declaration(requires=("r_e",), connectable=True)
PAIR = {"P": PROVIDER, "C": CLIENT}
CONNECTED = (
    s.AddComponent("P"),
    s.AddComponent("C"),
    s.GetPortElement("P", "p_e", "ref"),
    s.Connect("C", "r_e", "ref", "k"),
)
LIFE = (
    *CONNECTED,
    s.Start(),
    s.Invoke("ref", 7),
    s.Stop(),
    s.Disconnect("k"),
    s.RemoveComponent("C"),
    s.RemoveComponent("P"),
)


# the wire


def test_welcome_and_trace(builds: Builds) -> None:
    (welcome, traced), _, status = talk(builds.reference, m.Hello(m.PROTOCOL), m.Run(9, s.Scenario(PAIR, LIFE)))
    assert isinstance(welcome, m.Welcome)
    assert welcome.protocol == m.PROTOCOL
    assert isinstance(traced, m.Traced)
    assert (traced.id, traced.stuck, status) == (9, (), 0)
    assert [e.n for e in traced.events] == list(range(1, len(traced.events) + 1))
    assert [e.t for e in traced.events] == sorted(e.t for e in traced.events)
    results = [e.value for e in traced.events if isinstance(e, t.Return)]
    assert t.Reference("P", 1, "p_e") in results
    assert ~7 in results


def mutations(value: Any) -> Iterator[Any]:
    """``value`` with one thing changed, in every place."""
    wrong: list[Any] = [None, True, 3, 1.5, "other", [], {}, [None]]
    yield from (w for w in wrong if type(w) is not type(value))
    if isinstance(value, dict):
        yield {**value, "surprise": 1}
        for name, member in value.items():
            yield {k: v for k, v in value.items() if k != name}
            yield {("other" if k == name else k): v for k, v in value.items()}
            yield from ({**value, name: changed} for changed in mutations(member))
    if isinstance(value, list):
        for n, element in enumerate(value):
            yield from ([*value[:n], changed, *value[n + 1 :]] for changed in mutations(element))


def test_host_and_harness_agree_on_what_is_a_message(builds: Builds) -> None:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {
        "exchange": (s.ReturnValue(1), s.CallPort("r_e", 2), s.HoldAtGate("g"), s.QuerySiblings(), s.RaiseError())
    }
    declared = s.Declaration(("p_e",), ("r_e",), {"a": "b"}, True, True, plan)
    steps = (
        s.AddComponent("A", bind="x"),
        s.RemoveComponent("nobody"),
        s.GetPortElement("nobody", "p_e", "ref"),
        s.Connect("nobody", "r_e", "nil", "k"),
        s.Disconnect("nobody"),
        s.Start(container="nowhere"),
        s.CreateContainer("sub"),
        s.RemoveContainer("sub"),
        s.Invoke("nil", 5),
        s.OpenGate("g"),
        s.Join("w", thread="v"),
        s.Destroy(),
    )
    message = json.loads(m.encode(m.Run(1, s.Scenario({"A": declared}, steps, patience=50), stream=False)))
    message["scenario"]["patience"] = 50
    lines = [json.dumps(changed).encode() for changed in mutations(copy.deepcopy(message))]
    lines += [
        b"x",
        b"{}",
        b"[]",
        b'{"type":"hello","protocol":1}x',
        b'{"type":"hello","protocol":"1"}',
        b'{"type":"run"',
    ]
    lines += [b'\xff{"type":"hello","protocol":1}', b'{"type":"hello","protocol":2}', b"[" * 100_000]
    lines = [line for line in lines if b'"stream": true' not in line]
    assert len(lines) > 500
    answers, _, status = talk(builds.reference, b"".join(line + b"\n" for line in lines), m.Hello(m.PROTOCOL))
    assert status == 0
    assert len(answers) == len(lines) + 1
    decoder = m.to_host_decoder()
    for line, answer in zip(lines, answers, strict=False):
        try:
            meant = decoder.decode(line)
        except (msgspec.MsgspecError, RecursionError):
            assert isinstance(answer, m.Refused), line
        else:
            wrong_version = isinstance(meant, m.Hello) and meant.protocol != m.PROTOCOL
            assert isinstance(answer, m.Refused) == wrong_version, (line, answer)
    assert isinstance(answers[-1], m.Welcome)


def test_refusals_name_the_place(builds: Builds) -> None:
    steps = b'{"type":"run","id":3,"scenario":{"components":{},"steps":[{"op":"start"},{"op":"start","x":1}]}}\n'
    plan = b'{"type":"run","id":4,"scenario":{"components":{"A":{"plan":{"on_init":[{"do":"dance"}]}}},"steps":[]}}\n'
    (first, second, third), _, _ = talk(builds.reference, steps, plan, b'{"type":"hello","protocol":7}\n')
    assert first == m.Refused("Object contains unknown field `x` - at `$.scenario.steps[1]`", 3)
    assert second == m.Refused("Invalid value 'dance' - at `$.scenario.components.A.plan.on_init[0].do`", 4)
    assert isinstance(third, m.Refused)
    assert re.search(r"7.*1", third.reason)


def test_streamed_events_come_first_and_are_those_of_the_trace(builds: Builds) -> None:
    threads = tuple(s.AddComponent("P", bind=f"p{n}", thread=f"t{n % 3}") for n in range(30))
    answers, _, _ = talk(builds.reference, m.Run(5, s.Scenario(PAIR, threads), stream=True))
    *streamed, traced = answers
    assert isinstance(traced, m.Traced)
    assert [a.event for a in streamed if isinstance(a, m.Happened)] == list(traced.events)
    assert len(streamed) == len(traced.events) > 100


def connect(address: str) -> socket.socket:
    if address.startswith("unix:"):
        connection = socket.socket(socket.AF_UNIX)
        connection.connect(address.removeprefix("unix:"))
        return connection
    host, _, port = address.removeprefix("tcp://").rpartition(":")
    return socket.create_connection((host, int(port)))


@pytest.mark.parametrize("kind", ["tcp", "unix"])
def test_listening(builds: Builds, kind: str, tmp_path: Path) -> None:
    where = "tcp://127.0.0.1:0" if kind == "tcp" else f"unix:{tmp_path}/socket"
    server = subprocess.Popen(
        [builds.program("rude"), "--listen", where], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    )
    assert server.stdout
    try:
        address = server.stdout.readline().decode().removeprefix("listening on ").strip()
        with connect(address) as stays, connect(address) as dies:
            dies.sendall(m.encode(m.Run(1, s.Scenario({}, (s.AddComponent("abort"),)))) + b"\n")
            assert dies.recv(100) == b"", "a crash ends the connection"
            stays.sendall(m.encode(m.Hello(m.PROTOCOL)) + b"\n")
            welcome = m.from_host_decoder().decode(stays.makefile("rb").readline())
            assert isinstance(welcome, m.Welcome)
            assert welcome.product == "rude"
    finally:
        server.terminate()
        server.wait()


# frameworks that misbehave


def test_what_leaves_an_operation(builds: Builds) -> None:
    steps: tuple[s.Step, ...] = (
        *(s.AddComponent(f"throw {what}") for what in ("int", "long", "text")),
        s.AddComponent("fine"),
        s.GetComponents(),
        s.RemoveComponent("unknown"),
        s.GetPortElement("fine", "p", "ref"),
        s.Invoke("ref", 1),
        s.CreateContainer("sub"),
        s.Destroy(),
    )
    raised = {e.step: e for e in events(builds.program("rude"), s.Scenario({}, steps)) if isinstance(e, t.Raise)}
    assert [raised[n].error for n in (0, 1, 2, 5, 9)] == [
        "UNDECLARED",
        "UNDECLARED",
        "NOT_FOUND",
        "BAD_PARAMETER",
        "UCM_ERROR",
    ]
    assert raised[1].detail.startswith("std::length_error: xxx")
    assert len(raised[1].detail) == 200
    assert raised[2].detail == '"quoted" ä \ufffd'
    assert raised[5].detail == "2147483645", "unknown is an id that the framework has not given out"
    assert 7 not in raised


def test_setting_up_fails(builds: Builds) -> None:
    scenario = s.Scenario({"refuse": s.Declaration()}, ())
    (refused, welcome), _, _ = talk(builds.program("rude"), m.Run(8, scenario), m.Hello(m.PROTOCOL))
    assert isinstance(refused, m.Refused)
    assert refused.id == 8
    assert "no licence" in refused.reason
    assert isinstance(welcome, m.Welcome)


def test_printing_does_not_reach_the_protocol(builds: Builds) -> None:
    (traced,), err, _ = talk(builds.program("rude"), m.Run(1, s.Scenario({}, (s.AddComponent("print"),))))
    assert isinstance(traced, m.Traced)
    assert '{"type":"welcome"}' in err


@pytest.mark.parametrize(("what", "number"), [("crash", signal.SIGSEGV), ("abort", signal.SIGABRT)])
def test_crash_is_seen_with_its_signal_and_place(builds: Builds, what: str, number: int) -> None:
    answers, err, status = talk(builds.program("rude"), m.Run(1, s.Scenario({}, (s.AddComponent(what),)), stream=True))
    assert status == -number
    assert [type(a) for a in answers] == [m.Happened]
    assert f"{signal.Signals(number).name}, thread: main" in err
    if what == "crash" and platform.libc_ver()[0] == "glibc":
        assert "crash_here" in err


def test_stuck_threads_are_named_and_end_the_host(builds: Builds) -> None:
    scenario = s.Scenario(
        {}, (s.AddComponent("hang", thread="w"), s.Join("w"), s.AddComponent("fine", thread="v")), 100
    )
    answers, _, status = talk(builds.program("rude"), m.Run(1, scenario), m.Hello(m.PROTOCOL))
    assert len(answers) == 1, "after stuck threads the host ends itself"
    assert isinstance(answers[0], m.Traced)
    assert answers[0].stuck == ("w",)
    assert [e.step for e in answers[0].events if isinstance(e, t.Timeout)] == [1]
    assert status == 0


def test_backtraces_on_request(builds: Builds) -> None:
    hold = s.Declaration(plan={"on_init": (s.HoldAtGate("g"),)})
    scenario = s.Scenario({"H": hold}, (s.AddComponent("H", thread="w"), s.ReachGate("g"), s.Join("w")), 1000)
    host = Host(builds.reference)
    host.send(m.Run(1, scenario, stream=True))
    assert host.process.stdout
    while b'"held"' not in host.process.stdout.readline():
        pass
    time.sleep(0.05)
    host.process.send_signal(signal.SIGUSR1)
    answers, err, status = host.end()
    assert "thread: main" in err
    assert "thread: worker w" in err
    assert "add_component" in err.partition("worker w")[2], "the worker's frames are named"
    assert isinstance(answers[-1], m.Traced)
    assert (answers[-1].stuck, status) == ((), 0), "and the scenario went on"


# threads and gates


def concurrent_scenarios() -> list[s.Scenario]:
    held: dict[s.Hook, tuple[s.Action, ...]] = {
        "on_startup": (s.HoldAtGate("startup"), s.CallPort("r_e", 3), s.QuerySiblings()),
        "exchange": (s.HoldAtGate("exchange"),),
    }
    fragment = s.Declaration(("p_e",), ("r_e",), {"a": "1"}, connectable=True, fragment=True, plan=held)
    gates = s.Scenario(
        {"F": fragment},
        (
            s.AddComponent("F"),
            s.GetPortElement("F", "p_e", "ref"),
            s.Connect("F", "r_e", "ref", "k"),
            s.Start(thread="w"),
            s.ReachGate("startup"),
            s.GetComponents(),
            s.Stop(thread="z"),
            s.Invoke("ref", 1, thread="x"),
            s.ReachGate("exchange"),
            s.Invoke("ref", 2, thread="y"),
            s.OpenGate("exchange"),
            s.OpenGate("startup"),
            *(s.Join(w) for w in "wxyz"),
        ),
    )
    adds = tuple(s.AddComponent("P", bind=f"p{n}", thread=f"t{n % 4}") for n in range(40))
    joins = tuple(s.Join(f"t{n}") for n in range(4))
    crowd = s.Scenario(
        {"P": PROVIDER, "bad": s.Declaration(plan={"on_init": (s.RaiseError(),)})},
        (
            *adds,
            s.GetComponents(),
            *joins,
            s.AddComponent("bad"),
            s.Start(thread="a"),
            s.Stop(thread="b"),
            s.GetComponents(),
        ),
    )
    left = s.Scenario(PAIR, (*CONNECTED, s.Start(), s.CreateContainer("sub"), s.AddComponent("P", container="sub")))
    return [gates, crowd, left, s.Scenario(PAIR, (*LIFE, s.Destroy()))]


def test_gates_order_what_threads_do(builds: Builds) -> None:
    trace = events(builds.reference, concurrent_scenarios()[0])
    kinds = [(type(e).__name__, getattr(e, "gate", getattr(e, "step", None)), e.thread) for e in trace]
    held = kinds.index(("Held", "startup", 1))
    asked = kinds.index(("Return", 5, 0))
    opened = kinds.index(("Opened", "startup", 0))
    started = kinds.index(("Return", 3, 1))
    assert held < asked < opened < started, "get_components is answered while start is under way"
    assert [e.ids for e in trace if isinstance(e, t.Siblings)] == [(1,)]
    assert not [e for e in trace if isinstance(e, t.Timeout)]


@pytest.mark.parametrize("sanitizer", ["asan", "tsan"])
def test_sanitizers_have_nothing_to_say(builds: Builds, sanitizer: str) -> None:
    runs = [m.Run(n, scenario, stream=n % 2 == 0) for n in range(10) for scenario in concurrent_scenarios()]
    answers, err, status = talk(builds.program(sanitizer), *runs, b"junk\n")
    assert (err, status) == ("", 0)
    traces = [a for a in answers if isinstance(a, m.Traced)]
    assert len(traces) == len(runs)
    assert all(trace.stuck == () for trace in traces)


# the reference framework

RAISES: Callable[[s.Hook], s.Declaration] = lambda hook: s.Declaration(("p_e",), plan={hook: (s.RaiseError(),)})

READINGS: dict[str, tuple[dict[str, s.Declaration], tuple[s.Step, ...], str]] = {
    "a failed on_startup shuts down those already started": (
        {**PAIR, "B": RAISES("on_startup")},
        (*CONNECTED, s.AddComponent("B"), s.Start(), s.Stop(), s.AddComponent("P", bind="again")),
        "on_startup P, on_startup C, on_startup B, on_shutdown C, on_shutdown P, start: UCM_ERROR, stop: ok, "
        "on_init P2, add_component: ok",
    ),
    "a failed on_shutdown does not spare the others": (
        {**PAIR, "B": RAISES("on_shutdown")},
        (s.AddComponent("P"), s.AddComponent("B"), s.Start(), s.Stop(), s.Stop()),
        "on_startup P, on_startup B, start: ok, on_shutdown B, on_shutdown P, stop: UCM_ERROR, stop: ok",
    ),
    "a failed on_init leaves nothing": (
        {"B": RAISES("on_init")},
        (s.AddComponent("B"), s.Start(), s.GetComponents()),
        "on_init B, add_component: UCM_ERROR, start: ok, get_components: ok",
    ),
    "a failed on_remove removes": (
        {"B": RAISES("on_remove")},
        (s.AddComponent("B"), s.RemoveComponent("B"), s.RemoveComponent("B")),
        "on_remove B, remove_component: UCM_ERROR, remove_component: NOT_FOUND",
    ),
    "starting needs all connections": (
        PAIR,
        (s.AddComponent("P"), s.AddComponent("C"), s.Start(), s.Stop()),
        "start: UCM_ERROR, stop: ok",
    ),
    "nothing is configured after start": (
        PAIR,
        (*CONNECTED, s.Start(), s.Start(), s.AddComponent("P", bind="q"), s.Disconnect("k"), s.RemoveComponent("C")),
        "on_startup P, on_startup C, start: ok, start: ok, add_component: UCM_ERROR, disconnect: UCM_ERROR, "
        "remove_component: UCM_ERROR",
    ),
    "a provider in use stays, a client takes its connections along": (
        PAIR,
        (*CONNECTED, s.RemoveComponent("P"), s.RemoveComponent("C"), s.Disconnect("k"), s.RemoveComponent("P")),
        "remove_component: UCM_ERROR, on_disconnect C, on_remove C, remove_component: ok, disconnect: NOT_FOUND, "
        "on_remove P, remove_component: ok",
    ),
    "wrong arguments of connect": (
        PAIR,
        (
            *CONNECTED,
            s.Connect("C", "r_e", "ref", "x"),
            s.Connect("C", "r_e", "nil", "x"),
            s.Connect("C", "q", "ref", "x"),
            s.Connect("P", "p_e", "ref", "x"),
            s.Connect("unknown", "r_e", "ref", "x"),
            s.GetPortElement("C", "r_e", "x"),
        ),
        "connect: UCM_ERROR, connect: BAD_PARAMETER, connect: BAD_PARAMETER, connect: BAD_PARAMETER, connect: NOT_FOUND, "
        "get_port_element: NOT_FOUND",
    ),
    "removing a container undoes what leads into it": (
        PAIR,
        (
            s.CreateContainer("sub"),
            s.AddComponent("P", container="sub"),
            s.AddComponent("P", container="sub", bind="P2"),
            s.GetPortElement("P", "p_e", "ref", container="sub"),
            s.AddComponent("C"),
            s.Connect("C", "r_e", "ref", "k"),
            s.Start(container="sub"),
            s.RemoveContainer("sub"),
            s.RemoveContainer("sub"),
            s.Disconnect("k"),
            s.Start(),
        ),
        "on_startup P, on_startup P2, start: ok, on_shutdown P2, on_shutdown P, on_disconnect C, on_remove P2, "
        "on_remove P, remove_container: ok, remove_container: NOT_FOUND, disconnect: NOT_FOUND, start: UCM_ERROR",
    ),
    "destroy ends everything": (
        PAIR,
        (
            *CONNECTED,
            s.CreateContainer("sub"),
            s.AddComponent("P", container="sub", bind="q"),
            s.Start(),
            s.Start(container="sub"),
            s.Destroy(),
            s.GetComponents(),
            s.Start(container="sub"),
            s.Destroy(),
        ),
        "on_startup P, on_startup C, start: ok, on_startup P2, start: ok, on_shutdown P2, on_shutdown C, on_shutdown P, "
        "on_disconnect C, on_remove P2, on_remove C, on_remove P, destroy: ok, get_components: UCM_ERROR, "
        "start: UCM_ERROR, destroy: UCM_ERROR",
    ),
    "not everything that is asked for exists": (
        PAIR,
        (
            s.AddComponent("nobody"),
            s.RemoveContainer("nil"),
            s.RemoveContainer("manager"),
            s.RemoveComponent("unknown"),
        ),
        "add_component: UCM_ERROR, remove_container: NOT_FOUND, remove_container: NOT_FOUND, remove_component: NOT_FOUND",
    ),
}


@pytest.mark.parametrize("reading", READINGS)
def test_readings_of_the_reference_framework(builds: Builds, reading: str) -> None:
    components, steps, expected = READINGS[reading]
    told = ", ".join(story(builds.reference, s.Scenario(components, steps)))
    assert told.endswith(expected), told


# the guide


def without_times(answers: Sequence[m.FromHost]) -> list[Any]:
    return [re.sub(rb'"t":\d+', b"", m.encode(answer)) for answer in answers]


def test_guide_for_a_framework_in_the_shape_of_12_10(builds: Builds) -> None:
    runs = [m.Run(n, scenario) for n, scenario in enumerate((s.Scenario(PAIR, LIFE), concurrent_scenarios()[3]))]
    expected, _, _ = talk(builds.reference, *runs)
    answers, _, status = talk(builds.vendor / "acme_adapter", *runs)
    assert status == 0
    assert without_times(answers) == without_times(expected)


def test_other_spellings_of_12_10(builds: Builds) -> None:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {"on_startup": (s.CallPort("r_e", 4), s.QuerySiblings())}
    fragment = s.Declaration(requires=("r_e",), attributes={"a": "1"}, connectable=True, fragment=True, plan=plan)
    scenario = s.Scenario({"P": PROVIDER, "C": fragment}, (*LIFE, s.AddComponent("nobody"), s.RemoveContainer("nil")))
    trace = events(builds.program("spellings"), scenario)
    returned = {e.step: e.value for e in trace if isinstance(e, t.Return)}
    ids = (returned[0], returned[1])
    assert ids == (2**40 + 1, 2**40 + 2), "ids come through as they are: that they are too wide is the judge's matter"
    assert [e.ids for e in trace if isinstance(e, t.Siblings)] == [ids]
    assert [e.value for e in trace if isinstance(e, t.Reply)] == [~4]
    assert [e.attributes for e in trace if isinstance(e, t.Enter) and e.hook == "on_init"] == [{}, {"a": "1"}]
    assert [e.reference for e in trace if isinstance(e, t.Enter) and e.hook == "on_connect"] == [
        t.Reference("P", 1, "p_e")
    ]
    assert [e.error for e in trace if isinstance(e, t.Raise)] == ["UCM_ERROR", "NOT_FOUND"]


def test_guide_module(builds: Builds) -> None:
    lines = [m.encode(m.Hello(m.PROTOCOL)), m.encode(m.Run(1, s.Scenario(PAIR, LIFE), stream=True))]
    script = f"""
import acme_adapter
events = []
for line in {lines!r}:
    print(acme_adapter.answer(line, events.append).decode())
runtime = acme_adapter.Runtime([("Clock", ["time_api"], []), ("Display", [], ["time_api"])])
clock, display = runtime.add_component("Clock"), runtime.add_component("Display")
reference = runtime.get_port_element(clock, "time_api")
connection = runtime.connect(display, "time_api", reference)
runtime.start()
assert runtime.exchange(reference, 5) == -6
assert runtime.get_components() == [clock, display]
runtime.stop()
for wrong, error in ((lambda: runtime.remove_component(99), acme_adapter.NotFound),
                     (lambda: runtime.connect(display, "time_api", None), acme_adapter.BadParameter),
                     (lambda: runtime.add_component("Nobody"), acme_adapter.UcmError)):
    try:
        wrong()
    except error:
        continue
    raise AssertionError(error)
runtime.disconnect(connection)
runtime.destroy()
assert acme_adapter.life_cycles(100) > 0
print(len(events))
"""
    done = run([sys.executable, "-c", script], cwd=builds.vendor)
    welcome, traced, streamed = done.stdout.splitlines()
    assert isinstance(m.from_host_decoder().decode(welcome), m.Welcome)
    decoded = m.from_host_decoder().decode(traced)
    assert isinstance(decoded, m.Traced)
    assert len(decoded.events) == int(streamed)


def test_guide_for_any_other_framework(builds: Builds) -> None:
    components = {"P": PROVIDER, "C": s.Declaration(requires=("r_e",), plan={"on_startup": (s.CallPort("r_e", 4),)})}
    trace = events(builds.program("beans"), s.Scenario(components, (*LIFE, s.GetComponents())))
    assert [e.value for e in trace if isinstance(e, t.Reply)] == [~4]
    assert [e.dependencies for e in trace if isinstance(e, t.Enter) and e.component == "C" and e.dependencies] == [
        (t.Dependency("r_e", ("opaque",)),)
    ]
    assert [e.error for e in trace if isinstance(e, t.Raise)] == ["UCM_ERROR"], "only get_components is missing"
