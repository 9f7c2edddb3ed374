"""Scenario scripts: the files under suite/scenarios, and saved scenarios, in one format (docs/scenarios.md)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType, Interface, message_interface
from ucm_cts.adapters.contract.platform_interfaces import PARAMETERS, connector_of, named_interfaces
from ucm_cts.adapters.contract.scenario import Action, Declaration, Hook, Policy, Scenario, Step
from ucm_cts.adapters.contract.traits import bindings, named, uses
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, read, read_lines
from ucm_cts.harness.purposes.probes import ProbeType, load_probe_types
from ucm_cts.harness.purposes.script_values import value_problems

SCENARIOS = Path(__file__).parents[2] / "suite" / "scenarios"


class Part(Value, frozen=True):
    """A component of a script.

    ``probe``: its type in the probe models; saved scenarios spell out the ports instead.
    ``provides``: provided port elements.
    ``requires``: required port elements.
    ``attributes``: configured values by attribute name.
    ``connectable``: the body implements Connectable.
    ``handlers``: its handlers of object timers.
    ``fragment``: the body implements FragmentObject.
    ``plan``: the actions of the body in each hook.
    ``policies``: technical policies.
    ``ports``: the interface of each port element that has one, by name.
    ``defaults``: default values by attribute name; they hold for attributes that are not configured.
    """

    probe: str = ""
    provides: tuple[str, ...] = ()
    requires: tuple[str, ...] = ()
    attributes: dict[str, str] = {}
    connectable: bool = False
    handlers: tuple[str, ...] = ()
    fragment: bool = False
    plan: dict[Hook, tuple[Action, ...]] = {}
    policies: tuple[Policy, ...] = ()
    ports: dict[str, str] = {}
    defaults: dict[str, str] = {}


class Script(Value, frozen=True):
    """One scenario as a person writes it.

    ``scenario``: its name.
    ``components``: by name.
    ``steps``: in order.
    ``purpose``: its test purpose, one sentence.
    ``exercises``: the requirements that it is meant to exercise.
    ``patience``: how long a wait step may wait, in milliseconds.
    ``interfaces``: by name.
    ``messages``: types by name, for further interfaces: message_intf (10.1.6.2), bound to the type.
    ``types``: what connectors of 10.4 are bound to, by name, for further interfaces ``name.interface`` of 10.4.
    ``may_stay``: workers that need not return.
    ``under``: conditions on the vendor's readings, as in ``TestPurpose``.
    """

    scenario: str
    components: dict[str, Part]
    steps: tuple[Step, ...]
    purpose: str = ""
    exercises: tuple[str, ...] = ()
    patience: int = 2000
    interfaces: dict[str, Interface] = {}
    messages: dict[str, AnyType] = {}
    types: dict[str, dict[str, AnyType]] = {}
    may_stay: tuple[str, ...] = ()
    under: tuple[str, ...] = ()


@dataclass(frozen=True)
class TestPurpose:
    """A test purpose: scenarios that provoke one situation. One node of the test run.

    ``id``: its name.
    ``clause``: groups purposes.
    ``text``: the situation, one sentence.
    ``requirements``: those that the scenarios are meant to exercise; properties of others are checked too.
    ``scenarios``: with their names.
    ``draw``: the same scenarios with values drawn from a seed, within the vendor's readings.
    ``under``: only for vendors with these readings: ``option=value``, or several values with ``|`` between them.
    ``of_dimensions``: derived from the tables of dimensions (``suite/provocations.yaml`` and its like).
    """

    __test__ = False

    id: str
    clause: str
    text: str
    requirements: tuple[str, ...]
    scenarios: tuple[tuple[str, Scenario], ...]
    draw: Callable[[int, Mapping[str, str]], tuple[tuple[str, Scenario], ...]] | None = None
    under: tuple[str, ...] = ()
    of_dimensions: bool = False


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


def read_scripts(path: Path, may_overlap: bool = False) -> list[Script]:
    """The script, or list of scripts, in the file at ``path``. Raises ``DocumentError`` with file and line.

    ``may_overlap``: whether operations of containers may overlap, as they do in derived scenarios of contention.
    """
    raw, lines = read_lines(path)
    many = isinstance(raw, list)
    scripts = read(path, list[Script]) if many else [read(path, Script)]
    if not scripts:
        raise DocumentError(path, 1, "holds no scenario")
    for index, script in enumerate(scripts):
        place = f"$[{index}]" if many else "$"
        overlapping = [] if may_overlap else _overlapping(script)
        for where, problem in (*problems(script), *overlapping):
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
            handlers=part.handlers,
            fragment=part.fragment,
            plan=part.plan,
            policies=part.policies,
            ports=part.ports,
            defaults=part.defaults,
        )
    return Scenario(components, script.steps, script.patience, _interfaces_of(script), script.may_stay, script.types)


def _interfaces_of(script: Script) -> dict[str, Interface]:
    found = script.interfaces | {name: message_interface(of) for name, of in script.messages.items()}
    for name, types in script.types.items():
        if connector_of(types) is not None:
            found |= named_interfaces(name, types)
    return found


def problems(script: Script, probes: dict[str, ProbeType] | None = None) -> list[tuple[str, str]]:
    """What a schema cannot say: (place in the script, what is wrong and how to mend it)."""
    probes = probes or load_probe_types()
    found: list[tuple[str, str]] = []
    interfaces = _interfaces_of(script)
    found += [
        (f".types.{name}", f"no connector of 10.4 is bound to {_list(types)}; there are {_list_of_parameters()}")
        for name, types in script.types.items()
        if connector_of(types) is None
    ]
    for name, part in script.components.items():
        where = f".components.{name}"
        if name in (s.MANAGER, s.UNKNOWN, s.NIL):
            found.append((where, f"'{name}' is reserved; choose another name"))
        if part.probe and part.probe not in probes:
            found.append((f"{where}.probe", f"no probe '{part.probe}'; there are {', '.join(sorted(probes))}"))
        elif part.probe:
            unknown = [a for a in (*part.attributes, *part.defaults) if a not in probes[part.probe].attributes]
            if unknown:
                found.append((f"{where}.attributes", f"probe '{part.probe}' has no attribute '{unknown[0]}'"))
        strange = [i for i in part.ports.values() if i not in interfaces]
        if strange:
            found.append((f"{where}.ports", f"no interface '{strange[0]}'; there are {_list(interfaces)}"))
        found += [(where + place, problem) for place, problem in value_problems(part.ports, part.plan, interfaces)]
    bound = {s.MANAGER: "container"}
    workers: set[str] = set()
    actions = [a for p in script.components.values() for plan in p.plan.values() for a in plan]
    gates = {a.gate for a in actions if isinstance(a, s.HoldAtGate)}
    for index, step in enumerate(script.steps):
        where = f".steps[{index}]"
        for variable, use in uses(step):
            kind = use.kind
            if variable in (s.UNKNOWN, s.NIL):
                if variable not in use.stand_ins:
                    found.append((where, f"'{variable}' is no {kind} here; name one that an earlier step binds"))
            elif variable not in bound:
                there = ", ".join(sorted(bound))
                found.append((where, f"'{variable}' is not bound by an earlier step; there are {there}"))
            elif bound[variable] != kind:
                found.append((where, f"'{variable}' holds a {bound[variable]}, not a {kind}"))
        for variable, kind in bindings(step):
            if bound.setdefault(variable, kind) != kind:
                found.append(
                    (where, f"'{variable}' holds a {bound[variable]} already; bind the {kind} to another name")
                )
        for gate in named(step, "gate"):
            if gate not in gates:
                found.append((where, f"no plan holds at gate '{gate}'; there are {_list(gates)}"))
        for interface in named(step, "interface"):
            known = script.types if isinstance(step, s.Link) and step.connector in PARAMETERS else interfaces
            if interface not in known:
                found.append((where, f"no interface '{interface}'; there are {_list(known)}"))
        for component in named(step, "component"):
            if component not in script.components:
                found.append((where, f"no component '{component}'; there are {_list(script.components)}"))
        for worker in named(step, "worker"):
            if worker not in workers:
                found.append((where, f"no earlier step runs on thread '{worker}'"))
        if step.thread:
            workers.add(step.thread)
    return found


def _overlapping(script: Script) -> list[tuple[str, str]]:
    still = "may still be operating a container; join it first"
    return [(f".steps[{index}]", f"'{worker}' {still}") for index, worker in overlaps(script.steps)]


def _list_of_parameters() -> str:
    return ", ".join(f"{connector} ({', '.join(names)})" for connector, names in PARAMETERS.items())


def _list(names: Iterable[str]) -> str:
    return ", ".join(sorted(names)) or "none"


def overlaps(steps: tuple[Step, ...]) -> Iterator[tuple[int, str]]:
    """Steps that operate a container while a worker may still do so."""
    busy: set[str] = set()
    for index, step in enumerate(steps):
        if isinstance(step, s.ContainerCall):
            if busy:
                yield index, min(busy)
            busy.update([step.thread] if step.thread else [])
        elif isinstance(step, s.Join):
            busy.discard(step.worker)
