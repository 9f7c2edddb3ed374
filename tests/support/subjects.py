"""Adapters for tests of the command line: ``subjects:NAME`` is any mutant, or one of those below."""

from __future__ import annotations

import os
import shutil
import signal
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec

from ucm_cts.adapters.contract import declarations as d
from ucm_cts.adapters.contract.adapter import NotOffered
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, UcmError
from ucm_cts.adapters.mutants import python as mutants
from ucm_cts.adapters.mutants.python.registry import Base, bind
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.framework import ContainerManager
from ucm_cts.adapters.reference.python.members import Failures, Member
from ucm_cts.adapters.reference.python.timers import Timer


def __getattr__(name: str) -> type[ReferenceAdapter]:
    adapter: type[ReferenceAdapter] = getattr(mutants, name)
    return adapter


class Listening(ReferenceAdapter):
    """Conformant; writes every name that it receives, and its process id, to the file ``$CALL_RECORD``."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        with Path(os.environ["CALL_RECORD"]).open("a") as calls:
            for one in implementations:
                print(os.getpid(), one.name, *one.provides, *one.requires, file=calls)
        return super().create_runtime(implementations)


class Waiting(ReferenceAdapter):
    """Writes to the named pipe ``$CALL_RECORD`` when it is called, and never returns."""

    def start(self, container: object) -> None:
        Path(os.environ["CALL_RECORD"]).write_text("started")
        threading.Event().wait()


class Vandal(ReferenceAdapter):
    """Writes a file at the place of the report."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        out = Path(os.environ["REPORT"])
        if out.is_dir():
            shutil.rmtree(out)
            out.write_text("")
        return super().create_runtime(implementations)


class Misspelled(ReferenceAdapter):
    """Declares a wrong pattern for the names of port elements."""

    port_element_name = "{gate}"


class HidesItsLog(ReferenceAdapter):
    """Offers no test access to the trace."""

    def read_log(self, manager: object) -> Sequence[tuple[str, str]]:
        raise NotOffered


class Unbreakable(ReferenceAdapter):
    """Offers no faults for tests."""

    def break_link(self, link: object, where: str) -> None:
        raise NotOffered


class SlowAtFirst(ReferenceAdapter):
    """Never ends its first start, and executes nothing by itself in the runtime after: as if the machine stood still."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        self._is_running = any(p.definition == d.SELF_EXECUTING for one in implementations for p in one.policies)
        made = Path("made")
        self._before = made.stat().st_size if made.exists() else 0
        if self._is_running:
            with made.open("a") as file:
                file.write("x")
        if self._is_running and self._before == 1:
            implementations = [replace(one, policies=()) for one in implementations]
        return super().create_runtime(implementations)

    def start(self, container: Any) -> None:
        if self._is_running and not self._before:
            threading.Event().wait()
        super().start(container)


class _Ignoring(ReferenceAdapter):
    """Its framework never sees some policies."""

    ignored: frozenset[str]

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        return super().create_runtime(
            [
                replace(one, policies=tuple(p for p in one.policies if p.definition not in self.ignored))
                for one in implementations
            ]
        )


class IgnoresClockAndTrace(_Ignoring):
    """Gives bodies neither clock nor trace."""

    ignored = frozenset((d.CLOCK, d.COMPONENT_TRACE))


class NeverRunsByItself(_Ignoring):
    """Executes no component by itself."""

    ignored = frozenset((d.SELF_EXECUTING,))


class _Refusing(ReferenceAdapter):
    """Refuses components with some policies."""

    def is_refused(self, policy: d.Policy) -> bool:
        raise NotImplementedError

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        self._refused = {one.name for one in implementations if any(map(self.is_refused, one.policies))}
        return super().create_runtime(implementations)

    def add_component(self, container: Any, implementation: str, attributes: Mapping[str, str]) -> int:
        if implementation in self._refused:
            raise UcmError
        return super().add_component(container, implementation, attributes)


class RefusesPortTraces(_Refusing):
    """Traces no ports."""

    def is_refused(self, policy: d.Policy) -> bool:
        return policy.definition == d.PORT_TRACE


class ActiveAsAWhole(_Refusing):
    """Takes the policy of active components for whole components only."""

    def is_refused(self, policy: d.Policy) -> bool:
        return policy.definition == d.ACTIVE and policy.port is not None

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        every_port = [
            replace(one, policies=[p for each in one.policies for p in self._on_ports(each, one)])
            for one in implementations
        ]
        runtime = super().create_runtime(every_port)
        self._refused = {one.name for one in implementations if any(map(self.is_refused, one.policies))}
        return runtime

    def _on_ports(self, policy: d.Policy, of: Implementation) -> list[d.Policy]:
        if policy.definition != d.ACTIVE or policy.port is not None:
            return [policy]
        return [msgspec.structs.replace(policy, port=port) for port in of.provides]


class Dying(ReferenceAdapter):
    """Dies by a signal when a component is added."""

    def add_component(self, container: Any, implementation: str, attributes: Mapping[str, str]) -> int:
        os.kill(os.getpid(), signal.SIGSEGV)
        return super().add_component(container, implementation, attributes)


class _Crashing(Base):
    """Dies by a signal when a container that has members is started a second time."""

    starts = 0

    def start(self) -> None:
        self.starts += 1
        if self.members and self.starts > 1:
            os.kill(os.getpid(), signal.SIGSEGV)
        super().start()


Crashing = bind("Crashing", _Crashing, _Crashing.__doc__)


class _Parrot(Base):
    """Has memorised the suite's scripts: gives bodies the port element of the scripts, not their own."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        return [PortConnection("out_api", d.to_port) for d in super()._dependencies_of(member)]


