"""How a property is declared: its name, the requirements it stands for, and when it is checked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, get_args

from ucm_cts.adapters.contract.trace import Enter, Raise, StepEvent
from ucm_cts.reference_models.conclusions import Concluded, Kept
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.designation import error_name
from ucm_cts.reference_models.model.operation import Ongoing, OperationInProgress

_Always = Literal["ended", "unsettled", "entered", "unclear", "called", "answered", "replied", "noted", "overlapped"]
_WithInteractions = Literal[
    "began",
    "over",
    "served",
    "waited",
    "linked",
    "delivered",
    "completed",
    "pushed",
    "counted",
    "stressed",
    "read",
    "closed",
]
Moment = Literal[_Always, _WithInteractions]
"""When a property is checked.

``ended``: an operation ended; ``unsettled``: the same, if the text leaves open how, and no property was violated so far.
``entered``: a body was entered by a callback; ``unclear``: the same, if no property was violated so far.
``called``: a body was entered by a business call.
``answered``: a stimulus of the test came back; ``replied``: a body's own call did; ``noted``: a fragment's query did.
``overlapped``: two operations of containers overlap, which ends reading.
``began``, ``over``: an execution began or ended.
``served``: a call that had to wait came back, or never did.
``waited``: a wait of the scenario ran out of patience.
``linked``: a step for connectors ended.
``delivered``: a method of a body was entered; ``completed``: a body's call of a method came back.
``pushed``, ``counted``, ``stressed``, ``read``: a burst was pushed, messages were counted, callers met, the log was read.
``closed``: the trace is over.
"""

Feature = Literal["", "policies", "paced", "timers", "interactions", "extended", "fragments", "attributes"]
"""The feature that a scenario must use for a property to apply: none; where components have policies; where some
have policies of 10.5 (``paced``), or index timers (``timers``); where interactions are followed, because port elements have interfaces or components policies; where connectors of 10.4 are bound to types (``extended``);
where components are fragments, or have attributes.
"""


Evaluate = Callable[..., Concluded]


@dataclass(frozen=True)
class Property:
    """A property that traces are to have: its requirements are bound here, and ``evaluate`` names them no more.

    ``name``: as reports and the catalogue call it.
    ``moment``: when it is checked.
    ``stands_for``: its requirements.
    ``at``: the operations, hooks (``entered``) or callers (``called``) for which it is checked; empty for all.
    ``evaluate``: a pure function of this property and what the monitor has at ``moment``; yields what it concludes.
    ``timed``: whether it depends on durations, so that a machine that stood still may be the reason of a finding.
    ``feature``: it applies to scenarios that use this; empty for all.
    ``even_after_removal``: whether it is checked for operations on a container that has been removed as well, of which the text
    says nothing.
    """

    name: str
    moment: Moment
    stands_for: tuple[str, ...]
    at: tuple[str, ...]
    evaluate: Evaluate
    timed: bool = False
    feature: Feature = ""
    even_after_removal: bool = False

    def kept(self, requirement: str = "") -> Kept:
        """The requirement's condition really arose, and it was kept; without ``requirement`` the first one's."""
        return requirement or self.stands_for[0]

    def fail(
        self,
        cause: str,
        *,
        expected: str,
        observed: str,
        at: tuple[int, ...] = (),
        step: int | None = None,
        event: StepEvent | None = None,
        ended: OperationInProgress | None = None,
        during: tuple[Ongoing, Enter] | None = None,
        instead: tuple[Arrow, ...] = (),
        requirement: str = "",
        late_by: int = 0,
    ) -> Finding:
        """The requirement was violated; without ``requirement`` the first one. The others are the fields of ``Finding``:
        ``event`` (one event about a step), ``ended`` (an operation with its end) and ``during`` (a callback in an operation,
        if there is one) stand for ``at`` and ``step``.
        """
        if event is not None:
            at, step = (event.n,), event.step
        elif ended is not None:
            at, step = (ended.call, ended.end.n), ended.step_number
        elif during is not None:
            at, step = (during[1].n,), during[0].step_number if during[0] is not None else None
        violated = requirement or self.stands_for[0]
        return Finding(violated, self.name, cause, expected, observed, at, step, instead, late_by=late_by)

    def refused(
        self, operation: str, end: Raise, *, expected: str, cause: str = "refused", requirement: str = ""
    ) -> Finding:
        """The requirement was violated because ``operation`` ended with an exception."""
        observed = f"{operation} raised {error_name(end.error)} {end.detail}".rstrip()
        return self.fail(cause, expected=expected, observed=observed, event=end, requirement=requirement)


def requirements(text: str) -> tuple[str, ...]:
    """The requirements whose ids ``text`` names."""
    return tuple(text.split())


PROPERTIES: dict[str, Property] = {}
"""All properties by name, filled as their modules are imported; ``table`` imports them all."""


def property_at(
    moment: Moment,
    *stands_for: str,
    at: tuple[str, ...] = (),
    timed: bool = False,
    feature: Feature = "",
    even_after_removal: bool = False,
) -> Callable[[Evaluate], Evaluate]:
    """Register the decorated function, under its own name, as a property that is checked at ``moment``."""

    def register(evaluate: Evaluate) -> Evaluate:
        name = evaluate.__name__
        assert name not in PROPERTIES, f"two properties are called {name}"
        needs = feature or ("interactions" if moment in get_args(_WithInteractions) else "")
        PROPERTIES[name] = Property(name, moment, stands_for, at, evaluate, timed, needs, even_after_removal)
        return evaluate

    return register


Bound = tuple[Evaluate, Property]
"""A property with its function at hand."""


def checked_at(moment: Moment, features: frozenset[Feature], at: str = "") -> tuple[Bound, ...]:
    """The properties checked at ``moment`` in scenarios that use ``features``, for operation, hook or caller ``at``."""
    return tuple(
        (p.evaluate, p)
        for p in PROPERTIES.values()
        if p.moment == moment and (not p.at or at in p.at) and (not p.feature or p.feature in features)
    )
