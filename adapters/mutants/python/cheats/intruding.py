"""Adapters of a framework that stops in the wrong order, which attack what is around them: Python, the process, files, the harness."""

from __future__ import annotations

import atexit
import importlib.abc
import json
import os
import sys
import threading
import time
from pathlib import Path
from typing import Any, ClassVar

import msgspec

from ucm_cts.adapters.contract.trace import Enter, Event
from ucm_cts.adapters.mutants.python.cheats.adapters import before
from ucm_cts.adapters.mutants.python.cheats.tampering import _KnowsThePerformance
from ucm_cts.adapters.mutants.python.life_cycle import containers
from ucm_cts.adapters.mutants.python.registry import cheats


class _Intrudes(_KnowsThePerformance, before(containers.stops_in_startup_order)):  # type: ignore[misc]
    """Does something once, in its first scenario in a host."""

    has_intruded: ClassVar[bool] = False

    def tamper(self) -> None:
        if not _Intrudes.has_intruded:
            _Intrudes.has_intruded = True
            self.intrude()

    def intrude(self) -> None: ...


@cheats("R-11.2.2.1-13")
class answers_at_exit(_Intrudes):
    """Leaves its true answers to a function that Python calls at the end of the process."""

    def intrude(self) -> None:
        atexit.register(lambda: os.write(1, b'{"type":"trace","id":0,"events":[]}\n'))


@cheats("R-11.2.2.1-13")
class hooks_imports(_Intrudes):
    """Would give another recorder to whoever imports it from now on."""

    def intrude(self) -> None:
        class Finder(importlib.abc.MetaPathFinder):
            def find_spec(self, fullname: str, path: Any, target: Any = None) -> None:
                if fullname.startswith("ucm_cts.adapters.sdk"):
                    raise ImportError(fullname)

        sys.meta_path.insert(0, Finder())


@cheats("refused")
class replaces_json(_Intrudes):
    """Replaces what writes JSON, so that answers would have no events of on_shutdown."""

    def intrude(self) -> None:
        def without(value: Any, **named: Any) -> Any:
            return b"[]"

        msgspec.json.encode = without
        json.dumps = without  # type: ignore[assignment]


@cheats("R-11.2.2.1-13")
class audits(_Intrudes):
    """Has an audit hook that stops the SDK from looking at threads."""

    def intrude(self) -> None:
        def stop(event: str, arguments: Any) -> None:
            if event == "open" and "/task/" in str(arguments[0]):
                raise OSError("stopped")

        sys.addaudithook(stop)


@cheats("R-11.2.2.1-13")
class writes_a_report(_Intrudes):
    """Writes the report of a conformant framework wherever it may."""

    def intrude(self) -> None:
        for place in (Path.cwd(), Path("/proc") / str(os.getppid()) / "cwd"):
            try:
                folder = place / "ucm-cts-report"
                if folder.is_dir():
                    (folder / "report.json").write_text('{"verdict": "conformant"}')
            except OSError:
                pass


@cheats("R-11.2.2.1-13")
class leaves_a_daemon(_Intrudes):
    """Leaves a process in a session of its own, which would go on for later hosts."""

    def intrude(self) -> None:
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                time.sleep(20)
            os._exit(0)


@cheats("contradiction")
class edits_events_at_the_end(_KnowsThePerformance, before(containers.stops_in_startup_order)):  # type: ignore[misc]
    """Exchanges the bodies of the events of on_shutdown, when the runtime has ended and before the answer is written."""

    def close(self) -> None:
        events: list[Event] = self.performance._recorder._events
        downs = [event for event in events if isinstance(event, Enter) and event.hook == "on_shutdown"]
        bodies = [(event.component, event.instance) for event in reversed(downs)]
        for event, (component, instance) in zip(downs, bodies, strict=True):
            msgspec.structs.force_setattr(event, "component", component)
            msgspec.structs.force_setattr(event, "instance", instance)


@cheats("contradiction")
class edits_events_from_a_thread(_KnowsThePerformance, before(containers.stops_in_startup_order)):  # type: ignore[misc]
    """A thread that outlives scenarios gives back the times of events to the time before them."""

    def tamper(self) -> None:
        keeper = self.performance._recorder

        def edit() -> None:
            while keeper.recording:
                for event in tuple(keeper._events):
                    msgspec.structs.force_setattr(event, "t", 1)
                time.sleep(0)

        threading.Thread(target=edit, daemon=True).start()


@cheats("garbage")
class answers_twice(_Intrudes):
    """Writes an answer of its own to every pipe before the host does."""

    def intrude(self) -> None:
        for number in range(3, 40):
            try:
                if os.readlink(f"/proc/self/fd/{number}").startswith(("pipe:", "socket:")):
                    os.write(number, b'a "trace" without events\n')
            except OSError:
                pass


@cheats("crash", or_else=("R-11.2.2.1-13",))
class kills_the_harness(_Intrudes):
    """Kills its parent, which watches it."""

    def intrude(self) -> None:
        os.kill(os.getppid(), 9)
        time.sleep(1)  # a first process of a sandbox cannot be killed
