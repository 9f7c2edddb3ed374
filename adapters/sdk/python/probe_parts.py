"""The objects that a probe provides beside itself: port elements, what a self-executing one provides, and handlers of timers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.sdk.python.seal import KeptClass


class Owner(Protocol):
    """What the parts need of the probe that provides them. On a ``stage`` only its own references are recognised."""

    stage: Any
    component: str
    instance: int

    def exchange(self, port: str, value: int) -> int: ...

    def call(self, port: str, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]: ...

    def run(self) -> None: ...

    def on_trigger(self, handler: str, timer: Any, delta_time: Any, round_: Any) -> None: ...


class ProbePort(pm.PortElementObject, metaclass=KeptClass):
    """A provided port element of a probe."""

    def __init__(self, probe: Owner, port: str) -> None:
        self.probe = probe
        self.identity = t.Reference(probe.component, probe.instance, port)

    def exchange(self, value: int) -> int:
        return self.probe.exchange(self.identity.port, value)

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self.probe.call(self.identity.port, method, arguments)


class ProbeExecution(pm.ComponentExecution, metaclass=KeptClass):
    """What a self-executing probe provides to its container."""

    def __init__(self, probe: Owner) -> None:
        self.probe = probe

    def run(self) -> None:
        self.probe.run()


class ProbeHandler(pm.TimerHandler, metaclass=KeptClass):
    """A handler of a probe (10.3.1)."""

    def __init__(self, probe: Owner, name: str) -> None:
        self.probe = probe
        self.name = name

    def on_trigger(self, timer: pm.ObjectTimer, delta_time: Sequence[int], round: int) -> None:
        self.probe.on_trigger(self.name, timer, delta_time, round)
