"""A small application that is provoked: a server, the subject and a neighbour; both others are clients of the server.

It is taken to a state; then the operation leads into the callback in which the subject acts, or is refused, and the aftermath
shows what is left of the framework.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Scenario, Step
from ucm_cts.harness.purposes.provocations.dimensions import Cell
from ucm_cts.harness.purposes.provocations.possible import possible

_GATE, _SECOND = "inside", "second box"
_SERVER, _SUBJECT, _NEIGHBOUR, _OTHER, _TWIN = "server", "subject", "neighbour", "other", "twin"
_PATIENCE = 2000
_CYCLE, _RUNNING, _JOINED = "started and stopped", "started", "connected"
_PASTS: dict[str, frozenset[str]] = {
    "nothing": frozenset(),
    "connect": frozenset((_JOINED,)),
    "start": frozenset((_JOINED, _RUNNING)),
    "stop": frozenset((_JOINED, _CYCLE)),
    "restart": frozenset((_JOINED, _CYCLE, _RUNNING)),
}
"""What the application has been through, by the name that ``suite/provocations.yaml`` gives it."""

_REPEATED = ("on_startup", "on_shutdown", "on_connect")
"""Callbacks that the past of an application would lead into before the operation does."""

_CALL = s.CallPort("out.api", 4)


class Application:
    """The application of one ``cell``. What is held goes on after ``pause`` milliseconds, or at once."""

    def __init__(self, cell: Cell, pause: int = 0) -> None:
        self.cell = cell
        self.pause = pause
        self.home = "box" if cell.place == "box" else s.MANAGER
        plan = {cell.entrance.hook: cell.action.plan} if cell.entrance.hook else {}
        sound = Declaration(("in.api",), ("out.api",), {"label": "12", "level": "low"}, True, cell.kind == "fragment")
        self.components = {
            _SERVER: Declaration(("in.api",)),
            _SUBJECT: msgspec.structs.replace(sound, plan=plan),
            _NEIGHBOUR: Declaration(("in.api",), ("out.api",), connectable=True, plan={"exchange": (_CALL,)}),
            _OTHER: sound,
        }
        others = [_SERVER, _NEIGHBOUR]
        others.insert({"first": 0, "between": 1, "last": 2}[cell.position], _SUBJECT)
        self.order = others

    def scenario(self) -> Scenario:
        """Set up, operate, see what is left."""
        steps = (*self._set_up(), *self._operate(), *self._complete(), *self._afterwards())
        return Scenario(self.components, possible(steps, self.components), _PATIENCE)

    # the way to the entrance

    def _set_up(self) -> Iterator[Step]:
        """Take the application to where the operation leads into the callback, which nothing does earlier."""
        by, past, home = self.cell.entrance.by, _PASTS[self.cell.entrance.after], self.home
        if home != s.MANAGER:
            yield s.CreateContainer(home)
        yield from map(self._add, self.early)
        if _JOINED in past:
            yield from (step for name in self.early if name != _SERVER for step in self._connect(name))
        if _CYCLE in past:
            yield from (s.Start(home), s.Stop(home))
        if _SUBJECT not in self.early and by != "add_component":
            yield self._add(_SUBJECT)
            if by != "connect":
                yield from self._connect(_SUBJECT)
        if _RUNNING in past:
            yield s.Start(home)
        if by == "invoke":
            yield self._look_up(_SUBJECT)
        if self.cell.entrance.step is not None and _JOINED not in past:
            yield self._look_up(_SERVER)

    @property
    def early(self) -> list[str]:
        """Those that have the whole past, in order."""
        entrance = self.cell.entrance
        if entrance.by == "add_component":
            return self.order[: self.order.index(_SUBJECT)]
        joins_late = entrance.hook in _REPEATED and _CYCLE in _PASTS[entrance.after]
        return [name for name in self.order if not (joins_late and name == _SUBJECT)]

    def _complete(self) -> Iterator[Step]:
        """Add those that are not there yet."""
        yield from (self._add(name) for name in self.order if name not in (*self.early, _SUBJECT))

    def _operate(self, number: int = 1) -> tuple[Step, ...]:
        """The operation; where the subject is held, on a worker, until it has been seen inside."""
        if not any(isinstance(action, s.HoldAtGate) for action in self.cell.action.plan):
            return self._operation(number)
        worker = f"operator {number}"
        operation = tuple(msgspec.structs.replace(step, thread=worker) for step in self._operation(number))
        pause = (s.Pause(self.pause),) if self.pause else ()
        return (
            *operation,
            s.ReachGate(_GATE) if pause else s.Settle(worker),
            *pause,
            s.OpenGate(_GATE),
            s.Join(worker),
        )

    def _operation(self, number: int) -> tuple[Step, ...]:
        refused = self.cell.entrance.step
        if refused is not None:
            in_box = not isinstance(refused, s.CreateContainer | s.RemoveContainer | s.Destroy)
            return (msgspec.structs.replace(refused, container=self.home) if in_box else refused,)
        match self.cell.entrance.by:
            case "add_component":
                return (s.AddComponent(_SUBJECT, self.home, _SUBJECT if number == 1 else f"{_SUBJECT} {number}"),)
            case "connect":
                return self._connect(_SUBJECT, number)
            case "disconnect":
                return (s.Disconnect(_link(_SUBJECT), self.home),)
            case "remove_component":
                return (s.RemoveComponent(_SUBJECT, self.home),)
            case "remove_container":
                return (s.RemoveContainer(self.home),)
            case "start":
                return (s.Start(self.home),)
            case "stop":
                return (s.Stop(self.home),)
            case "invoke":
                return (s.Invoke(_reference(_SUBJECT), number),)
            case _:
                return (s.Destroy(),)

    def _add(self, name: str) -> Step:
        return s.AddComponent(name, self.home)

    def _look_up(self, name: str, home: str = "") -> Step:
        return s.GetPortElement(name, "in.api", _reference(name), home or self.home)

    def _connect(self, client: str, number: int = 1) -> tuple[Step, ...]:
        bind = _link(client) if number == 1 else f"{_link(client)} {number}"
        goal = _reference(_SERVER)
        return self._look_up(_SERVER), s.Connect(client, "out.api", goal, bind, self.home)

    # the aftermath

    def _afterwards(self) -> tuple[Step, ...]:
        if self.cell.entrance.by == "destroy":
            return ()
        if self.cell.entrance.by == "remove_container":
            return self._without_container()
        home = self.home
        match self.cell.aftermath:
            case "the same again":
                return (*self._operation(2), s.GetComponents(home))
            case "undo and redo":
                return (*self._undone(), *self._operation(2), s.GetComponents(home))
            case "the same again and redo":
                return (*self._operation(2), *self._undone(), *self._operation(3), s.GetComponents(home))
            case "start and stop":
                return (s.Start(home), s.Stop(home), s.Start(home), s.Stop(home), s.GetComponents(home))
            case "complete it":
                links = tuple(step for name in self.order if name != _SERVER for step in self._connect(name, 3))
                calls = tuple(s.Invoke(_reference(name), number) for number, name in enumerate(self.order))
                return (*links, s.Start(home), *map(self._look_up, self.order), *calls, s.Stop(home))
            case "another container":
                return (s.CreateContainer(_SECOND), *self._another(_SECOND), s.RemoveContainer(_SECOND))
            case "use all":
                calls = tuple(s.Invoke(_reference(name), number) for number, name in enumerate(self.order))
                return (s.Start(home), *map(self._look_up, self.order), *calls, s.Stop(home))
            case "go on without it":
                return (
                    s.Stop(home),
                    s.Disconnect(_link(_SUBJECT), home),
                    s.RemoveComponent(_SUBJECT, home),
                    *self._another(home),
                    s.GetComponents(home),
                )
            case "remove all":
                links = (s.Disconnect(_link(_NEIGHBOUR), home), s.Disconnect(_link(_SUBJECT), home))
                removals = tuple(s.RemoveComponent(name, home) for name in reversed(self.order))
                return (s.Stop(home), *links, *removals, s.GetComponents(home))
            case "another one":
                return (*self._another(home), s.GetComponents(home))
            case _:
                return (s.Destroy(),)

    def _undone(self) -> tuple[Step, ...]:
        home = self.home
        match self.cell.entrance.by:
            case "add_component":
                return (s.RemoveComponent(_SUBJECT, home),)
            case "connect":
                return (s.Disconnect(_link(_SUBJECT), home),)
            case "disconnect":
                return self._connect(_SUBJECT)
            case "remove_component":
                return (s.AddComponent(_SUBJECT, home), *self._connect(_SUBJECT))
            case "start":
                return (s.Stop(home),)
            case "stop":
                return (s.Start(home),)
            case _:
                return (s.Stop(home), s.Start(home))

    def _another(self, home: str) -> tuple[Step, ...]:
        """Two sound components are added, connected to each other and used."""
        pair = (_OTHER, _TWIN)
        return (
            *(s.AddComponent(_OTHER, home, name) for name in pair),
            *(self._look_up(name, home) for name in pair),
            s.Connect(_OTHER, "out.api", _reference(_TWIN), _link(_OTHER), home),
            s.Connect(_TWIN, "out.api", _reference(_OTHER), _link(_TWIN), home),
            s.Start(home),
            *(s.Invoke(_reference(name), 5 + number) for number, name in enumerate(pair)),
            s.Stop(home),
        )

    def _without_container(self) -> tuple[Step, ...]:
        """The sub-container has been removed, or its removal has failed: the rest of the runtime is used.

        Only a further removal shows whether it is gone.
        """
        again = s.RemoveContainer(self.home)
        match self.cell.aftermath:
            case "the same again":
                return (again, again, *self._another(s.MANAGER), s.GetComponents())
            case "undo and redo":
                return (again, s.CreateContainer(_SECOND), *self._another(_SECOND), s.RemoveContainer(_SECOND))
            case "start and stop":
                return (s.Start(), s.Stop(), s.GetComponents())
            case "destroy":
                return (s.Destroy(),)
            case "another one":
                return (again, *self._another(s.MANAGER), s.GetComponents())
            case _:
                return (*self._another(s.MANAGER), s.GetComponents())


def _reference(name: str) -> str:
    return f"to {name}"


def _link(name: str) -> str:
    return f"link of {name}"
