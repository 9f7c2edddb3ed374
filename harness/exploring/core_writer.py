"""Random scenarios of 10.1: components with policies and both connectors, clocks, traces and broken transports.

One thread operates containers and calls components. Scenarios wait for messages that are certain to come; where a component is
stopped or detached meanwhile, messages may be lost, and scenarios wait for no further ones.
"""

from __future__ import annotations

from collections.abc import Iterable

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Integer, Interface, Method, Parameter, message_interface
from ucm_cts.adapters.contract.scenario import Action, Declaration, Policy, Scenario, Step
from ucm_cts.harness.exploring.writer import Choose
from ucm_cts.harness.purposes import connections as c

_NUMBER = Integer("LONG")
_INTERFACES = {
    "service": Interface(
        {
            "echo": Method((Parameter("given", "IN", _NUMBER), Parameter("result", "RETURN", _NUMBER))),
            "tell": Method((Parameter("given", "INOUT", _NUMBER),)),
        }
    ),
    "numbers": message_interface(Integer("ULONG")),
}
_CONNECTORS: dict[str, c.Connector] = {"service": c.SERVICE, "numbers": c.MESSAGE}
_METHODS = ("echo", "tell")
_CLOCK_API = "clock.clock_api"
_TRACE_API = "trace.trace_api"
_SEVERITIES = ("debug", "info", "warning", "error")
_OPERATIONS = (
    *["call"] * 10,
    *["restart", "stop", "start"] * 2,
    "remove_end",
    "add_end",
    "add_end",
    "remove",
    "list_members",
    "meet",
    "cut",
)


