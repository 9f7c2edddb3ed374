"""Hosts in virtual time: waits take none, and are as long as they are asked to be."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from cpp_builds import Builds

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Paused, Timeout, Trace
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting import virtual_time
from ucm_cts.harness.hosting.locate import WrongUse, locate

HOUR = 3_600_000

PROGRAM = """
from ucm_cts.adapters.sdk.python.virtual_time import READING, install
install()
import concurrent.futures, os, queue, threading, time
began = time.monotonic()
seen = []

def passed():
    return round(time.monotonic() - began, 3)

def later(seconds, what):
    time.sleep(seconds)
    seen.append((what, passed()))
"""


def shown(text: str) -> str:
    """What a program prints that runs in virtual time."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM + textwrap.dedent(text)],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert not done.stderr, done.stderr
    return done.stdout.strip()


def trace(adapter: str, *steps: s.Step, patience: int = 2000) -> Trace:
    asked = s.Scenario({"sink": s.Declaration(("in",))}, steps, patience)
    with Driver(locate(adapter, virtual_time=True), 1) as driver:
        (answer,) = driver.run([("one", asked)])
    assert answer.incident is None
    return answer.trace


def milliseconds(events: Trace) -> float:
    return (events[-1].t - events[0].t) / 1e6


ADAPTERS = pytest.mark.parametrize("adapter", ["reference-py", pytest.param("reference-cpp", marks=pytest.mark.native)])


@ADAPTERS
def test_an_hour_passes_at_once(adapter: str) -> None:
    events = trace(adapter, s.AddComponent("sink"), s.Pause(HOUR), s.Start())
    pause = next(number for number, event in enumerate(events) if isinstance(event, Paused))
    assert HOUR <= milliseconds(events) < HOUR + 10
    assert HOUR <= milliseconds(events[pause - 1 : pause + 1]) < HOUR + 1


