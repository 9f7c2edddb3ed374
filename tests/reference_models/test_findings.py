"""What every finding has: another observation than expected, and a name of what it is about. Tests of mutants look at all of theirs."""

from __future__ import annotations

import random
from collections.abc import Iterator

import msgspec
import pytest
from made_up_run import Tape
from performing import answer
from pipeline import check_wording

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.mutants.python.subjects import CONTAINER, MUTANTS, Mutant
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.purposes.payloads import Payloads
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

SEED = 15
SOME = 8
"""So many mutants are sampled."""

EACH = 12
"""Of a mutant's scenarios one of so many is run."""

SHORT = 0.2
"""Of the patience of scenarios: what a mutant never does is not waited for longer."""


def traces_of(mutant: Mutant, each: int) -> Iterator[tuple[Scenario, Trace]]:
    """What the mutant does in some of the scenarios of its clauses."""
    profile = "container" if mutant.clauses == CONTAINER else "core"
    purposes = load_purposes(profile, *map("=".join, mutant.readings.items()))
    cases = [case for p in purposes if p.clause.startswith(mutant.clauses) for _, case in p.scenarios]
    payloads = Payloads(SEED)
    for plain in cases[len(mutant.name) % each :: each]:
        if any(isinstance(a, s.Burst) for d in plain.components.values() for plan in d.plan.values() for a in plan):
            continue
        asked = payloads.deal(msgspec.structs.replace(plain, patience=int(plain.patience * SHORT)))
        reply = answer(asked, mutant.adapter)
        if isinstance(reply, Traced):
            yield asked, reply.events


@pytest.mark.parametrize("name", random.Random(SEED).sample(sorted(MUTANTS), SOME))
def test_findings_about_some_wrong_frameworks_are_well_said(name: str) -> None:
    mutant = MUTANTS[name]
    monitor = Monitor(load_life_cycle(), Ics(mutant.readings))
    for scenario, trace in traces_of(mutant, EACH):
        check_wording(scenario, monitor.judge(scenario, trace).findings)


def test_null_that_was_connected_is_rightly_told() -> None:
    """get_port_element gave null, connect took it, and on_connect is told null: that is no fault of on_connect."""
    scenario = Scenario(
        {"server": s.Declaration(provides=("in",)), "client": s.Declaration(requires=("out",), connectable=True)},
        (
            s.AddComponent("server"),
            s.AddComponent("client"),
            s.GetPortElement("server", "in", "api"),
            s.Connect("client", "out", "api", "line"),
        ),
    )
    events: list[t.Event] = []

    def put(event: t.Event) -> None:
        events.append(msgspec.structs.replace(event, n=len(events) + 1, t=len(events)))

    for step, component in enumerate(("server", "client")):
        put(t.Call(0, 0, 0, step))
        put(t.Create(0, 0, 0, component, 1))
        put(t.Enter(0, 0, 0, component, 1, "on_init", attributes={}))
        put(t.Exit(0, 0, 0, component, 1, "on_init"))
        put(t.Return(0, 0, 0, step, step + 1))
    put(t.Call(0, 0, 0, 2))
    put(t.Return(0, 0, 0, 2, None))
    put(t.Call(0, 0, 0, 3))
    put(t.Enter(0, 0, 0, "client", 1, "on_connect", "out"))
    put(t.Exit(0, 0, 0, "client", 1, "on_connect"))
    put(t.Return(0, 0, 0, 3, 9))
    findings = Monitor(load_life_cycle()).judge(scenario, events).findings
    assert [finding.rule for finding in findings] == ["port_element_identity"]
    check_wording(scenario, findings)


def test_operations_of_a_destroyed_runtime_are_not_judged() -> None:
    scenario = Scenario({}, (s.Destroy(), s.GetComponents()))
    trace = (
        t.Call(1, 1, 0, 0),
        t.Return(2, 2, 0, 0),
        t.Call(3, 3, 0, 1),
        t.Raise(4, 4, 0, 1, "UNDECLARED", "KeyError"),
    )
    assert Monitor(load_life_cycle()).judge(scenario, trace).findings == []


def test_a_call_after_destroy_is_no_matter_of_stop() -> None:
    scenario = Scenario(
        {"a": s.Declaration(provides=("in",))}, (s.AddComponent("a"), s.Start(), s.Destroy(), s.Pause(1))
    )
    story = Tape()
    story.put(t.Call, step=0)
    story.put(t.Create, component="a", instance=1)
    story.hook("a", "on_init", attributes={})
    story.put(t.Return, step=0, value=1)
    for step, hooks in ((1, ("on_startup",)), (2, ("on_shutdown", "on_remove"))):
        story.put(t.Call, step=step)
        for hook in hooks:
            story.hook("a", hook, **({"dependencies": ()} if hook == "on_startup" else {}))
        story.put(t.Return, step=step)
    story.put(t.Enter, thread=1, component="a", instance=1, hook="exchange", port="in", value=1)
    story.put(t.Exit, thread=1, component="a", instance=1, hook="exchange", value=~1)
    (finding,) = Monitor(load_life_cycle()).judge(scenario, story.trace()).findings
    assert (finding.requirement, finding.rule) == ("R-11.2.2.2-06", "nothing_after_stop")