class CoreWriter:
    """Writes one scenario; ``choose`` picks one of several things."""

    def __init__(self, choose: Choose) -> None:
        self.choose = choose
        self.components: dict[str, Declaration] = {}
        self.steps: list[Step] = []
        self.places: dict[str, str] = {}
        self.lines: dict[str, str] = {}
        self.roles: dict[str, str] = {}
        self.ends: dict[str, str] = {}
        self.pushes: dict[str, int] = {}
        self.started: dict[str, bool] = {}
        self.come: dict[str, int | None] = {}
        self.holding: list[str] = []
        self.broken: list[str] = []
        self.writes: dict[str, int] = {}
        self.records: int | None = 0
        self.values = 0

    def scenario(self) -> Scenario:
        """A new scenario."""
        for kind in self.choose((("service",), ("numbers",), ("service", "numbers"), ("numbers", "numbers"))):
            line = f"line {len(self.lines) + 1}"
            self.lines[line] = kind
            for name in self.configure(kind):
                self.ends[name] = line
        self.set_up()
        for _ in range(self.choose((3, 5, 8, 12))):
            getattr(self, self.choose(_OPERATIONS))()
        for place in self.choose(((), tuple(self.started))):
            self.steps.append(s.Stop(place))
        if self.traces():
            self.steps.append(s.ReadLog(self.records or 0))
        self.steps.append(s.GetComponents())
        used = {name: _INTERFACES[name] for name in dict.fromkeys(self.lines.values())}
        return Scenario(self.components, tuple(self.steps), interfaces=used)

    def configure(self, kind: str) -> list[str]:
        """Declare components that serve or receive, then components that call or push; return their names."""
        names = []
        serving, calling = c.PROVIDER[_CONNECTORS[kind]], c.REQUIRER[_CONNECTORS[kind]]
        for role, most in ((serving, 1 if kind == "service" else 2), (calling, 3)):
            for _ in range(self.choose(range(1, most + 1))):
                name = f"{role} {sum(r == role for r in self.roles.values()) + 1}"
                self.components[name] = self.serving(name, kind) if role == serving else self.calling(name, kind)
                self.roles[name] = role
                names.append(name)
        return names

    def serving(self, name: str, kind: str) -> Declaration:
        ports = ("in.api",)
        before: tuple[Action, ...] = ()
        if kind == "numbers":
            before = (s.HoldAtGate(f"gate of {name}"),)
            self.come[name] = 0
        elif self.choose((False, False, True)):
            before = (s.HoldAtGate(f"inside {name}"),)
            self.holding.append(name)
        answers = (s.Answer(s.PUSH, ("ok",)),) if kind == "numbers" else (s.Answer("echo"), s.Answer("tell"))
        policies: tuple[Policy, ...] = self.choose(
            (
                (),
                (),
                (Policy(s.PROTECTED_PASSIVE),),
                (Policy(s.UNPROTECTED_PASSIVE),),
                (Policy(s.ACTIVE, "in.api"),),
                (Policy(s.SELF_EXECUTING),),
            )
        )
        policies += self.port_trace("in.api", kind)
        plan: dict[s.Hook, tuple[Action, ...]] = {"method": (*before, *answers)}
        return Declaration(ports, plan=plan, policies=policies, ports={"in.api": kind}, connectable=self.connectable())

    def calling(self, name: str, kind: str) -> Declaration:
        calls: list[Action] = []
        for _ in range(self.choose((1, 1, 2, 3))):
            method = s.PUSH if kind == "numbers" else self.choose(_METHODS)
            calls.append(s.CallMethod("out.api", method, (self.value(),)))
        self.pushes[name] = len(calls) if kind == "numbers" else 0
        policies: tuple[Policy, ...] = self.choose(
            ((), (), (Policy(s.PROTECTED_PASSIVE),), (Policy(s.ACTIVE, "in.api"),))
        )
        if self.choose((False,) * 5 + (True,)):
            policies = (Policy(s.UNPROTECTED_PASSIVE), Policy(s.CLOCK, element=_CLOCK_API))
            calls.append(s.CallMethod(_CLOCK_API, "get_local_time"))
        if self.choose((False,) * 5 + (True,)):
            policies = (Policy(s.UNPROTECTED_PASSIVE), Policy(s.COMPONENT_TRACE, element=_TRACE_API))
            severity = self.choose(_SEVERITIES)
            calls.append(s.CallMethod(_TRACE_API, "log", (severity, f"message {self.value()} of {name}")))
            self.writes[name] = 1
        policies += self.port_trace("out.api", kind)
        return Declaration(
            ("in.api",),
            ("out.api",),
            plan={"exchange": tuple(calls)},
            policies=policies,
            ports={"out.api": kind},
            connectable=self.connectable(),
        )

    def port_trace(self, port: str, kind: str) -> tuple[Policy, ...]:
        """Sometimes ``port`` is traced. The writer does not count its calls."""
        if not self.choose((False,) * 9 + (True,)):
            return ()
        self.records = None
        method = s.PUSH if kind == "numbers" else self.choose(_METHODS)
        parameters = {s.METHODS_TO_TRACE: method, s.LOG_SEVERITY: self.choose(_SEVERITIES)}
        return (Policy(s.PORT_TRACE, port, parameters),)

    def traces(self) -> bool:
        """Does any component write to the trace?"""
        return bool(self.writes) or self.records is None

    def connectable(self) -> bool:
        return bool(self.choose((False, False, True)))

    def value(self) -> int:
        """A new value at each call, so that a message shows where it comes from."""
        self.values += 1
        return self.values

    # setting up

    def set_up(self) -> None:
        boxes = [s.MANAGER, *(f"box{n}" for n in range(1, self.choose((1, 1, 2, 3))))]
        self.steps += [s.CreateContainer(box) for box in boxes[1:]]
        self.steps += [s.OpenGate(f"gate of {name}") for name in self.come]
        self.steps += [s.Link(_CONNECTORS[kind], kind, line) for line, kind in self.lines.items()]
        for name in self.components:
            self.places[name] = self.choose(boxes)
            self.steps.append(s.AddComponent(name, self.places[name]))
        for name in list(self.ends):
            self.steps.append(self.attachment(name))
        for name in self.pushes:
            self.steps.append(s.GetPortElement(name, "in.api", f"tell {name}", self.places[name]))
        for box in boxes:
            self.started[box] = False
        for box in boxes if self.choose((True, True, True, False)) else ():
            self.start_in(box)

    def attachment(self, name: str) -> Step:
        line = self.ends[name]
        end = c.required_end if name in self.pushes else c.provided_end
        return end(_CONNECTORS[self.lines[line]], line, name, container=self.places[name])

    def start_in(self, box: str) -> None:
        self.steps.append(s.Start(box))
        self.started[box] = True

    # operations

    def call(self) -> None:
        """A component calls or pushes; the scenario waits for pushed messages that have to come."""
        ready = [name for name in self.pushes if name in self.ends]
        if not ready:
            return
        name = self.choose(ready)
        self.let_in(name)
        serving = [who for who in self.come if self.ends.get(who) == self.ends[name] and who in self.places]
        self.steps.append(s.Invoke(f"tell {name}", self.value()))
        self.expect_records(name)
        if not self.pushes[name]:
            return
        for who in serving:
            known = self.come[who]
            if known is None:
                continue
            if self.ends[name] in self.broken or not all(self.started[self.places[one]] for one in (name, *serving)):
                self.come[who] = None  # it may come later, or never
                continue
            self.come[who] = known + self.pushes[name]
            self.steps.append(s.ReachGate(f"gate of {who}", total=known + self.pushes[name]))

    def expect_records(self, caller: str) -> None:
        """What ``caller`` writes can be waited for if it surely comes to writing it."""
        if caller in self.writes and self.records is not None:
            line = self.ends[caller]
            is_sure = line not in self.broken and all(self.started[self.places[one]] for one in self.line_of(caller))
            is_sure = is_sure and any(one not in self.pushes for one in self.line_of(caller))
            self.records = self.records + self.writes[caller] if is_sure else None

    def cut(self) -> None:
        """Nothing can be transmitted any more, or it can again."""
        line = self.choose(tuple(self.lines))
        if line in self.broken:
            self.broken.remove(line)
            self.steps.append(s.Mend(line))
        elif self.choose((False, True)):
            self.broken.append(line)
            self.steps.append(s.Break(line))
            for who in self.come:
                if self.ends.get(who) == line:
                    self.come[who] = None

    def let_in(self, caller: str) -> None:
        """Opens the gates of components that ``caller`` calls: it would else wait until patience runs out."""
        for who in [who for who in self.holding if who in self.line_of(caller)]:
            self.holding.remove(who)
            self.steps.append(s.OpenGate(f"inside {who}"))

    def meet(self) -> None:
        """Two clients call while the first is held inside."""
        ready = [
            who
            for who in self.holding
            if who in self.places
            and self.ends.get(who) not in self.broken
            and all(self.started[self.places[one]] for one in self.line_of(who))
        ]
        callers = [one for one in self.line_of(ready[0]) if one in self.pushes][:2] if ready else []
        if len(callers) < 2:
            return
        self.holding.remove(ready[0])
        gate, workers = f"inside {ready[0]}", [f"caller of {name}" for name in callers]
        self.steps.append(s.Invoke(f"tell {callers[0]}", self.value(), thread=workers[0]))
        self.steps.append(s.ReachGate(gate))
        self.steps.append(s.Invoke(f"tell {callers[1]}", self.value(), thread=workers[1]))
        self.steps += [s.Settle(workers[1]), s.OpenGate(gate), *map(s.Join, workers)]

    def line_of(self, who: str) -> list[str]:
        """All that are joined with it."""
        return [one for one, line in self.ends.items() if line == self.ends.get(who) and one in self.places]

    def start(self) -> None:
        box = self.choose(tuple(self.started))
        if not self.started[box] and all(name in self.ends for name, place in self.places.items() if place == box):
            self.start_in(box)

    def stop(self) -> None:
        box = self.choose(tuple(self.started))
        self.steps.append(s.Stop(box))
        self.started[box] = False

    def restart(self) -> None:
        box = self.choose(tuple(self.started))
        if self.started[box]:
            self.steps += [s.Stop(box), s.Start(box)]

    def list_members(self) -> None:
        self.steps.append(s.GetComponents(self.choose(tuple(self.started))))

    def remove_end(self) -> None:
        """Only in a container that is not started, because a started component needs its connections."""
        idle = self.idle(self.ends)
        if idle:
            name = self.choose(idle)
            port = "out.api" if name in self.pushes else "in.api"
            self.steps.append(s.Detach(self.ends.pop(name), name, port, self.places[name]))

    def add_end(self) -> None:
        loose = self.idle([name for name in self.places if name not in self.ends])
        if loose:
            name = self.choose(loose)
            kind = self.components[name].ports["out.api" if name in self.pushes else "in.api"]
            self.ends[name] = self.choose([line for line, of in self.lines.items() if of == kind])
            self.steps.append(self.attachment(name))

    def remove(self) -> None:
        loose = self.idle([name for name in self.places if name not in self.ends])
        if loose:
            name = self.choose(loose)
            self.steps.append(s.RemoveComponent(name, self.places.pop(name)))
            self.pushes.pop(name, None)
            self.come.pop(name, None)

    def idle(self, names: Iterable[str]) -> list[str]:
        return [name for name in names if name in self.places and not self.started[self.places[name]]]