@ADAPTERS
def test_patience_runs_out_at_once(adapter: str) -> None:
    events = trace(adapter, s.ReachGate("nowhere"), s.Start(), patience=HOUR)
    assert isinstance(events[0], Timeout)
    again = trace(adapter, s.Start(), s.ReachGate("nowhere"), patience=HOUR)
    assert HOUR <= milliseconds(again) < HOUR + 10


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("time.sleep(5); print(passed())", "5.0"),
        ("print(threading.Lock().acquire(timeout=3), passed())", "True 0.0"),
        ("lock = threading.Lock(); lock.acquire(); print(lock.acquire(timeout=3), passed())", "False 3.0"),
        ("lock = threading.Lock(); lock.acquire(); print(lock.acquire(False), lock.acquire(timeout=0), passed())", "False False 0.0"),
        ("lock = threading.RLock(); print(bool(lock.acquire() and lock.acquire()), passed())", "True 0.0"),
        ("print(threading.Event().wait(100), passed())", "False 100.0"),
        (
            "queued = queue.SimpleQueue(); threading.Timer(2, queued.put, [7]).start(); print(queued.get(), passed())",
            "7 2.0",
        ),
        ("print(queue.Queue().empty(), threading.Semaphore(0).acquire(timeout=4), passed())", "True False 4.0"),
        (
            """
            threads = [threading.Thread(target=later, args=(n, n)) for n in (3, 1, 2)]
            for thread in threads: thread.start()
            for thread in threads: thread.join()
            print(seen, passed())
            """,
            "[(1, 1.0), (2, 2.0), (3, 3.0)] 3.0",
        ),
        (
            """
            thread = threading.Thread(target=later, args=(9, "late"))
            thread.start()
            thread.join(4)
            print(thread.is_alive(), passed())
            thread.join()
            print(thread.is_alive(), passed())
            """,
            "True 4.0\nFalse 9.0",
        ),
        (
            """
            lock = threading.Lock()
            def hold(name):
                with lock:
                    later(1, name)
            threads = [threading.Thread(target=hold, args=(n,)) for n in "abc"]
            for thread in threads: thread.start()
            for thread in threads: thread.join()
            print(seen)
            """,
            "[('a', 1.0), ('b', 2.0), ('c', 3.0)]",
        ),
        (
            """
            together = threading.Barrier(2)
            threading.Thread(target=lambda: (time.sleep(6), together.wait())).start()
            together.wait()
            print(passed())
            """,
            "6.0",
        ),
        (
            """
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                print(sum(pool.map(lambda n: time.sleep(n) or n, (1, 2, 3))), passed())
            """,
            "6 4.0",
        ),
        (
            """
            threading.Thread(target=later, args=(0.05, "sleeper")).start()
            while passed() < 0.2:
                pass
            print(seen, passed())
            """,
            "[('sleeper', 0.05)] 0.2",
        ),
        (
            """
            wall, own = time.time(), time.monotonic()
            time.sleep(86400)
            print(round(time.time() - wall), round(time.monotonic() - own), round(time.perf_counter() - own))
            """,
            "86400 86400 86400",
        ),
        (
            """
            threading.Thread(target=time.sleep, args=(50,), daemon=True).start()
            child = os.fork()
            if child == 0:
                time.sleep(7)
                os._exit(int(passed()))
            print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
            """,
            "7",
        ),
        *(
            (
                f"""
                flag = []
                lock, event, other = threading.Lock(), threading.Event(), threading.Lock()
                other.acquire()
                threading.Thread(target=lambda: (time.sleep(0.02), flag.append(1))).start()
                while not flag:
                    {polling}
                print("done")
                """,
                "done",
            )
            for polling in ("time.sleep(0)", "event.wait(0)", "other.acquire(False)", "lock.acquire(); lock.release()")
        ),
        (
            """
            lock = threading.Lock()
            lock.acquire()
            thread = threading.Thread(target=lock.acquire, daemon=True)
            thread.start()
            time.sleep(1)
            child = os.fork()
            if child == 0:
                thread.join()
                lock.release()
                os._exit(int(lock.acquire(timeout=2)))
            print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
            """,
            "1",
        ),
        (
            """
            import functools
            class Slow:
                @functools.cached_property
                def value(self):
                    time.sleep(2)
                    return 7
            slow = Slow()
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                print(list(pool.map(lambda _: slow.value, range(2))), passed())
            """,
            "[7, 7] 2.0",
        ),
        (
            """
            import _thread
            class Helped(threading.Thread):
                def run(self):
                    _thread.start_new_thread(time.sleep, (100,))
                    time.sleep(1)
            helped = Helped()
            helped.start()
            helped.join()
            print(passed())
            """,
            "1.0",
        ),
        (
            """
            lock = threading.Lock()
            lock.acquire()
            class Releases:
                def __del__(self):
                    lock.release()
            class Cycle: pass
            import gc
            for _ in range(3):
                one = Cycle()
                one.one, one.two = one, Releases()
                del one
                gc.set_threshold(1)
                if not lock.acquire(timeout=5):
                    print("lost")
                gc.set_threshold(700)
            print("done")
            """,
            "done",
        ),
        (
            """
            lock = threading.Lock()
            lock.acquire()
            for time_out in (float("inf"), float("nan")):
                try: lock.acquire(timeout=time_out)
                except (OverflowError, ValueError): print("refused")
            lock.release()
            print(lock.acquire(timeout=1))
            """,
            "refused\nrefused\nTrue",
        ),
        (
            """
            waiting = queue.Queue()
            for _ in range(5000):
                waiting.put(1)
                threading.Event().wait(0.001)
                waiting.get(timeout=3600)
            from ucm_cts.adapters.sdk.python.virtual_time import TIME
            print(len(TIME._moments) < 3000)
            """,
            "True",
        ),
        (
            """
            for number in range(2000):  # the lock is released when, or just before or after, the time is over
                lock = threading.Lock()
                lock.acquire()
                thread = threading.Thread(target=lambda: (time.sleep(0.001), lock.release()))
                thread.start()
                lock.acquire(timeout=0.001 + number * 1e-7)
                thread.join()
                assert len(lock._waiters) == 0
            print("done")
            """,
            "done",
        ),
        ("print(time.monotonic_ns() < time.monotonic_ns() <= time.monotonic_ns() + READING)", "True"),
        (
            """
            try: threading.Lock().release()
            except RuntimeError as error: print(error)
            try: time.sleep(-1)
            except ValueError as error: print(error)
            """,
            "release unlocked lock\nsleep length must be non-negative",
        ),
    ],
)  # fmt: skip
def test_waits_are_as_long_as_they_are_asked_to_be(text: str, printed: str) -> None:
    assert shown(text) == printed


