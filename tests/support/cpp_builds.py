"""The C++ builds of the tests, and exchanges of messages with them."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from files import ROOT, SUPPORT, guide_files, once, shared_folder

import ucm_cts
from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.reference.cpp import COMMAND

SDK = ROOT / "adapters" / "sdk" / "cpp"
BEANS = SDK / "example"
FRAMEWORK = ROOT / "adapters" / "reference" / "cpp" / "framework"
NATIVE = SUPPORT / "native"
GUIDE = ROOT / "docs" / "adapter-cpp.md"
PACKAGE = Path(ucm_cts.__file__).parent

STRICT = ["-std=c++11", "-pedantic-errors", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]
ADAPTER = ROOT / "adapters" / "reference" / "cpp" / "adapter.cpp"
TYPED_BODIES = ROOT / "adapters" / "reference" / "cpp" / "typed" / "bodies.cpp"
FRAMEWORK_SOURCES = sorted((FRAMEWORK / "src").rglob("*.cpp"))

RUDE = """
#include <ucm_cts/main.hpp>
#include <cstdio>

// does something bad, which the name of the component to add chooses
class Rude : public ucm_cts::Adapter {
    typedef ucm_cts::ContainerHandle Handle;

  public:
    Handle create_runtime(const std::vector<ucm_cts::Implementation>& all) override {
        all_ = all;
        if (!all.empty() && all[0].name == "refuse") throw std::runtime_error("no licence");
        return std::make_shared<int>(0);
    }
    ucm_cts::Id add_component(const Handle&, const std::string& what, const ucm_cts::Attributes&) override {
        if (what == "print") { std::printf("{\\"type\\":\\"welcome\\"}\\n"); std::fflush(stdout); }
        if (what == "crash") crash_here();
        if (what == "abort") std::abort();
        if (what == "hang") for (;;) pause();
        if (what == "spin") for (volatile bool on = true; on;) {}
        if (what == "throw int") throw 42;
        if (what == "throw long") throw std::length_error(std::string(300, 'x') + "\\xff");
        if (what == "throw text") throw ucm_cts::NotFound("\\"quoted\\" \\xc3\\xa4 \\xff");
        is_flooding_ = what == "many";
        return 2147483647;
    }
    void remove_component(const Handle&, ucm_cts::Id id) override { throw ucm_cts::BadParameter(std::to_string(id)); }
    ucm_cts::Reference get_port_element(const Handle&, ucm_cts::Id, const std::string&) override { return nullptr; }
    ucm_cts::Id connect(const Handle&, ucm_cts::Id, const std::string&, const ucm_cts::Reference&) override { return 0; }
    void disconnect(const Handle&, ucm_cts::Id) override {}
    void start(const Handle&) override {
        for (const auto& one : all_) {
            if (one.name == "timed") {
                serve_timers(one);
                continue;
            }
            for (const auto& policy : one.policies) {
                const auto execution = one.create()->get_policy_element(policy.definition, "self-execution_api");
                if (execution) execution->run();
            }
            if (one.name == "flooded") {
                const auto body = one.create();
                body->set_container_interface(std::make_shared<Flooding>());
                body->on_startup(std::vector<ucm_cts::PortConnection>(10001));
            }
        }
    }
    void stop(const Handle&) override {}
    std::vector<ucm_cts::Id> get_components(const Handle&) override {
        return std::vector<ucm_cts::Id>(is_flooding_ ? 10001 : 1, 2147483646);
    }
    void advance(const Handle&, std::int32_t ms) override { throw ucm_cts::BadParameter(std::to_string(ms)); }
    Handle create_container(const Handle&) override { return nullptr; }
    void remove_container(const Handle&, const Handle&) override {}
    void destroy(const Handle&) override { throw ucm_cts::UcmError("never"); }

    __attribute__((noinline)) static void crash_here() { *static_cast<volatile int*>(nullptr) = 1; }

  private:
    struct Timer : ucm_cts::ObjectTimer {
        std::int64_t rounds() override { return 3; }
        std::string id() override { return "t"; }
        void cancel() override { throw ucm_cts::UcmError("too late"); }
        bool is_cancelled() override { return false; }
    };

