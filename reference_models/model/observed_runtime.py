"""Everything that a trace has shown so far, and what the vendor declares: what properties are asked about."""

from __future__ import annotations

from ucm_cts.adapters.contract.scenario import MANAGER, RemoveComponent, Scenario
from ucm_cts.reference_models.model.execution_policies import knows_policies
from ucm_cts.reference_models.model.executions import Executions
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.interactions import Interactions
from ucm_cts.reference_models.model.nothing_recorded import NoExecutions, NoInteractions
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.paced_events import PacedPhase
from ucm_cts.reference_models.model.request_events import Requests
from ucm_cts.reference_models.model.runtime import Member, Runtime
from ucm_cts.reference_models.model.service_call import ServiceCall, Trouble
from ucm_cts.reference_models.model.shared_data_events import SharedData
from ucm_cts.reference_models.model.timer_events import TimerPhase


class ObservedRuntime(Runtime):
    """A runtime with what bodies execute and how they interact, recorded if the scenario is ``interacting``: if port elements
    have interfaces or components policies. ``service_calls`` and ``undisturbed`` are what the functions of services
    with these names have found, ``requests``, ``shared_data``, ``paced_phases``, ``timer_phases`` and ``object_timer_phases`` what the functions
    ``all_requests``, ``all_shared_data``, ``paced_phases``, ``timer_phases`` and ``object_timer_phases`` have, ``is_over`` says that no event follows,
    ``ending`` is the operation in progress if it stops or removes components.
    """

    def __init__(self, scenario: Scenario, ics: Ics | None = None, interacting: bool = False) -> None:
        super().__init__(scenario)
        self.ics = ics or Ics()
        self.knows_policies = knows_policies(scenario)
        self.shares_ids = self.ics.reading("id-scope") == "runtime"
        self.replaces_servers = self.ics.reading("second-server") == "replace"
        self.executions = Executions(self) if interacting else _NO_EXECUTIONS
        self.interactions = Interactions(self) if interacting else _NO_INTERACTIONS
        self.service_calls: list[ServiceCall] | None = None
        self.requests: list[Requests] | None = None
        self.shared_data: list[SharedData] | None = None
        self.paced_phases: list[PacedPhase] | None = None
        self.timer_phases: list[TimerPhase] | None = None
        self.object_timer_phases: list[TimerPhase] | None = None
        self.undisturbed: list[tuple[ServiceCall, Trouble]] | None = None
        self.is_over = False
        self.ending: OperationInProgress | None = None

    def is_being_ended(self, member: Member) -> bool:
        """Is an operation in progress that may stop or remove the component?"""
        ongoing = self.ending
        if ongoing is None:
            return False
        if isinstance(ongoing.step, RemoveComponent):
            return ongoing.subject is member
        return ongoing.container.name == MANAGER or ongoing.container is member.container

    def dissolve(self) -> None:
        """It has been read, and nobody asks about it any more: undo what refers to each other. Then its memory is free at once, and not when
        the collector has found these circles, in all of a run, for a tenth of the time of judging.
        """
        for container in self.containers.values():
            for member in container.members:
                member.connections, member.handed_over = [], None
            container.replace([])
            container.startup_order = {}
        for call in self.interactions.calls:
            call.deliveries = []
        self.executions, self.interactions = _NO_EXECUTIONS, _NO_INTERACTIONS


_EMPTY = Runtime(Scenario({}, ()))
_NO_EXECUTIONS: Executions = NoExecutions(_EMPTY)
_NO_INTERACTIONS: Interactions = NoInteractions(_EMPTY)
