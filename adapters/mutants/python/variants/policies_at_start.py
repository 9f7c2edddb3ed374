"""Conformant frameworks that check the policies of a component when its container is started, and not when it is added."""

from __future__ import annotations

import dataclasses

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.programming_model import Implementation, UcmError
from ucm_cts.adapters.mutants.python.registry import POLICIES, Base, variant_of
from ucm_cts.adapters.sdk.python.policies import EXECUTION

_ACTIVE = (s.ACTIVE, s.PERIODIC_ACTIVE, s.SPORADIC_ACTIVE)
_KNOWN = {*EXECUTION, s.CLOCK, s.COMPONENT_TRACE, s.PORT_TRACE}


@variant_of(*POLICIES, "9.4.3.2", readings={"unknown-policy": "refused"})
class refuses_unknown_policies_at_start(Base):
    """A component with a policy that the framework does not know is added; its container does not start."""

    def _check_policies(self, implementation: Implementation) -> None:
        known = [p for p in implementation.policies if p.definition in _KNOWN]
        super()._check_policies(dataclasses.replace(implementation, policies=known))

    def _check_startable(self) -> None:
        for member in self.members.values():
            super()._check_policies(member.implementation)
        super()._check_startable()


class _ChecksPoliciesAtStart(Base):
    def _check_policies(self, implementation: Implementation) -> None:
        pass

    def _check_startable(self) -> None:
        for member in self.members.values():
            super()._check_policies(member.implementation)
        super()._check_startable()


@variant_of(*POLICIES, "10.1.4")
class refuses_policies_at_start(_ChecksPoliciesAtStart):
    """A component is added whatever policies it has; if they cannot be applied, its container does not start."""


class _RefusesSecondActivePolicies(_ChecksPoliciesAtStart):
    def _check_startable(self) -> None:
        super()._check_startable()
        for member in self.members.values():
            policies = member.implementation.policies
            if len({p.port for p in policies if p.definition in _ACTIVE and p.port is not None}) > 1:
                raise UcmError(f"{member.implementation.name!r} has two active policies")


@variant_of(*POLICIES, readings={"second-active-policy": "refuse"})
class refuses_second_active_policies_at_start(_RefusesSecondActivePolicies):
    """The same; active policies on two ports are two policies."""


@variant_of("10.5", readings={"second-active-policy": "refuse"})
class refuses_extended_policies_at_start(_RefusesSecondActivePolicies):
    """The same with the policies of 10.5."""


@variant_of("10.3", readings={"second-timer-policy": "refused"})
class refuses_second_timer_policies_at_start(_ChecksPoliciesAtStart):
    """The same with policies for timers: of a kind a component may have one."""
