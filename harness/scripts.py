"""Scenario scripts: the files under suite/scenarios, and saved scenarios, in one format (docs/scenarios.md)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, Declaration, Hook, Scenario, Step, Value
from ucm_cts.harness.documents import DocumentError, read, read_lines
from ucm_cts.harness.probes import ProbeType, load_probe_types

SCENARIOS = Path(__file__).parent.parent / "suite" / "scenarios"


class Part(Value, frozen=True):
    """A component of a script: a ``probe`` of the models with a plan, or, in saved scenarios, its ports spelled out."""

    probe: str = ""
    provides: tuple[str, ...] = ()
    requires: tuple[str, ...] = ()
    attributes: dict[str, str] = {}
    connectable: bool = False
    fragment: bool = False
    plan: dict[Hook, tuple[Action, ...]] = {}


class Script(Value, frozen=True):
    """One scenario as a person writes it: its name, its test purpose, the requirements it means to exercise."""

    scenario: str
    components: dict[str, Part]
    steps: tuple[Step, ...]
    purpose: str = ""
    exercises: tuple[str, ...] = ()
    patience: int = 2000


@dataclass(frozen=True)
class TestPurpose:
    """What one test node checks: scenarios that provoke the situation ``text`` describes.

    ``clause`` groups purposes; ``requirements`` are those the scenarios mean to exercise. Rules of others watch too.
    """

    __test__ = False

    id: str
    clause: str
    text: str
    requirements: tuple[str, ...]
    scenarios: tuple[tuple[str, Scenario], ...]


def load_scripts(directory: Path = SCENARIOS) -> list[Script]:
    """All scripts of the suite, file by file in alphabetical order. Raises ``DocumentError`` with file and line."""
    scripts: list[Script] = []
    seen: dict[str, Path] = {}
    for path in sorted(directory.glob("*.yaml")):
        for script in read_scripts(path):
            if script.scenario in seen:
                raise DocumentError(path, None, f"scenario '{script.scenario}' is also in {seen[script.scenario]}")
            seen[script.scenario] = path
            scripts.append(script)
    return scripts


def read_scripts(path: Path) -> list[Script]:
    """The script, or list of scripts, in the file at ``path``. Raises ``DocumentError`` with file and line."""
    raw, lines = read_lines(path)
    many = isinstance(raw, list)
    scripts = read(path, list[Script]) if many else [read(path, Script)]
    if not scripts:
        raise DocumentError(path, 1, "holds no scenario")
    for index, script in enumerate(scripts):
        place = f"$[{index}]" if many else "$"
        for where, problem in problems(script):
            raise DocumentError(path, lines.get(f"{place}{where}", lines.get(place)), problem)
    return scripts


def to_scenario(script: Script, probes: dict[str, ProbeType] | None = None) -> Scenario:
    """The scenario that a script stands for, probes replaced by their ports."""
    probes = probes or load_probe_types()
    components = {}
    for name, part in script.components.items():
        probe = probes.get(part.probe)
        components[name] = Declaration(
            provides=probe.provides if probe else part.provides,
            requires=probe.requires if probe else part.requires,
            attributes=part.attributes,
            connectable=part.connectable,
            fragment=part.fragment,
            plan=part.plan,
        )
    return Scenario(components, script.steps, script.patience)


def problems(script: Script, probes: dict[str, ProbeType] | None = None) -> list[tuple[str, str]]:
    """What a schema cannot say: (place in the script, what is wrong and how to mend it)."""
    probes = probes or load_probe_types()
    found: list[tuple[str, str]] = []
    for name, part in script.components.items():
        where = f".components.{name}"
        if name in (s.MANAGER, s.UNKNOWN, s.NIL):
            found.append((where, f"'{name}' is reserved; choose another name"))
        if part.probe and part.probe not in probes:
            found.append((f"{where}.probe", f"no probe '{part.probe}'; there are {', '.join(sorted(probes))}"))
        elif part.probe:
            unknown = [a for a in part.attributes if a not in probes[part.probe].attributes]
            if unknown:
                found.append((f"{where}.attributes", f"probe '{part.probe}' has no attribute '{unknown[0]}'"))
    bound = {s.MANAGER, s.UNKNOWN, s.NIL}
    workers: set[str] = set()
    gates = {
        a.gate
        for p in script.components.values()
        for acts in p.plan.values()
        for a in acts
        if isinstance(a, s.HoldAtGate)
    }
    for index, step in enumerate(script.steps):
        where = f".steps[{index}]"
        for variable in used_by(step):
            if variable not in bound:
                found.append(
                    (where, f"'{variable}' is not bound by an earlier step; there are {', '.join(sorted(bound))}")
                )
        if isinstance(step, s.OpenGate | s.ReachGate) and step.gate not in gates:
            found.append(
                (where, f"no plan holds at gate '{step.gate}'; there are {', '.join(sorted(gates)) or 'none'}")
            )
        if isinstance(step, s.Join) and step.worker not in workers:
            found.append((where, f"no earlier step runs on thread '{step.worker}'"))
        if step.thread:
            workers.add(step.thread)
        bound.update(bound_by(step))
    return found


def used_by(step: Step) -> tuple[str, ...]:
    """The variables a step reads."""
    match step:
        case s.RemoveComponent() | s.GetPortElement():
            return step.container, step.id
        case s.Connect():
            return step.container, step.id, step.to
        case s.Disconnect():
            return step.container, step.connection
        case s.AddComponent() | s.Start() | s.Stop() | s.GetComponents() | s.RemoveContainer():
            return (step.container,)
        case s.Invoke():
            return (step.ref,)
        case _:
            return ()


def bound_by(step: Step) -> tuple[str, ...]:
    """The variables a step binds."""
    match step:
        case s.AddComponent():
            return (step.bind or step.component,)
        case s.GetPortElement() | s.Connect() | s.CreateContainer():
            return (step.bind,)
        case _:
            return ()
