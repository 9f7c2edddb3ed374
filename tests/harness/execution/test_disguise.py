"""Each run has its own names and payloads; reports show those of the scripts."""

from __future__ import annotations

import re

import msgspec
import pytest
from subjects import Parrot

from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.scenario import CallMethod, Scenario
from ucm_cts.adapters.contract.trace import Raise, Trace
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.purposes.derived.log_messages import log_message_purposes
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor

SPELLING = "{port}_{element}"
SCENARIO = msgspec.convert(
    {
        "components": {
            "server": {"provides": ["in.api"], "attributes": {"label": "text"}},
            'a "client"\\\n': {
                "provides": ["in.api"],
                "requires": ["out.api"],
                "plan": {"exchange": [{"do": "call", "port": "out.api", "value": 2}, {"do": "return", "value": 7}]},
            },
        },
        "steps": [
            {"op": "add_component", "component": "server"},
            {"op": "add_component", "component": 'a "client"\\\n', "bind": "client"},
            {"op": "add_component", "component": "stranger"},
            {"op": "get_port_element", "id": "server", "port": "in.api", "bind": "api"},
            {"op": "get_port_element", "id": "client", "port": "in.api", "bind": "entry"},
            {"op": "connect", "id": "client", "port": "out.api", "to": "api", "bind": "link"},
            {"op": "start"},
            {"op": "invoke", "ref": "entry", "value": 3},
        ],
    },
    Scenario,
)


class _Whole(msgspec.Struct, frozen=True):
    trace: Trace


def run(scenario: Scenario, adapter: type[ReferenceAdapter] = ReferenceAdapter) -> Trace:
    answer = from_host_decoder().decode(Engine(adapter).answer(encode(Run(0, scenario))))
    assert isinstance(answer, Traced)
    return answer.events


def words(scenario: Scenario) -> set[str]:
    """Every name and payload that a framework can see."""
    seen: set[str] = set()
    for name, declaration in scenario.components.items():
        seen.update((name, *declaration.provides, *declaration.requires))
        seen.update(declaration.attributes, declaration.attributes.values())
        seen.update(re.findall(r"(?<![\w-])-?\d+\b", str(declaration.plan)))
    for step in scenario.steps:
        fields = msgspec.to_builtins(step)
        seen.update(str(fields[key]) for key in ("component", "port", "value") if key in fields)
    return seen


@pytest.mark.parametrize("spelling", [SPELLING, '{element}"::"{port}', "{port}-{element}\\"])
def test_no_name_and_no_payload_is_the_same_in_two_runs(spelling: str) -> None:
    plain = words(SCENARIO)
    disguised = [words(Disguise(seed, spelling).scenario(SCENARIO)) for seed in range(20)]
    for index, one in enumerate(disguised):
        assert len(one) == len(plain)
        assert not one & plain
        for other in disguised[index + 1 :]:
            assert not one & other
    assert words(Disguise(3, spelling).scenario(SCENARIO)) == disguised[3]


@pytest.mark.parametrize("spelling", [SPELLING, '{element}"::"{port}', "{port}-{element}\\"])
def test_reports_show_scenario_and_trace_in_original_names(spelling: str) -> None:
    disguise = Disguise(5, spelling)
    disguised = disguise.scenario(SCENARIO)
    assert disguise.reveal(disguised) == msgspec.structs.replace(SCENARIO, steps=disguise.reveal(disguised).steps)
    trace = disguise.reveal(_Whole(run(disguised))).trace
    undisguised = run(SCENARIO)
    assert [msgspec.structs.replace(e, t=0) for e in trace if not isinstance(e, Raise)] == [
        msgspec.structs.replace(e, t=0) for e in undisguised if not isinstance(e, Raise)
    ]
    (refusal,) = [e for e in trace if isinstance(e, Raise)]
    assert "stranger" in refusal.detail


def test_every_scenario_of_the_suite_comes_back_from_its_disguise() -> None:
    disguise = Disguise(1, SPELLING)
    for purpose in load_purposes("container"):
        for _, scenario in purpose.scenarios:
            revealed = disguise.reveal(disguise.scenario(scenario))
            assert revealed.components == scenario.components
            assert len(revealed.steps) == len(scenario.steps)


