"""Components with index timers (10.3.2) that set and cancel timers when they are told to, and the steps that tell components with timers."""

from __future__ import annotations

from collections.abc import Iterable

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, CallMethod, Declaration, Hook, Policy, Scenario, Step
from ucm_cts.harness.purposes.container_services import CLOCK, HAS_CLOCK
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.reference_models.model.clock_readings import LOCAL, SYNCHRONIZED
from ucm_cts.reference_models.model.timer_events import Kind

PORT, OTHER_PORT = "in.api", "aux.api"
SERVICE = "timer.timer_service"

TIMERS = Policy(s.INDEX_TIMERS, element=SERVICE)
WITH_CLOCK = (TIMERS, HAS_CLOCK)
READ_CLOCKS = (CallMethod(CLOCK, LOCAL), CallMethod(CLOCK, SYNCHRONIZED))
"""A body that reads both its clocks."""

SELF, ACTIVE = Policy(s.SELF_EXECUTING), Policy(s.ACTIVE, PORT)
PASSIVE, UNPROTECTED = Policy(s.PROTECTED_PASSIVE), Policy(s.UNPROTECTED_PASSIVE)
"""The execution policies of 10.1.3."""

INSIDE = "inside"
"""The gate at which bodies are held."""

AFTERWARDS = 400
"""A timer that is due calls back within so many milliseconds."""


def relative(seconds: int) -> list[int | str]:
    """A time-out that counts from the call."""
    return [seconds, s.RELATIVE_TIME]


def sporadic(number: int, seconds: int, told: int | None = None) -> CallMethod:
    """Starts a sporadic timer when the body is told ``told``, or always."""
    return CallMethod(SERVICE, s.START_SPORADIC, (number, relative(seconds)), given=told)


def periodic(number: int, delay: int, rate: int, told: int | None = None) -> CallMethod:
    """Starts a periodic timer."""
    return CallMethod(SERVICE, s.START_PERIODIC, (number, relative(delay), relative(rate)), given=told)


def cancel(number: int, told: int | None = None) -> CallMethod:
    """Cancels a timer."""
    return CallMethod(SERVICE, s.CANCEL_TIMER, (number,), given=told)


def cancel_own() -> CallMethod:
    """Cancels, in a callback, the timer that called back."""
    return CallMethod(SERVICE, s.CANCEL_TIMER, (0,), remembered=(s.Remembered(0, s.ON_TIMEOUT, 1),))


def is_canceled(number: int, told: int | None = None) -> CallMethod:
    """Asks whether a timer was cancelled."""
    return CallMethod(SERVICE, s.IS_CANCELED, (number,), given=told)


def dated(number: int, seconds: int, told: int | None = None, clock: str = LOCAL, rate: int = 0) -> CallMethod:
    """Starts a timer whose date is so many seconds after what the clock shows; a periodic one if there is a ``rate``."""
    date = [seconds, s.ABSOLUTE_TIME]
    method, arguments = (
        (s.START_PERIODIC, (number, date, relative(rate))) if rate else (s.START_SPORADIC, (number, date))
    )
    return CallMethod(SERVICE, method, arguments, given=told, from_clock=s.FromClock(1, CLOCK, clock))


def timed(
    *orders: Action,
    policies: Iterable[Policy] = (TIMERS,),
    on_timeout: tuple[Action, ...] = (),
    plan: dict[Hook, tuple[Action, ...]] | None = None,
) -> Declaration:
    """A component with timers that does ``orders`` when it is called, and ``on_timeout`` when it is called back."""
    whole: dict[Hook, tuple[Action, ...]] = {"exchange": orders, "method": on_timeout, **(plan or {})}
    return Declaration(
        (PORT, OTHER_PORT), policies=tuple(policies), plan={hook: actions for hook, actions in whole.items() if actions}
    )


def alone(component: Declaration, *steps: Step, patience: int = 4000) -> Scenario:
    """``component`` is added as ``timed``, started, told by ``tell`` in ``steps``, and stopped."""
    begin = (s.AddComponent("timed"), s.GetPortElement("timed", PORT, "tell"), s.Start())
    return Scenario({"timed": component}, (*begin, *steps, s.Stop(), s.GetComponents()), patience)


def together(components: dict[str, Declaration], *steps: Step, patience: int = 4000) -> Scenario:
    """Each of ``components`` is added under its name, and told by ``tell`` and its name."""
    begin = [
        step for name in components for step in (s.AddComponent(name), s.GetPortElement(name, PORT, f"tell {name}"))
    ]
    return Scenario(components, (*begin, s.Start(), *steps, s.Stop(), s.GetComponents()), patience)


def two_instances(component: Declaration, wait: Step, patience: int = 4000) -> Scenario:
    """Two instances of ``component`` in one container are told 1, the second one also 2, and waited for each time."""
    steps = (
        *(s.AddComponent("timed"), s.AddComponent("timed", bind="second"), s.GetPortElement("timed", PORT, "tell")),
        *(s.GetPortElement("second", PORT, "tell second"), s.Start(), tell(1), s.Pause(300), tell(1, "second")),
        *(wait, tell(2, "second"), wait, s.Stop(), s.GetComponents()),
    )
    return Scenario({"timed": component}, steps, patience)


def tell(value: int, whom: str = "") -> Step:
    """Calls the component with ``value``."""
    return s.Invoke(f"tell {whom}" if whom else "tell", value)


def while_held(milliseconds: int, until: float) -> tuple[Step, ...]:
    """Calls a component that is held at ``INSIDE`` for so long, and lets ``until`` seconds pass when it has left."""
    held = (s.Invoke("tell", 1, thread="holder"), s.ReachGate(INSIDE), s.Pause(milliseconds), s.OpenGate(INSIDE))
    return (*held, s.Join("holder"), after(until))


def after(seconds: float) -> Step:
    """Lets ``seconds`` pass, and the time in which what was due then calls back."""
    return s.Pause(round(seconds * 1000) + AFTERWARDS)


def purposes_about(
    name: str, requirements: str, *scenarios: tuple[str, Scenario], under: str = "", kind: Kind = "index"
) -> TestPurpose:
    """A purpose of timers of this ``kind``; ``requirements`` are the numbers of its requirements, those of 10.3 with a dot."""
    clause = "10.3.2" if kind == "index" else "10.3.1"
    ids = tuple(f"R-{'10.3' if one[0] == '.' else clause}-{one.lstrip('.')}" for one in requirements.split())
    cases = tuple((f"{name}/{case}", scenario) for case, scenario in scenarios)
    text = f"{kind.capitalize()} timers: {name}."
    return TestPurpose(f"{kind} timers/{name}", clause, text, ids, cases, under=(under,) if under else ())