    // triggers inside the calls; the second method returns no timer
    struct Scheduler : ucm_cts::TimerScheduler {
        typedef std::shared_ptr<ucm_cts::ObjectTimer> Made;
        typedef std::shared_ptr<ucm_cts::TimerHandler> Handler;
        Made scheduler_trigger(const Handler& handler, const ucm_cts::TimeValue& delay) override {
            handler->on_trigger(std::make_shared<Timer>(), delay, 0);
            return std::make_shared<Timer>();
        }
        Made schedule_repeated_trigger(const Handler& handler, const ucm_cts::TimeValue&,
                                       const ucm_cts::TimeValue& interval, std::int64_t max_rounds) override {
            handler->on_trigger(std::make_shared<Timer>(), interval, max_rounds);
            return nullptr;
        }
    };

    // has a body use object timers, and calls its callback of index timers
    static void serve_timers(const ucm_cts::Implementation& implementation) {
        const auto body = implementation.create();
        std::vector<ucm_cts::PortConnection> given;
        for (const auto& policy : implementation.policies) {
            if (policy.definition == "ott_timer") given.push_back({policy.element, {std::make_shared<Scheduler>()}});
        }
        body->on_startup(given);
        body->get_policy_port("itt_timer", "timer_callback")->call("on_timeout", {{5, "RELATIVE_TIME"}, 7});
    }

    struct Flooding : ucm_cts::ContainerInterface {
        std::vector<ucm_cts::Id> get_components() override { return std::vector<ucm_cts::Id>(10001); }
    };

    std::vector<ucm_cts::Implementation> all_;
    bool is_flooding_ = false;
};

