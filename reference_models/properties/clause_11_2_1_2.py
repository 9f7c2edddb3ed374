"""Properties about the references that on_startup hands over (11.2.1.2, 11.2.3, 12.10)."""

from __future__ import annotations

from ucm_cts.adapters.contract.scenario import Connect
from ucm_cts.adapters.contract.trace import MaybeReference, Reference
from ucm_cts.reference_models.conclusions import Concluded, Conclusions
from ucm_cts.reference_models.findings import Arrow
from ucm_cts.reference_models.model.callback_history import Callback
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import Connection, Member, lane
from ucm_cts.reference_models.model.service_policies import BESIDE_EXECUTION, policy_elements
from ucm_cts.reference_models.model.start_effects import handed_over
from ucm_cts.reference_models.properties.declaration import Property, property_at

_RESOLVED, _HANDED_OVER, _AGAIN = "R-11.2.1.2-03", "R-11.2.1.2-09", "R-11.2.3-10"
_ONE_REFERENCE, _DANGLING = "R-12.10-25", "R-11.2.3-14"


@property_at("entered", _RESOLVED, _HANDED_OVER, _AGAIN, _ONE_REFERENCE, at=("on_startup",))
def dependencies(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """on_startup names each connected required port element and gives the reference it was connected to."""
    event, member, ongoing, _ = callback
    if member is None or member.suspended or member.operational or event.wrong:
        return ()
    if not event.dependencies and not member.connections:
        return ()
    given = handed_over(event)
    again = member.startups > 0
    changing = ongoing.step.port if ongoing is not None and isinstance(ongoing.step, Connect) else ""
    problem = _problem(member, given, changing if ongoing is not None and ongoing.subject is member else "")
    if problem is None:
        if member.live_connections():
            return (check.kept(_AGAIN if again else _HANDED_OVER), check.kept(), check.kept(_ONE_REFERENCE))
        return ()
    requirement, cause, expected, observed = problem
    return check.fail(
        cause,
        expected=f"on_startup of {member.lane} is given {expected}",
        observed=f"it was given {observed}",
        during=(ongoing, event),
        instead=(Arrow(member.container.name, member.lane, f"on_startup({_expected(member)})"),),
        requirement=_AGAIN if again else requirement,
    )


def _problem(member: Member, given: dict[str, list[MaybeReference]], changing: str) -> tuple[str, str, str, str] | None:
    """Requirement, cause, expected and observed of the first thing wrong with what was handed over.

    ``changing``: the port that is being connected; what is handed over for it may be of before or of afterwards.
    """
    required = (*member.declaration.requires, *policy_elements(member.declaration, *BESIDE_EXECUTION))
    foreign = [p for p in given if p not in required]
    if foreign:
        names = ", ".join(required) or "nothing"
        return _HANDED_OVER, "name", f"dependencies named {names}", f"a dependency named {foreign[0]}"
    for port in member.declaration.requires:
        if port == changing or given.get(port) == [c.reference for c in member.connections if c.port == port]:
            continue  # the common case: what was connected, and what of it was undone is no_dangling_reference's matter
        connections = [c for c in member.connections if c.port == port and c.live is not False]
        certain = [c for c in connections if c.live]
        undone = {c.reference for c in member.connections if c.port == port and c.live is False}
        undone -= {c.reference for c in connections}
        references = [r for r in given.get(port, []) if r not in undone]  # no_dangling_reference's matter
        if certain and not references:
            what = "no reference for it" if port in given else "nothing of that name"
            return _HANDED_OVER, "missing", f"a reference for {port}, which is connected", what
        wanted = {c.reference for c in connections if isinstance(c.reference, Reference)}
        strangers = [
            r
            for r in references
            if isinstance(r, Reference)
            and r not in wanted
            and all(isinstance(c.reference, Reference) for c in connections)
        ]
        if strangers and certain:
            return _RESOLVED, "reference", f"{port} = {_expected(member)}", f"{port} = {_show(strangers[0])}"
        lost = [c for c in certain if isinstance(c.reference, Reference) and c.reference not in references]
        if lost and all(isinstance(r, Reference) for r in references) and not lost[0].stale:
            shown = ", ".join(map(_show, references))
            return _HANDED_OVER, "missing", f"{_show(lost[0].reference)} for {port}, connected last", shown
        if certain and len(references) > len(connections):
            expected = f"{len(connections)} reference(s) for {port}, one a connection"
            return _ONE_REFERENCE, "count", expected, f"{len(references)} references"
    return None


@property_at("entered", "R-11.2.2.1-10", _DANGLING, at=("on_startup",))
def no_dangling_reference(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """on_startup offers no removed instance, and nothing through a connection that was undone."""
    event, member, ongoing, _ = callback
    if member is None or member.operational or event.wrong or (ongoing is not None and ongoing.operation == "connect"):
        return ()
    if not event.dependencies and not member.connections:
        return ()
    return _nothing_dangles(check, runtime, callback, member)


def _nothing_dangles(check: Property, runtime: ObservedRuntime, callback: Callback, member: Member) -> Conclusions:
    event, ongoing = callback.event, callback.ongoing
    given = handed_over(event)
    for port, references in given.items():
        over = _all_over(runtime, member, port, references)
        if over:
            removed = next((c.provider for c in over if c.provider is not None and c.provider.gone), None)
            why = f"{removed.lane} was removed" if removed is not None else f"{over[0].name} was disconnected"
            yield check.fail(
                "removed provider" if removed is not None else "undone connection",
                expected=f"{why}, so nothing is handed over for {port}, as before it was connected",
                observed=f"on_startup handed over {_show(references[0])} for {port}",
                during=(ongoing, event),
                requirement=_DANGLING if removed is not None else "",
            )
            return
        for reference in references:
            provider = runtime.provider_of(reference)
            stale = any(c.stale and c.provider is provider for c in member.connections)
            if provider is not None and provider.gone and not stale:
                yield check.fail(
                    "removed provider",
                    expected=f"{provider.lane} was removed, so {port} is not connected to it",
                    observed=f"on_startup handed over {_show(reference)} for {port}",
                    during=(ongoing, event),
                    requirement=_DANGLING,
                )
                return
            of_port = [c for c in member.connections if c.port == port and c.reference == reference]
            if of_port and all(c.live is False for c in of_port) and not member.suspended:
                yield check.fail(
                    "undone connection",
                    expected=f"{of_port[0].name} was disconnected, so its reference is not handed over",
                    observed=f"on_startup handed over {_show(reference)} for {port}",
                    during=(ongoing, event),
                )
                return
    if any(c.provider is not None and c.provider.gone for c in member.connections):
        yield check.kept(_DANGLING)
    if any(c.live is False and c.provider is not None and not c.provider.gone for c in member.connections):
        yield check.kept()


def _all_over(
    runtime: ObservedRuntime, member: Member, port: str, references: list[MaybeReference]
) -> list[Connection]:
    """The connections of ``port``, if none of them stands and only proxies are handed over for it, which do not show what is behind them;
    nothing if a start may give proxies of nothing, too.
    """
    if not runtime.shows_missing or any(isinstance(reference, Reference) for reference in references):
        return []
    connections = [c for c in member.connections if c.port == port] if references else []
    removed = [c for c in connections if c.provider is not None and c.provider.gone and not c.stale]
    undone = [c for c in connections if c.live is False and not member.suspended]
    return connections if all(c in removed or c in undone for c in connections) else []


def _expected(member: Member) -> str:
    return ", ".join(f"{c.port}={_show(c.reference)}" for c in member.live_connections())


def _show(reference: MaybeReference) -> str:
    if isinstance(reference, Reference):
        return f"{lane(reference.component, reference.instance)}.{reference.port}"
    return "nil" if reference is None else "an object of the framework's own"