def test_long_messages_for_the_log_keep_their_length() -> None:
    (wide,) = (p for p in log_message_purposes() if p.id == "log/wide texts")
    disguised = Disguise(1, SPELLING).scenario(wide.scenarios[0][1])
    plans = [plan for declaration in disguised.components.values() for plan in declaration.plan.values()]
    lengths = {len(str(a.arguments[1])) for plan in plans for a in plan if isinstance(a, CallMethod)}
    assert {0, 256, 65_536} <= lengths


def test_payloads_are_not_found_inside_other_numbers_nor_names_made_up() -> None:
    disguise = Disguise(5, SPELLING)
    disguised = disguise.scenario(SCENARIO)
    payload = disguised.steps[-1].value  # type: ignore[union-attr]
    texts = {f"9{payload}": f"9{payload}", f"{payload}0": f"{payload}0", f"<{payload}>": "<3>", f"<{~payload}>": "<-4>"}
    for text, shown in texts.items():
        finding = Finding("R", "rule", "cause", text, "", (payload * 10,), None)
        revealed = disguise.reveal(finding)
        assert (revealed.expected, revealed.events) == (shown, (payload * 10,))
    assert disguise.reveal(_Whole(())) == _Whole(())


def test_framework_that_knows_the_scripts_by_heart_is_failed() -> None:
    monitor = Monitor(load_life_cycle())
    spelled = SCENARIO.components['a "client"\\\n'].requires[0].replace(".", "_")
    learnt = msgspec.json.decode(encode(SCENARIO).replace(b"out.api", spelled.encode()), type=Scenario)
    assert not monitor.judge(learnt, run(learnt, Parrot)).findings, "in the scripts' own names the lie cannot be seen"
    disguise = Disguise(5, SPELLING)
    disguised = disguise.scenario(SCENARIO)
    findings = [disguise.reveal(f) for f in monitor.judge(disguised, run(disguised, Parrot)).findings]
    assert findings
    assert "out_api" in findings[0].observed


@pytest.mark.parametrize(
    "spelling", ["", "{port}", "{port}{element}{port}", "{0}", "{port.x}_{element}", "{port_{", "{gate}"]
)
def test_spelling_that_does_not_say_port_and_element_is_wrong_use(spelling: str) -> None:
    with pytest.raises(WrongUse, match=r"must hold \{port\} and \{element\}"):
        Disguise(1, spelling)


def test_names_of_methods_that_begin_like_others_still_do() -> None:
    scenario = dict(next(p for p in load_purposes("core") if p.id == "port trace/names in names").scenarios)
    (plain,) = [one for name, one in scenario.items() if name.startswith("port trace/alphabet")]
    disguise = Disguise(3, SPELLING)
    (interface,) = disguise.scenario(plain).interfaces.values()
    revealed = {disguise.reveal(name): name for name in interface.methods}
    assert revealed["alphabet"].startswith(revealed["alpha"])
    assert not revealed["beta"].startswith(revealed["alpha"])


def test_names_of_port_elements_that_begin_like_others_still_do() -> None:
    (plain,) = (
        case for p in load_purposes("container") for name, case in p.scenarios if name == "names-that-begin-alike"
    )
    disguise = Disguise(3, SPELLING)
    revealed = {
        disguise.reveal(port): port for d in disguise.scenario(plain).components.values() for port in d.provides
    }
    assert revealed.keys() == {"in.api", "in.apices"}
    assert revealed["in.apices"].startswith(revealed["in.api"])


@pytest.mark.parametrize("value", ["", "a", "two\nlines", " blanks ", "x" * 4096, "12"])
def test_values_of_a_certain_look_keep_it(value: str) -> None:
    """What provokes by its length or its characters reaches the framework as it is; words do not."""
    server = {"attributes": {"label": value, "level": "word"}}
    scenario = msgspec.convert({"components": {"server": server}, "steps": []}, Scenario)
    (declaration,) = Disguise(1, SPELLING).scenario(scenario).components.values()
    label, level = declaration.attributes.values()
    assert label == value
    assert level != "word"
