"""The labels of a diagram: steps, callbacks and values, in the names of the scenario."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.trace import Enter, Exit, MaybeReference, Reference, Reply, Request
from ucm_cts.adapters.contract.traits import Kind
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Execution

Answered = int | tuple[int, ...] | Reference | str | None


def body_key(component: str, instance: int) -> str:
    """The key of the lane of a body."""
    return f"{component}#{instance}"


class Wording:
    """Makes the labels of one execution. It follows calls, returns and creations to resolve variables."""

    def __init__(self, execution: Execution) -> None:
        self.patience = execution.scenario.patience
        self._steps = execution.scenario.steps
        self._elements: dict[str, s.GetPortElement] = {}
        self._references: dict[str, Reference] = {}
        self._added: dict[str, s.AddComponent] = {}
        self._adds: dict[str, list[str]] = {}
        self._connections: dict[str, s.Connect] = {}
        self._homes: dict[tuple[str, int], str] = {}

    # what happened so far

    def called(self, number: int) -> None:
        """Note that step ``number`` began and binds its variables."""
        match self._step(number):
            case s.AddComponent() as step:
                self._added[step.bind or step.component] = step
                self._adds.setdefault(step.component, []).append(step.container)
            case s.GetPortElement() as step:
                self._elements[step.bind] = step
                self._references.pop(step.bind, None)
            case s.Connect() as step:
                self._connections[step.bind] = step

    def returned(self, number: int, value: Answered) -> None:
        """Note that step ``number`` returned ``value``."""
        step = self._step(number)
        if isinstance(step, s.GetPortElement) and isinstance(value, Reference):
            self._references[step.bind] = value

    def created(self, component: str, instance: int, during: int | None) -> None:
        """Note that a body was created during step ``during``."""
        step = self._step(during) if during is not None else None
        if isinstance(step, s.AddComponent) and step.component == component:
            self._homes[component, instance] = step.container

    def home(self, component: str, instance: int) -> str:
        """The container that most likely holds the body."""
        containers = self._adds.get(component, [])
        guess = containers[min(instance, len(containers)) - 1] if containers else s.MANAGER
        return self._homes.get((component, instance), guess)

    # steps

    def _step(self, number: int) -> s.Step | None:
        return self._steps[number] if 0 <= number < len(self._steps) else None

    def invoked(self, number: int) -> int | None:
        """The value that an ``invoke`` step sends; None for other steps."""
        step = self._step(number)
        return step.value if isinstance(step, s.Invoke) else None

    def reached(self, number: int) -> str | None:
        """The lane that an ``invoke`` step should reach, as far as known."""
        step = self._step(number)
        if not isinstance(step, s.Invoke):
            return None
        known = self._references.get(step.ref)
        if known is not None:
            return body_key(known.component, known.instance)
        element = self._elements.get(step.ref)
        added = self._added.get(element.id) if element else None
        if added is None:
            return None
        return body_key(added.component, max(1, len(self._adds.get(added.component, []))))

    def container(self, number: int) -> str:
        """The container on which the step operates."""
        step = self._step(number)
        if step is None or isinstance(step, s.RemoveContainer | s.CreateContainer | s.Destroy):
            return s.MANAGER
        return getattr(step, "container", s.MANAGER)

    def step(self, number: int) -> str:
        """The operation with its arguments, for instance ``connect client.out_api → provider.in_api``."""
        step = self._step(number)
        if step is None:
            return f"step {number}"
        return one_line(f"{s.operation(step)} {step.words(self._known_as)}".rstrip(), 90)

    def operation(self, number: int) -> str:
        """The operation alone."""
        step = self._step(number)
        return s.operation(step) if step is not None else ""

    def _known_as(self, variable: str, kind: Kind) -> str:
        """References are known by the port element, connections by both of their ends, others by the variable."""
        made = self._connections.get(variable) if kind == "connection" else None
        if made is not None:
            return made.words(self._known_as)
        element = self._elements.get(variable) if kind == "reference" and variable != s.NIL else None
        return variable if element is None else element.words()

    # callbacks and values

    def hook(self, event: Enter) -> str:
        """A callback with its arguments."""
        match event.hook:
            case "on_init":
                arguments = ", ".join(f"{name}={value}" for name, value in (event.attributes or {}).items())
            case "on_startup":
                arguments = ", ".join(
                    f"{dependency.port} → {', '.join(self.reference(r) for r in dependency.references) or 'nothing'}"
                    for dependency in event.dependencies or ()
                )
            case "on_connect":
                arguments = f"{event.port}, {self.reference(event.reference)}"
            case "on_disconnect":
                arguments = event.port or ""
            case "exchange":
                return one_line(f"exchange({event.value}) on {event.port}", 90)
            case "method":
                given = self.listed(self.timer(event.timer), self.data(event.arguments))
                return one_line(f"{event.method}({given}) on {event.port}", 90)
            case _:
                arguments = ""
        return one_line(f"{event.hook}({arguments})", 90)

    def request(self, event: Request) -> str:
        """The call that a body makes."""
        if event.method is None:
            return f"exchange({event.value}) through {event.port}"
        called = f"{event.method}({self.listed(event.handler or '', self.data(event.arguments))})"
        return f"{called} of {self.timer(event.timer)}" if event.timer is not None else f"{called} through {event.port}"

    def outcome(self, event: Exit | Reply) -> str:
        """The result of a call or a hook; empty for none."""
        if event.raised:
            return "an exception"
        if event.exception is not None:
            return one_line(f"{event.exception}({self.data(event.results)})", 90)
        timer = event.timer if isinstance(event, Reply) else None
        shown = self.listed(self.timer(timer), self.data(event.results))
        return self.value(event.value) if event.results is None else one_line(shown, 90)

    @staticmethod
    def timer(number: int | None) -> str:
        """An object timer, by the number of the reference; empty for none."""
        return f"reference {number}" if number is not None else ""

    @staticmethod
    def listed(*parts: str) -> str:
        """The parts that are there."""
        return ", ".join(part for part in parts if part)

    @staticmethod
    def data(values: Sequence[Datum] | None) -> str:
        """Values of methods."""
        return ", ".join(one_line(str(value), 60) for value in values or ())

    @staticmethod
    def joined(request: str, port: str) -> str:
        """One label for a request and the provided port element on which it arrived."""
        if " through " in request:
            call, _, required = request.partition(" through ")
            return one_line(f"{call} {required} → {port}", 90)
        return request

    def reference(self, reference: MaybeReference) -> str:
        """A reference in the names of the scenario."""
        if isinstance(reference, Reference):
            number = "" if reference.instance == 1 else f"#{reference.instance}"
            return f"{reference.component}{number}.{reference.port}"
        return "nil" if reference is None else "a reference"

    def value(self, value: Answered) -> str:
        """The value that an operation returned; empty for none."""
        if value is None:
            return ""
        if isinstance(value, tuple):
            return one_line("[" + ", ".join(map(str, value[:20])) + (", …]" if len(value) > 20 else "]"), 90)
        if isinstance(value, Reference):
            return one_line(self.reference(value), 90)
        return "a reference" if isinstance(value, str) else str(value)
