"""The Python reference framework behaves as its text says."""

from __future__ import annotations

from typing import Any

import pytest
from performing import SINK, SOURCE, hooks, outcomes, play

from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

PAIR = ["add_component component=server", "add_component component=client", "get_port_element id=server port=in bind=api",
        "connect id=client port=out to=api bind=link"]  # fmt: skip
FAILS = [{"do": "raise"}]
REFERENCE = [
    ("unknown things", [*PAIR, "get_port_element id=server port=out bind=x", "get_port_element id=client port=out bind=x",
                               "connect id=client port=in to=api bind=x", "connect id=client port=out to=nil bind=x",
                               "connect id=client port=out to=api bind=x", "add_component component=stranger"],
     ["NOT_FOUND", "NOT_FOUND", "BAD_PARAMETER", "BAD_PARAMETER", "UCM_ERROR", "UCM_ERROR"], None),
    ("late configuration", [*PAIR, "start", "add_component component=server", "connect id=client port=out to=api bind=x",
                                   "disconnect connection=link", "remove_component id=client", "start"],
     ["", "UCM_ERROR", "UCM_ERROR", "UCM_ERROR", "UCM_ERROR", ""], ["server.on_startup", "client.on_startup"]),
    ("removal cascades or is refused", [*PAIR, "remove_component id=server", "remove_component id=client",
                                               "remove_component id=server", "get_components"],
     ["UCM_ERROR", "", "", "[]"], ["client.on_disconnect", "client.on_remove", "server.on_remove"]),
    ("unconfigured member", [*PAIR, "disconnect connection=link", "start", "stop", "disconnect connection=link"],
     ["", "UCM_ERROR", "", "NOT_FOUND"], ["client.on_disconnect"]),
    ("restart keeps connections", [*PAIR, "start", "stop", "start", "destroy", "get_components", "destroy"],
     ["", "", "", "", "UCM_ERROR", "UCM_ERROR"],
     ["server.on_startup", "client.on_startup", "client.on_shutdown", "server.on_shutdown", "server.on_startup",
      "client.on_startup", "client.on_shutdown", "server.on_shutdown", "client.on_disconnect", "client.on_remove",
      "server.on_remove"]),
]  # fmt: skip


@pytest.mark.parametrize(
    ("steps", "expected", "called"), [case[1:] for case in REFERENCE], ids=[c[0] for c in REFERENCE]
)
def test_reference_framework(steps: list[str], expected: list[str], called: list[str] | None) -> None:
    trace = play({"server": SINK, "client": SOURCE}, steps)
    results = [line.split("error=")[-1].split("value=")[-1] for line in outcomes(trace)][len(PAIR) :]
    assert [result if not result.startswith("return") else "" for result in results] == expected
    assert called is None or hooks(trace)[3:] == called


@pytest.mark.parametrize(
    ("hook", "steps", "expected", "called"),
    [
        ("on_init", ["get_components"], ["raise", "return step=2 value=[1]"], ["good.on_init", "bad.on_init"]),
        ("on_startup", ["start"], ["return", "raise"],
         ["good.on_startup", "bad.on_startup", "good.on_shutdown"]),
        ("on_shutdown", ["start", "stop"], ["return", "return", "raise"],
         ["good.on_startup", "bad.on_startup", "bad.on_shutdown", "good.on_shutdown"]),
        ("on_remove", ["remove_component id=bad", "get_components"], ["return", "raise", "return step=3 value=[1]"],
         ["bad.on_remove"]),
    ],
)  # fmt: skip
def test_reference_framework_when_a_body_fails(
    hook: str, steps: list[str], expected: list[str], called: list[str]
) -> None:
    trace = play(
        {"good": SINK, "bad": {"plan": {hook: FAILS}}},
        ["add_component component=good", "add_component component=bad", *steps],
    )
    assert all(line.startswith(due) for line, due in zip(outcomes(trace)[1:], expected, strict=True))
    assert not any("UNDECLARED" in line for line in trace)
    assert hooks(trace)[-len(called) :] == called


def test_reference_framework_takes_containers_down_in_order() -> None:
    trace = play(
        {"server": SINK, "client": SOURCE, "own": SOURCE},
        ["create_container bind=box", "add_component component=server container=box",
         "add_component component=own container=box", "add_component component=client",
         "get_port_element id=server port=in container=box bind=api", "connect id=client port=out to=api bind=l1",
         "connect id=own port=out to=api container=box bind=l2", "start container=box", "remove_container container=box",
         "remove_container container=box", "start container=box", "start", "disconnect connection=l1"],
    )  # fmt: skip
    at = hooks(trace).index("own.on_shutdown")
    assert hooks(trace)[at:] == ["own.on_shutdown", "server.on_shutdown", "own.on_disconnect", "client.on_disconnect",
                                 "own.on_remove", "server.on_remove"]  # fmt: skip
    assert [line.partition("error=")[2] for line in outcomes(trace)[-5:]] == ["", "NOT_FOUND", "UCM_ERROR", "UCM_ERROR", "NOT_FOUND"]  # fmt: skip


def test_reference_framework_refuses_calls_from_its_own_callbacks() -> None:
    refused: list[UcmError] = []

    class Restless(ReferenceAdapter):
        def start(self, container: Any) -> None:
            class Body:
                def on_startup(self, dependencies: Any) -> None: ...

                def on_remove(self) -> None: ...

                def on_shutdown(self) -> None:
                    try:
                        container.start()
                    except UcmError as error:
                        refused.append(error)

            for member in container.members.values():
                member.body = Body()
            super().start(container)

    assert play({"s": SINK}, ["add_component component=s", "start", "stop"], Restless)[-1] == "return step=2"
    assert len(refused) == 1