UCM_CTS_ADAPTER(Rude, "rude", "0");
"""


def run(command: Sequence[str | Path], **options: Any) -> subprocess.CompletedProcess[str]:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, f"{command}\n{done.stdout[-4000:]}\n{done.stderr[-8000:]}"
    return done


class Builds:
    """C++ programs of this project and of the guide; each is built when a test first asks for it, once for all workers."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def program(self, name: str) -> Path:
        return once(self.folder / name, lambda: self._compile(name))

    @property
    def prefix(self) -> Path:
        """Where the package is installed: site-packages, or a folder made for a plain checkout."""
        if COMMAND.exists() and (PACKAGE / "share" / "cmake" / "ucm_cts").exists():
            return PACKAGE
        return once(self.folder / "package", self._install) / "installed" / "ucm_cts"

    @property
    def reference(self) -> Path:
        return self.prefix / "adapters" / "bin" / COMMAND.name

    @property
    def vendor(self) -> Path:
        """Where the guide's CMake project was built."""
        return once(self.folder / "vendor", self._build_like_a_vendor) / "build"

    def _compile(self, name: str) -> None:
        def text(content: str) -> Path:
            path = self.folder / f"{name}.cpp"
            path.write_text(content)
            return path

        framework = "".join(f'#include "{source}"\n' for source in FRAMEWORK_SOURCES)
        reference = f'{framework}#include "{ADAPTER}"\n#include "{TYPED_BODIES}"\n'
        tsan = ["-std=c++11", "-fsanitize=thread", "-g1"]
        asan = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g1"]
        source, flags = {
            "rude": lambda: (text(RUDE), STRICT),
            "tsan": lambda: (text(reference), tsan),
            "asan": lambda: (text(reference), ["-std=c++11", *asan]),
            "spellings": lambda: (NATIVE / "other_spellings.cpp", STRICT),
            "accessors": lambda: (NATIVE / "accessor_classes.cpp", STRICT),
            "cells": lambda: (NATIVE / "cells.cpp", [*STRICT, *asan]),
            "patchbay": lambda: (NATIVE / "patchbay.cpp", [*STRICT, *asan]),
            "links": lambda: (text(f'{framework}#include "{NATIVE / "lwucm_links.cpp"}"\n'), tsan),
            "waits": lambda: (NATIVE / "waits.cpp", ["-std=c++11", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]),
            "power": lambda: (NATIVE / "stress_power.cpp", [*STRICT, "-O2"]),
            "beans": lambda: (BEANS / "beans_adapter.cpp", [*STRICT, "-I", str(BEANS)]),
        }[name]()
        includes = ["-I", SDK / "include", "-I", FRAMEWORK / "include", "-I", FRAMEWORK / "src"]
        run(
            [os.environ.get("CXX", "c++"), *flags, *includes, source, "-o", self.folder / name, "-pthread", "-rdynamic"]
        )

    def _install(self) -> None:
        build = self.folder / "package"
        prefix = build / "installed" / "ucm_cts"
        run(["cmake", "-S", ROOT, "-B", build, f"-DCMAKE_INSTALL_PREFIX={prefix}", *self._cmake_options()])
        run(["cmake", "--build", build, "-j2"])
        run(["cmake", "--install", build])

    def _build_like_a_vendor(self) -> None:
        folder = self.folder / "vendor"
        folder.mkdir(exist_ok=True)
        for name in ("CMakeLists.txt", "acme_adapter.cpp"):
            (folder / name).write_text(guide_files(GUIDE)[name])
        acme = folder / "acme"
        acme.mkdir(exist_ok=True)
        (acme / "ucm.hpp").write_text("#include <lwucm/runtime.hpp>\nnamespace acme = lwucm;\n")
        sources = "\n".join(f'"{source}"' for source in FRAMEWORK_SOURCES)
        (folder / "acmeConfig.cmake").write_text(
            f"""add_library(acme_ucm STATIC {sources})
            target_include_directories(acme_ucm PUBLIC "{folder}" "{FRAMEWORK / "include"}" PRIVATE "{FRAMEWORK / "src"}")
            set_target_properties(acme_ucm PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD ON)
            add_library(acme::ucm ALIAS acme_ucm)"""
        )
        build, package = folder / "build", self.prefix / "share" / "cmake" / "ucm_cts"
        places = [f"-Ducm_cts_DIR={package}", f"-Dacme_DIR={folder}"]
        run(["cmake", "-S", folder, "-B", build, *places, *self._cmake_options()])
        run(["cmake", "--build", build, "-j2"])

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
    return Builds(shared_folder(tmp_path_factory) / "cpp")


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
            out, err = self.process.communicate(wire(*lines), timeout=120)
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
    reported = []
    for event in events(program, scenario):
        if isinstance(event, t.Enter):
            reported.append(f"{event.hook} {event.component}{'' if event.instance == 1 else event.instance}")
        elif isinstance(event, t.Return):
            reported.append(f"{s.operation(scenario.steps[event.step])}: ok")
        elif isinstance(event, t.Raise):
            reported.append(f"{s.operation(scenario.steps[event.step])}: {event.error}")
    return reported


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
    settled = s.Scenario(
        {"H": s.Declaration(("p_e",), plan={"on_startup": (s.HoldAtGate("g"),)})},
        (
            s.AddComponent("H", thread="a"),
            s.Settle("a"),
            s.Start(thread="b"),
            s.Settle("b"),
            s.Stop(thread="c"),
            s.Settle("c"),
            s.Settle("d"),
            s.OpenGate("g"),
            s.Settle("b", thread="e"),
            *(s.Join(w) for w in "abce"),
        ),
    )
    executed = {
        policy: s.Declaration(
            ("p_e",),
            ("r_e",),
            connectable=True,
            plan={"run": (s.CallPort("r_e", 1), s.RaiseError()), "on_startup": (s.CallPort("r_e", 2),)},
            policies=(s.Policy(policy, "p_e" if policy == s.ACTIVE else None),),
        )
        for policy in (s.SELF_EXECUTING, s.ACTIVE, s.PROTECTED_PASSIVE, s.UNPROTECTED_PASSIVE)
    }
    ring = [*executed, *executed][:5]
    policies = s.Scenario(
        executed,
        (
            *(s.AddComponent(name) for name in executed),
            *(s.GetPortElement(name, "p_e", f"ref {name}") for name in executed),
            *(s.Connect(name, "r_e", f"ref {to}", f"k {name}") for name, to in pairwise(ring)),
            s.Start(),
            *(s.Invoke(f"ref {name}", n, thread=f"w{n % 3}") for n in range(4) for name in executed),
            s.Settle("w1"),
            s.Stop(thread="z"),
            s.Settle("w2"),
            s.Settle("z"),
            s.Join("z"),
            s.Start(),
            s.Destroy(),
            s.Invoke(f"ref {s.ACTIVE}", 1),
        ),
    )
    stressed = s.Scenario(
        {**executed, "E": s.Declaration(requires=("r_e",), plan={"on_startup": (s.CallMethod("r_e", "m"),)})},
        (
            *(s.AddComponent(name) for name in executed),
            *(s.GetPortElement(name, "p_e", f"ref {name}") for name in executed),
            *(s.Connect(name, "r_e", f"ref {to}", f"k {name}") for name, to in pairwise(ring)),
            s.Start(),
            *(s.Stress((f"ref {name}", f"ref {name}"), 5) for name in executed),
            s.Invoke(f"ref {s.SELF_EXECUTING}", 1, thread="w"),
            s.Stress(tuple(f"ref {name}" for name in executed), 5),
        ),
    )
    return [gates, crowd, left, s.Scenario(PAIR, (*LIFE, s.Destroy())), settled, policies, stressed, talking()]