def written(place: Path, content: bytes) -> str:
    place.write_bytes(content)
    place.chmod(0o755)
    return str(place)


def elf(machine: int, kind: int, loader: bytes = b"/lib64/ld-linux-x86-64.so.2") -> bytes:
    """The beginning of a 64-bit little-endian executable for ``machine``, with one segment of that ``kind``, which names ``loader``."""
    identity = b"\x7fELF\x02\x01\x01".ljust(16, b"\0")
    header = struct.pack("<HHIQQQIHHHHHH", 2, machine, 1, 0, 64, 0, 0, 64, 56, 1, 0, 0, 0)
    return identity + header + struct.pack("<IIQ", kind, 4, 120).ljust(56, b"\0") + loader + b"\0"


def test_a_program_is_in_virtual_time_only_if_it_loads_the_library(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = tmp_path / "library.so"
    monkeypatch.setattr(virtual_time, "LIBRARY", library)
    native = written(tmp_path / "native", elf(62, 3))
    with pytest.raises(WrongUse, match=r"virtual time: this installation has no library.so"):
        locate(native, virtual_time=True)
    library.write_bytes(elf(62, 1))
    assert locate(native, virtual_time=True).virtual_time
    for name, content in {
        "static": elf(62, 1),
        "of another machine": elf(183, 3),
        "script": b"#!/bin/sh\n".ljust(200, b"#"),
        "cut": elf(62, 3)[:64],
        "of musl": elf(62, 3, b"/lib/ld-musl-x86_64.so.1"),
        "empty": b"",
    }.items():
        with pytest.raises(WrongUse, match="or an executable for this machine and glibc"):
            locate(written(tmp_path / name, content), virtual_time=True)
    os.chmod(native, 0o4755)
    with pytest.raises(WrongUse, match="or an executable for this machine and glibc"):
        locate(native, virtual_time=True)
    library = tmp_path / "a folder" / "library.so"
    library.parent.mkdir()
    library.write_bytes(elf(62, 1))
    monkeypatch.setattr(virtual_time, "LIBRARY", library)
    with pytest.raises(WrongUse, match=r"has a blank or a colon, .*; install ucm-cts elsewhere"):
        locate(native, virtual_time=True)


def test_what_runs_elsewhere_is_not_in_virtual_time() -> None:
    with pytest.raises(WrongUse, match="cannot run in virtual time: that needs a Python adapter, or an executable"):
        locate("tcp://localhost:1", virtual_time=True)


def test_not_in_the_harness_s_own_process() -> None:
    with pytest.raises(WrongUse, match="in a process of its own"):
        locate("reference-py", in_process=True, virtual_time=True)


@pytest.mark.parametrize(
    ("case", "printed"),
    {
        "sleep": "slept 3600.0",
        "several clocks": "true 3600.0, true 3600.0",
        "condition": "false 2.0, true 3.0",
        "conditions of either clock": "true 4.0, true 8.0",
        "timed mutex": "false 2.0, true 5.0",
        "recursive mutex": "other 2.0",
        "read-write lock": "true 2.0, all have read 3.0",
        "semaphore": "false 4.0, posted 6.0",
        "future": "false 2.0, 5 7.0",
        "threads": "1 1.0, 2 2.0, 3 3.0",
        "detached": "done 8.0",
        "exits early": "joined 7.0",
        "contention": "40000",
        "polling": "seen 1.0",
        "own locks": "true 0.0, true 0.0",
        "error number": "true 1.0",
        "signals": "served",
        "detaches itself": "over",
        "looping": "done 60.0",
        "forked": "child 20.0, parent 1000.0",
    }.items(),
)
def test_waits_of_native_programs_are_as_long_as_they_are_asked_to_be(builds: Builds, case: str, printed: str) -> None:
    library = builds.reference.with_name(virtual_time.LIBRARY.name)
    environment = {**os.environ, "LD_PRELOAD": str(library)}
    done = subprocess.run(
        [builds.program("waits"), case], env=environment, capture_output=True, text=True, check=False, timeout=60
    )
    assert (", ".join(done.stdout.splitlines()), done.stderr) == (printed, "")
