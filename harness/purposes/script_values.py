"""Checks that the values in a plan fit the interfaces, before a script is run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType, Datum, Interface, Method
from ucm_cts.adapters.contract.data_values import misfit
from ucm_cts.adapters.contract.scenario import Action, Hook

Plan = Mapping[Hook, Sequence[Action]]


def value_problems(
    ports: Mapping[str, str], plan: Plan, interfaces: Mapping[str, Interface]
) -> Iterator[tuple[str, str]]:
    """The errors in calls and answers of a component whose ``ports`` have these interfaces: place and message.

    Port elements without interface, and those of policies, are not checked.
    """
    known = {port: interfaces[name] for port, name in ports.items() if name in interfaces}
    for hook, actions in plan.items():
        for index, action in enumerate(actions):
            if isinstance(action, s.CallMethod) and action.port in known:
                problem = _problem_of_call(action, known[action.port])
            elif isinstance(action, s.Answer) and known:
                problem = _problem_of_answer(action, known.values())
            else:
                continue
            if problem:
                yield f".plan.{hook}[{index}]", problem


def _problem_of_call(call: s.CallMethod, interface: Interface) -> str:
    method = interface.methods.get(call.method)
    if method is None:
        return (
            f"its interface has no method '{call.method}'; there are {', '.join(sorted(interface.methods)) or 'none'}"
        )
    problem = _problem_of_values(call.method, "argument", {p.name: p.of for p in method.arguments}, call.arguments)
    return problem or _problem_of_remembered(call)


def _problem_of_remembered(call: s.CallMethod) -> str:
    for one in call.remembered:
        if not 0 <= one.argument < len(call.arguments):
            return f"remembered: {call.method} has no argument {one.argument}; they are numbered from 0"
        if one.position < 0 or one.nth < 0:
            return "remembered: 'position' counts from 0, 'nth' from 1 (0 is the entry in which the body acts)"
    return ""


def _problem_of_answer(answer: s.Answer, interfaces: Iterable[Interface]) -> str:
    """Several of its interfaces may have a method of that name; one that it fits is enough."""
    methods = [interface.methods[answer.method] for interface in interfaces if answer.method in interface.methods]
    problems = [_problem_with(answer, method) for method in methods]
    if not methods:
        return f"none of its interfaces has a method '{answer.method}'"
    return problems[0] if all(problems) else ""


def _problem_with(answer: s.Answer, method: Method) -> str:
    if answer.exception is not None:
        raised = {exception.name: exception.fields for exception in method.raises}
        if answer.exception not in raised:
            return f"{answer.method} raises no '{answer.exception}'; there are {', '.join(sorted(raised)) or 'none'}"
        return _problem_of_values(answer.exception, "field", raised[answer.exception], answer.results or ())
    if answer.results is None:
        return ""
    return _problem_of_values(answer.method, "result", {p.name: p.of for p in method.results}, answer.results)


def _problem_of_values(of: str, what: str, types: Mapping[str, AnyType], values: Sequence[Datum]) -> str:
    if len(types) != len(values):
        return f"{of} has {len(types)} {what}s ({', '.join(types) or 'none'}), and {len(values)} are given"
    for (name, wanted), value in zip(types.items(), values, strict=True):
        problem = misfit(wanted, value)
        if problem:
            return f"{what} {name} of {of}: {problem}"
    return ""
