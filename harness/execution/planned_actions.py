"""The plan of a body for a hook, and whether events show that the body followed it."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.scenario import Action, Declaration
from ucm_cts.adapters.contract.trace import Enter, Held, Pushed, Reply, Request, Siblings

Act = Request | Pushed | Siblings | Held
"""Events that show an action of a plan."""


class Settled(NamedTuple):
    """A call whose arguments are known, and the number of the object timer that it calls, if it calls one.

    ``since``: the event by which the body got the last of them; 0 if it had all when it was entered. A body that acted meanwhile may have
    looked for them before.
    """

    call: s.CallMethod
    timer: int | None
    since: int


Due = Action | Settled
"""What a body has to do."""


class Plan(NamedTuple):
    """What a body does at a hook, whether it raises in the end, and what ``exchange`` returns if the plan says so."""

    actions: tuple[Action, ...]
    raises: bool
    returns: int | None


def plan_of(declaration: Declaration, hook: s.Hook) -> Plan:
    """The plan for ``hook``."""
    actions = declaration.plan.get(hook, ())
    returned = [a.value for a in actions if isinstance(a, s.ReturnValue)]
    return Plan(actions, any(isinstance(a, s.RaiseError) for a in actions), returned[-1] if returned else None)


def depends_on_entries(declaration: Declaration) -> bool:
    """Does what the body calls depend on what it was entered with, or had been given before?"""
    calls = [a for plan in declaration.plan.values() for a in plan if isinstance(a, s.CallMethod)]
    return any(
        call.remembered or call.given is not None or call.from_clock is not None or call.on is not None
        for call in calls
    )


def as_entered(
    plan: Sequence[Action],
    acts: Sequence[Act],
    enter: Enter,
    entries: Sequence[Enter],
    replies: Mapping[int, Reply] = {},
    timers: Sequence[tuple[str, int]] = (),
) -> tuple[Due, ...]:
    """The plan of a body that was entered by ``enter``, with the values that it had been given at its ``entries``, and by the ``replies``
    to requests of this plan, by request. ``timers`` are the object timers that came to it: by which method, and the event.

    A call is left out if the body was entered with another value, or has not been given one of the call's values.
    """
    found: list[Due] = []
    pairs = iter([*itertools.zip_longest(acts, acts[1:])])
    for action in plan:
        if isinstance(action, s.CallMethod) and action.given not in (None, enter.value):
            continue
        if isinstance(action, s.CallMethod) and action.from_clock is not None:
            found += _dated(action, action.from_clock, pairs, replies)
            continue
        if isinstance(action, s.CallMethod) and action.on is not None:
            found += _on_timer(action, action.on, enter, timers)
            continue
        if not isinstance(action, s.CallMethod) or not action.remembered:
            found.append(action)
            continue
        given = [_given(one, enter, entries) for one in action.remembered]
        if None in given:
            continue
        arguments: list[Datum] = list(action.arguments)
        for one, entry in zip(action.remembered, given, strict=True):
            assert entry is not None
            arguments[one.argument] = (entry.arguments or ())[one.position]
        call = msgspec.structs.replace(action, arguments=tuple(arguments), remembered=())
        found.append(Settled(call, None, _since(max(entry.n for entry in given if entry is not None), enter)))
    return tuple(found)


def _since(n: int, enter: Enter) -> int:
    """``Settled.since`` of what came with event ``n``."""
    return n if n > enter.n else 0


def _on_timer(call: s.CallMethod, of: s.TimerFrom, enter: Enter, timers: Sequence[tuple[str, int]]) -> list[Due]:
    """The call of the timer that the body was given; nothing if it was not."""
    if of.nth == 0:
        return [Settled(call, enter.timer, 0)] if enter.timer is not None and enter.method == of.method else []
    matching = [(number, n) for number, (method, n) in enumerate(timers, 1) if method == of.method]
    if not 1 <= of.nth <= len(matching):
        return []
    number, n = matching[of.nth - 1]
    return [Settled(call, number, _since(n, enter))]


def _dated(
    call: s.CallMethod,
    of: s.FromClock,
    acts: Iterator[tuple[Act, Act | None]],
    replies: Mapping[int, Reply],
) -> list[Action]:
    """What the body did for ``call``, as far as the next ``acts`` (each with the one after it) show: it read the clock, and made the call
    with the date that followed from that, if the clock gave a time.
    """
    reading = s.CallMethod(of.port, of.method)
    for act, following in acts:
        if not _is(act, reading):
            continue
        dated = _with_date(call, of, replies.get(act.n))
        leads_on = not isinstance(following, Request) or (following.port, following.method) == (call.port, call.method)
        if leads_on or not dated:
            return [reading, *dated]
    return []


def _with_date(call: s.CallMethod, of: s.FromClock, reply: Reply | None) -> list[Action]:
    """The call with the date that follows from what the clock gave; nothing if that was no time."""
    results = reply.results or () if reply is not None and not reply.failed else ()
    arguments = s.date_from(call.arguments, of.argument, results)
    return [] if arguments is None else [msgspec.structs.replace(call, arguments=arguments, from_clock=None)]


def _given(one: s.Remembered, enter: Enter, entries: Sequence[Enter]) -> Enter | None:
    """The entry that has the value; None if there is none."""
    if one.nth == 0:
        found = enter if enter.hook == "method" and enter.method == one.method else None
    else:
        matching = [entry for entry in entries if entry.method == one.method]
        found = matching[one.nth - 1] if one.nth <= len(matching) else None
    return found if found is not None and one.position < len(found.arguments or ()) else None


def is_as_planned(
    plan: Sequence[Due],
    acts: Sequence[Act],
    held: tuple[dict[str, int], ...],
    replies: Mapping[int, Reply] = {},
    done: int = 0,
) -> bool:
    """Are ``acts``, but for those that are ``done``, what the plan has a body do that held these references, by number, at
    one moment or another? ``replies`` are what came back, by request.
    """
    for index, action in enumerate(plan):
        if isinstance(action, s.RaiseError):
            break
        if isinstance(action, s.ReturnValue | s.Answer | s.CountMessages):
            continue
        times = _times(action, held)
        if isinstance(action, Settled) and action.since > _end(acts, done, replies):
            times |= {0}
        if len(times) > 1:
            rest = plan[index + 1 :]
            return any(
                _are(acts[done : done + n], action, n) and is_as_planned(rest, acts, held, replies, done + n)
                for n in times
            )
        (only,) = times
        if not _are(acts[done : done + only], action, only):
            return False
        done += only
    return done == len(acts)


def _times(action: Due, held: tuple[dict[str, int], ...]) -> set[int]:
    """How often a body may do it that held these references: once for each of them."""
    call = action.call if isinstance(action, Settled) and action.timer is None else action
    if isinstance(call, s.CallPort | s.CallMethod | s.Burst):
        return {one.get(call.port, 0) for one in held}
    return {1}


def _end(acts: Sequence[Act], done: int, replies: Mapping[int, Reply]) -> int:
    """The last event known of the acts that are ``done``; 0 if none is."""
    if not done:
        return 0
    last = acts[done - 1]
    return replies[last.n].n if last.n in replies else last.n


def _are(acts: Sequence[Act], action: Due, times: int) -> bool:
    """Is each of ``acts`` this ``action``, and are there so many?"""
    return len(acts) == times and all(_is(act, action) for act in acts)


def _is(act: Act, action: Due) -> bool:
    """Does ``act`` show this action?"""
    if isinstance(action, Settled) and act.n < action.since:
        return False
    match act:
        case Request(method=None):
            return isinstance(action, s.CallPort) and (action.port, action.value) == (act.port, act.value)
        case Request():
            call, timer = (action.call, action.timer) if isinstance(action, Settled) else (action, None)
            own = act.port, act.method, act.arguments or (), act.handler, act.timer
            return (
                isinstance(call, s.CallMethod) and (call.port, call.method, call.arguments, call.handler, timer) == own
            )
        case Pushed():
            own_burst = act.port, act.first, act.count
            return isinstance(action, s.Burst) and (action.port, action.first, action.count) == own_burst
        case Held():
            return isinstance(action, s.HoldAtGate) and action.gate == act.gate
        case _:
            return isinstance(action, s.QuerySiblings)