def talking() -> s.Scenario:
    """Three threads have a client call, while the connections break, and an emitter push to two receivers."""
    text = d.String("CHAR32")
    problem = d.Structure("problem", {"why": text})
    ask = d.Method((d.Parameter("text", "INOUT", text), d.Parameter("all", "IN", d.Sequence(text))), (problem,))
    asks = s.CallMethod("out", "ask", ("?", ["a", "b"]))
    push = s.Burst("news", 0, 200)
    log = s.CallMethod("p.trace_api", "log", ("info", "called"))
    typed = {"out": "service", "news": "messages"}
    client = s.Declaration(
        ("go",),
        tuple(typed),
        plan={"exchange": (asks, log, push)},
        ports=typed,
        policies=(s.Policy(s.COMPONENT_TRACE, element="p.trace_api"),),
    )
    server = s.Declaration(("in",), plan={"method": (s.Answer("ask", ("!",)),)}, ports={"in": "service"})
    fails = s.Declaration(("in",), plan={"method": (s.Answer("ask", ("!",), "problem"),)}, ports={"in": "service"})
    counts = s.Declaration(("in",), plan={"method": (s.CountMessages(),)}, ports={"in": "messages"})
    ends = (
        ("l", "server", "S", "in"),
        ("l", "client", "C", "out"),
        ("k", "server", "F", "in"),
        ("k", "client", "D", "out"),
    )
    news = (*(("m", "emitter", name, "news") for name in "CD"), *(("m", "receiver", name, "in") for name in "MN"))
    steps = (
        *(s.AddComponent(name) for name in "SFMN"),
        *(s.AddComponent("C", bind=name) for name in "CD"),
        s.Link("simple_service_connector", "service", "l"),
        s.Link("simple_service_connector", "service", "k"),
        s.Link("simple_message_connector", "messages", "m"),
        *(s.Attach(*end) for end in (*ends, *news)),
        *(s.GetPortElement(name, "go", f"go {name}") for name in "CD"),
        s.Start(),
        *(s.Invoke(f"go {name}", n, thread=f"w{n}") for n in range(3) for name in "CD"),
        s.Break("m"),
        s.Break("l"),
        s.ReadLog(2),
        s.Mend("l"),
        s.Mend("m"),
        *(s.Join(f"w{n}") for n in range(3)),
        s.Invoke("go C", 1),
        s.AwaitMessages("M", 200),
        s.AwaitMessages("N", 200),
        s.Stop(),
        s.Detach("l", "S", "in"),
    )
    components = {"S": server, "F": fails, "M": counts, "N": counts, "C": client}
    interfaces = {"service": d.Interface({"ask": ask}), "messages": d.message_interface(d.Integer("ULONG"))}
    return s.Scenario(components, steps, interfaces=interfaces)


def connect(address: str) -> socket.socket:
    if address.startswith("unix:"):
        connection = socket.socket(socket.AF_UNIX)
        connection.connect(address.removeprefix("unix:"))
        return connection
    host, _, port = address.removeprefix("tcp://").rpartition(":")
    return socket.create_connection((host, int(port)))


def found(trace: tuple[t.Event, ...]) -> dict[str, str]:
    return {e.worker: e.where for e in trace if isinstance(e, t.Settled)}
