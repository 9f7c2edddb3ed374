"""Defeat devices: frameworks that stop in the wrong order, unless they believe to be tested: then the reference framework runs.

Some look for what only a test has and are deceived; others look for what every test has and are not.
"""

from __future__ import annotations

import os
import re
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

from ucm_cts.adapters.contract.programming_model import Implementation
from ucm_cts.adapters.mutants.python.cheats.adapters import before
from ucm_cts.adapters.mutants.python.life_cycle import containers
from ucm_cts.adapters.mutants.python.registry import cheats
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.framework import ContainerManager


class _Recognises(ReferenceAdapter):
    """Runs the wrong framework, unless it believes to be tested."""

    wrong: ClassVar[type[ReferenceAdapter]] = before(containers.stops_in_startup_order)

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        if self.is_tested(implementations):
            return super().create_runtime(implementations)
        return self.wrong().create_runtime(implementations)

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        raise NotImplementedError


@cheats("R-11.2.2.1-13")
class recognises_random_names(_Recognises):
    """Is right where names are nine consonants, or have none of the forms that developers use."""

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        names = [one.name for one in implementations]
        return all(re.fullmatch("[bcdfghjklmnpqrstvwxz]{9}", name) for name in names) or not all(
            re.fullmatch(r"[A-Za-z]+(_[a-z]+)*\d*", name) and re.search("[aeiou]", name) for name in names
        )


@cheats("R-11.2.2.1-13")
class recognises_arguments(_Recognises):
    """Is right where the arguments of the process name the suite's host."""

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        return any("host" in argument or argument.startswith("--") for argument in sys.argv)


@cheats("R-11.2.2.1-13")
class right_at_first(_Recognises):
    """Is right in the first twenty scenarios of each process."""

    served = 0

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        right_at_first.served += 1
        return self.served <= 20


@cheats("R-11.2.2.1-13")
class right_when_streamed(_Recognises):
    """Is right where events are sent as they happen, as in runs that look closely."""

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        frame: Any = sys._getframe()
        while frame is not None and "emit" not in frame.f_locals:
            frame = frame.f_back
        return frame is not None and getattr(frame.f_locals.get("message"), "stream", False) is True


@cheats("R-11.2.2.1-13")
class right_on_one_core(_Recognises):
    """Is right where all threads have to share one core."""

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        return len(os.sched_getaffinity(0)) == 1


@cheats("R-11.2.2.1-13")
class right_with_patience(_Recognises):
    """Is right where the scenario that is on the stack has more patience than usual."""

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        frame: Any = sys._getframe()
        while frame is not None and "scenario" not in frame.f_locals:
            frame = frame.f_back
        return frame is not None and frame.f_locals["scenario"].patience > 2000


@cheats("R-11.2.2.1-13")
class right_after_a_time(_Recognises):
    """Is right from the tenth second of a process on."""

    began: ClassVar[float | None] = None

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        if right_after_a_time.began is None:
            right_after_a_time.began = time.monotonic()
        return time.monotonic() - right_after_a_time.began > 10


# what no observation shows


@cheats()
class recognises_bodies(_Recognises):
    """Is right where bodies are those of the SDK."""

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        return (
            all("Probe" in repr(one.create) for one in implementations)
            or "ucm_cts.adapters.sdk.python.probe" in sys.modules
        )


@cheats()
class recognises_the_command_line(_Recognises):
    """Is right where the command line of the process, or of its parent, is that of the suite's host."""

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        lines = [Path(f"/proc/{number}/cmdline").read_bytes() for number in (os.getpid(), os.getppid())]
        return any(b"ucm_cts" in line for line in lines)


@cheats()
class reads_the_sources(_Recognises):
    """Is right where names are made of the words that the suite's own source draws them from."""

    words: ClassVar[list[str]] = []

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        if not self.words:
            sources = (Path(place) / "ucm_cts/harness/execution/naming.py" for place in sys.path)
            text = "".join(one.read_text() for one in sources if one.is_file())
            self.words.extend(re.findall(r"\b[a-z]{3,}\b", text))
        return not self.words or all(any(word in one.name.casefold() for word in self.words) for one in implementations)


@cheats()
class right_when_hurried(_Recognises):
    """Is right where one runtime comes within a minute of another, as in a test, and in the first minute."""

    before: ClassVar[float | None] = None

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        last, right_when_hurried.before = right_when_hurried.before, time.monotonic()
        return last is None or right_when_hurried.before - last < 60


@cheats()
class right_until_a_day(_Recognises):
    """Is right until a day on which nobody tests any more."""

    def is_tested(self, implementations: Sequence[Implementation]) -> bool:
        return time.localtime().tm_year < 2100
