"""The judge: every rule watches every trace. Pure and offline: the same trace gives the same findings, anywhere."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Call, Create, Enter, Exit, Raise, Reply, Request, Return, Siblings, Trace
from ucm_cts.reference_models import (
    rules_callbacks,
    rules_dependencies,
    rules_interactions,
    rules_operations,
)
from ucm_cts.reference_models.adoption import adopt
from ucm_cts.reference_models.ledger import RULES, Ledger
from ucm_cts.reference_models.life_cycle import LifeCycleTable
from ucm_cts.reference_models.rules_interactions import BusinessCall
from ucm_cts.reference_models.runtime import Runtime, Window
from ucm_cts.reference_models.situations import Situations

_MODULES = (rules_operations, rules_dependencies, rules_interactions, rules_callbacks)

_BUSINESS = ("disabled_ports", "nothing_after_stop")


class Judge:
    """Judges traces against one life-cycle table. Holds no state between traces."""

    def __init__(self, table: LifeCycleTable) -> None:
        self._table = table
        self._situations = Situations(table)
        at = {
            moment: [r for r in RULES.values() if r.moment == moment]
            for moment in ("ended", "entered", "replied", "noted")
        }
        self._ended = [r.check for r in at["ended"] if r.name != "stimulus"]
        self._entered = [r.check for r in at["entered"] if r.name not in _BUSINESS]
        self._entered_business = [r.check for r in at["entered"] if r.name in _BUSINESS]
        self._replied = [r.check for r in at["replied"]]
        self._noted = [r.check for r in at["noted"]]
        self._stimulus = RULES["stimulus"].check

    def judge(self, scenario: s.Scenario, trace: Trace) -> Ledger:
        """Everything the rules say about ``trace``, which may break off anywhere."""
        ledger = Ledger(scenario, self._table)
        runtime = Runtime(scenario)
        heard: dict[tuple[str, int], list[s.Hook]] = {}
        window: Window | None = None
        stimuli: dict[int, BusinessCall] = {}
        open_calls: dict[int, list[BusinessCall]] = {}
        hooks: dict[int, list[str]] = {}
        steps = scenario.steps
        for event in trace:
            match event:
                case Enter():
                    member = runtime.bodies.get((event.component, event.instance))
                    if event.hook == "exchange":
                        calls = open_calls.get(event.thread)
                        call = calls[-1] if calls else None
                        if call is not None:
                            call.entries.append((event, None))
                        for check in self._entered_business:
                            check(ledger, runtime, window, event, call)
                        if member is not None and member.operational:
                            member.served = True
                    else:
                        said = heard.setdefault((event.component, event.instance), [])
                        for check in self._entered:
                            check(ledger, runtime, window, event, said)
                        said.append(event.hook)
                        if window is not None:
                            window.callbacks.append(event)
                    hooks.setdefault(event.thread, []).append(event.hook)
                case Exit():
                    entered = hooks.get(event.thread)
                    if entered:
                        entered.pop()
                    if event.hook == "exchange":
                        for call in reversed(open_calls.get(event.thread, ())):
                            call.close(event)
                            break
                case Call():
                    step = steps[event.step]
                    if isinstance(step, s.Invoke):
                        call = BusinessCall(step.value, event.n, step=step)
                        stimuli[event.step] = call
                        open_calls.setdefault(event.thread, []).append(call)
                    elif isinstance(step, s.ContainerCall):
                        window = self._situations.open(runtime, event.step, step)
                        window.call = event.n
                case Return() | Raise():
                    step = steps[event.step]
                    if isinstance(step, s.Invoke):
                        call = stimuli[event.step]
                        open_calls[event.thread].remove(call)
                        self._stimulus(ledger, runtime, call, event)
                    elif window is not None and window.step_number == event.step:
                        for check in self._ended:
                            check(ledger, runtime, window, event)
                        adopt(runtime, window, event)
                        window = None
                case Request():
                    inside = hooks.get(event.thread)
                    call = BusinessCall(event.value, event.n, request=event, caller_hook=inside[-1] if inside else "")
                    open_calls.setdefault(event.thread, []).append(call)
                case Reply():
                    calls = open_calls.get(event.thread)
                    if calls:
                        call = calls.pop()
                        for check in self._replied:
                            check(ledger, runtime, call, event)
                case Siblings():
                    for check in self._noted:
                        check(ledger, runtime, event)
                case Create():
                    if window is not None:
                        window.created.append((event.component, event.instance))
                case _:
                    pass
        return ledger