Parrot = bind("Parrot", _Parrot, _Parrot.__doc__)


class _Moody(Base):
    """Forgets to tell a body that it is removed, if the body's name begins with a letter of the alphabet's first half."""

    def _remove(self, member: Member, failures: Failures) -> None:
        if member.implementation.name >= "n":
            super()._remove(member, failures)


Moody = bind("Moody", _Moody, _Moody.__doc__)


class Mended(ReferenceAdapter):
    """Was once ``stops_in_startup_order``, and conforms now."""

    product = "stops_in_startup_order"


class Forgets(Base):
    """Does not record what an error is, while there is something to forget."""

    left = 0

    def _log(self, member: Member, severity: str, message: str) -> None:
        if severity == "error" and Forgets.left > 0:
            Forgets.left -= 1
        else:
            super()._log(member, severity, message)


Forgetful = bind("Forgetful", Forgets)


class Dawdles(Base):
    """Calls back half a second after a timer has expired, while it may dawdle."""

    left = 0

    def _call_back(self, member: Member, timer: Timer) -> None:
        if Dawdles.left > 0:
            Dawdles.left -= 1
            time.sleep(0.5)
        super()._call_back(member, timer)


Dawdling = bind("Dawdling", Dawdles)


class DawdlesOnce(Base):
    """Calls back half a second after a timer has expired, the first time in each runtime."""

    def _call_back(self, member: Member, timer: Timer) -> None:
        if self.manager.__dict__.setdefault("dawdles", True):
            self.manager.__dict__["dawdles"] = False
            time.sleep(0.5)
        super()._call_back(member, timer)


DawdlingOnce = bind("DawdlingOnce", DawdlesOnce)


class Slips(Base):
    """Forgets to tell a body that it is removed, while there is something to forget."""

    left = 0

    def _remove(self, member: Member, failures: Failures) -> None:
        if Slips.left > 0:
            Slips.left -= 1
        else:
            super()._remove(member, failures)


Slipping = bind("Slipping", Slips)


class MissesOnOneCore(Base):
    """Does not record what an error is where there is one core only."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if severity != "error" or len(os.sched_getaffinity(0)) > 1:
            super()._log(member, severity, message)


MissingOnOneCore = bind("MissingOnOneCore", MissesOnOneCore)
