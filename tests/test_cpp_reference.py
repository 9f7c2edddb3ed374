"""How the C++ reference framework reads what the text leaves open."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from cpp_builds import CONNECTED, PAIR, Builds, story

from ucm_cts.adapters.contract import scenario as s

RAISES: Callable[[s.Hook], s.Declaration] = lambda hook: s.Declaration(("p_e",), plan={hook: (s.RaiseError(),)})

READINGS: dict[str, tuple[dict[str, s.Declaration], tuple[s.Step, ...], str]] = {
    "a failed on_startup shuts down those already started": (
        {**PAIR, "B": RAISES("on_startup")},
        (*CONNECTED, s.AddComponent("B"), s.Start(), s.Stop(), s.AddComponent("P", bind="again")),
        "on_startup P, on_startup C, on_startup B, on_shutdown C, on_shutdown P, start: UCM_ERROR, stop: ok, "
        "on_init P2, add_component: ok",
    ),
    "a failed on_shutdown does not spare the others": (
        {**PAIR, "B": RAISES("on_shutdown")},
        (s.AddComponent("P"), s.AddComponent("B"), s.Start(), s.Stop(), s.Stop()),
        "on_startup P, on_startup B, start: ok, on_shutdown B, on_shutdown P, stop: UCM_ERROR, stop: ok",
    ),
    "a failed on_init leaves nothing": (
        {"B": RAISES("on_init")},
        (s.AddComponent("B"), s.Start(), s.GetComponents()),
        "on_init B, add_component: UCM_ERROR, start: ok, get_components: ok",
    ),
    "a failed on_remove removes": (
        {"B": RAISES("on_remove")},
        (s.AddComponent("B"), s.RemoveComponent("B"), s.RemoveComponent("B")),
        "on_remove B, remove_component: UCM_ERROR, remove_component: NOT_FOUND",
    ),
    "starting needs all connections": (
        PAIR,
        (s.AddComponent("P"), s.AddComponent("C"), s.Start(), s.Stop()),
        "start: UCM_ERROR, stop: ok",
    ),
    "nothing is configured after start": (
        PAIR,
        (*CONNECTED, s.Start(), s.Start(), s.AddComponent("P", bind="q"), s.Disconnect("k"), s.RemoveComponent("C")),
        "on_startup P, on_startup C, start: ok, start: ok, add_component: UCM_ERROR, disconnect: UCM_ERROR, "
        "remove_component: UCM_ERROR",
    ),
    "a provider in use stays, a client takes its connections along": (
        PAIR,
        (*CONNECTED, s.RemoveComponent("P"), s.RemoveComponent("C"), s.Disconnect("k"), s.RemoveComponent("P")),
        "remove_component: UCM_ERROR, on_disconnect C, on_remove C, remove_component: ok, disconnect: NOT_FOUND, "
        "on_remove P, remove_component: ok",
    ),
    "wrong arguments of connect": (
        PAIR,
        (
            *CONNECTED,
            s.Connect("C", "r_e", "ref", "x"),
            s.Connect("C", "r_e", "nil", "x"),
            s.Connect("C", "q", "ref", "x"),
            s.Connect("P", "p_e", "ref", "x"),
            s.Connect("unknown", "r_e", "ref", "x"),
            s.GetPortElement("C", "r_e", "x"),
        ),
        "connect: UCM_ERROR, connect: BAD_PARAMETER, connect: BAD_PARAMETER, connect: BAD_PARAMETER, connect: NOT_FOUND, "
        "get_port_element: NOT_FOUND",
    ),
    "removing a container undoes what leads into it": (
        PAIR,
        (
            s.CreateContainer("sub"),
            s.AddComponent("P", container="sub"),
            s.AddComponent("P", container="sub", bind="P2"),
            s.GetPortElement("P", "p_e", "ref", container="sub"),
            s.AddComponent("C"),
            s.Connect("C", "r_e", "ref", "k"),
            s.Start(container="sub"),
            s.RemoveContainer("sub"),
            s.RemoveContainer("sub"),
            s.Disconnect("k"),
            s.Start(),
        ),
        "on_startup P, on_startup P2, start: ok, on_shutdown P2, on_shutdown P, on_disconnect C, on_remove P2, "
        "on_remove P, remove_container: ok, remove_container: NOT_FOUND, disconnect: NOT_FOUND, start: UCM_ERROR",
    ),
    "destroy ends everything": (
        PAIR,
        (
            *CONNECTED,
            s.CreateContainer("sub"),
            s.AddComponent("P", container="sub", bind="q"),
            s.Start(),
            s.Start(container="sub"),
            s.Destroy(),
            s.GetComponents(),
            s.Start(container="sub"),
            s.Destroy(),
        ),
        "on_startup P, on_startup C, start: ok, on_startup P2, start: ok, on_shutdown P2, on_shutdown C, on_shutdown P, "
        "on_disconnect C, on_remove P2, on_remove C, on_remove P, destroy: ok, get_components: UCM_ERROR, "
        "start: UCM_ERROR, destroy: UCM_ERROR",
    ),
    "not everything that is asked for exists": (
        PAIR,
        (
            s.AddComponent("nobody"),
            s.RemoveContainer("nil"),
            s.RemoveContainer("manager"),
            s.RemoveComponent("unknown"),
        ),
        "add_component: UCM_ERROR, remove_container: NOT_FOUND, remove_container: NOT_FOUND, remove_component: NOT_FOUND",
    ),
}


@pytest.mark.parametrize("reading", READINGS)
def test_readings_of_the_reference_framework(builds: Builds, reading: str) -> None:
    components, steps, expected = READINGS[reading]
    told = ", ".join(story(builds.reference, s.Scenario(components, steps)))
    assert told.endswith(expected), told
