"""What the model looks up in indexes is what a search of everything finds."""

from __future__ import annotations

import random

import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.reference_models.model.prediction import Prediction
from ucm_cts.reference_models.model.row_selection import RowSelection

COMPONENTS = {
    "client": s.Declaration(("in",), ("out", "more")),
    "server": s.Declaration(("in",)),
    "fragment": s.Declaration(("in",), fragment=True),
}


def _step(draw: random.Random, number: int) -> s.ContainerCall:
    """Any operation on one of a few variables, which need not hold anything."""
    container, name, other = draw.choice([s.MANAGER, "box"]), f"c{draw.randrange(6)}", f"r{draw.randrange(6)}"
    steps: list[s.ContainerCall] = [
        s.AddComponent(draw.choice(list(COMPONENTS)), container, bind=name),
        s.AddComponent("client", container, bind=name),
        s.GetPortElement(name, "in", other, container),
        s.Connect(name, draw.choice(["out", "more"]), other, f"k{number % 7}", container),
        s.Connect(name, "out", other, f"k{number % 7}", container),
        s.Disconnect(f"k{draw.randrange(7)}", container),
        s.RemoveComponent(name, container),
        s.Start(container),
        s.Stop(container),
    ]
    return draw.choice(steps)


def _check(model: Prediction) -> None:
    runtime = model.runtime
    everything = list(runtime.all_connections())
    everyone = [member for container in runtime.containers.values() for member in container.members]
    for number in {connection.id for connection in everything} | {0}:
        assert [*runtime.remembered.with_id(number)] == [c for c in everything if c.id == number]
    for member in everyone:
        assert {*runtime.remembered.leading_to([member])} == {c for c in everything if c.leads_to({id(member)})}
        clients = [(m, [c for c in m.connections if c.live and c.provider is member]) for m in runtime.present]
        assert runtime.clients_of([member]) == [(m, used) for m, used in clients if used and m is not member]
    assert {*runtime.inhabited} == {c for c in runtime.containers.values() if any(not m.gone for m in c.members)}
    for container in runtime.containers.values():
        standing = {c for c in everything if c.live is not False and c.client.container is container}
        assert {*runtime.remembered.newest_in(container)} == standing
        assert {*container.served} == {member for member in container.members if member.served and not member.gone}
        live = [member for member in container.members if not member.gone]
        assert [*container.live_members()] == live
        for member in live:
            assert [*container.present.with_id(member.id)] == [m for m in live if m.id == member.id]
        for fragment in (False, True):
            others = [m for m in live if m.declaration.fragment != fragment]
            assert container.present.has_other_kind(fragment) == bool(others)


@pytest.mark.parametrize("seed", range(5))
def test_indexes_follow_the_model(seed: int) -> None:
    draw = random.Random(seed)
    model = Prediction(RowSelection(load_life_cycle()), COMPONENTS)
    model.perform(s.CreateContainer("box"))
    connected = 0
    for number in range(300):
        model.perform(_step(draw, number))
        if number % 10 == 0 and model.runtime.present:
            draw.choice([*model.runtime.present]).serve()
        _check(model)
        connected = max(connected, len([*model.runtime.all_connections()]))
        if number % 50 == 25:
            before, model = model, model.fork()
            model.perform(_step(draw, number))
            _check(before)
            _check(model)
    assert connected > 2
