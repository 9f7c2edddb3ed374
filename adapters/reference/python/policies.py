"""Execution policies (10.1.3, 10.5): which components are protected, which have a thread, and what the threads do.

Every call of a protected component, through any reference or of ``run``, takes the component's lock. A thread
that is inside may enter again; calls that come back to the component on another thread wait like all others.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TypeVar

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.reference.python.execution import POLICIES, PROTECTED, Trigger, is_active
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.paced_execution import PacesExecutions
from ucm_cts.adapters.reference.python.pacing import check_settings

T = TypeVar("T")


class ProtectedElement(pm.PortElementObject):
    """Stands for a provided port element of a protected component."""

    def __init__(self, container: ExecutesComponents, member: Member, port: str, element: pm.PortElementObject) -> None:
        self.container, self.member, self.port, self.element = container, member, port, element

    def exchange(self, value: int) -> int:
        return self.container._execute(self.member, self.port, lambda: self.element.exchange(value))

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self.container._execute(self.member, self.port, lambda: self.element.call(method, arguments))


class ExecutesComponents(PacesExecutions):
    """The part of a container that applies execution policies. One concern each, for variants to override."""

    period = 0.002
    """Seconds between two runs of a self-executing component."""

    def _check_policies(self, implementation: pm.Implementation) -> None:
        policies = implementation.policies
        for policy in policies:
            if policy.definition not in POLICIES or policy.parameters:
                raise pm.UcmError(f"{implementation.name!r} has an unknown policy: {policy}")
            self._check_settings(policy)
            due = implementation.provides if is_active(policy) else (None,)
            if policy.port not in due:
                raise pm.UcmError(f"{policy.definition!r} cannot be applied to {policy.port or 'a component'!r}")
        several = {policy.definition for policy in policies}
        if len(several) > 1 or (len(policies) > 1 and not all(map(is_active, policies))):
            raise pm.UcmError(f"{implementation.name!r} has more than one execution policy")

    def _check_settings(self, policy: s.Policy) -> None:
        check_settings(policy)

    def _check_body(self, member: Member) -> None:
        if member.execution.definition == s.SELF_EXECUTING:
            self._execution_api(member)

    def _is_protected(self, member: Member) -> bool:
        return member.execution.definition in PROTECTED

    def _reference_to(self, member: Member, port: str) -> pm.PortElementObject | None:
        element = super()._reference_to(member, port)
        if element is None or not self._is_protected(member):
            return element
        return member.execution.references.setdefault(port, ProtectedElement(self, member, port, element))

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        """Enter a protected component at ``port``, or at ``run``."""
        if port in member.execution.managed and not member.execution.is_inside:
            if member.execution.extended:
                return self._execute_paced(member, port, work)
            return self._execute_on_own_thread(member, lambda: self._execute_alone(member, port, work))
        return self._execute_alone(member, port, work)

    def _execute_on_own_thread(self, member: Member, work: Callable[[], T]) -> T:
        return member.execution.executor.execute(work)

    def _execute_alone(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        with self._exclusion(member, port):
            return work()

    @contextmanager
    def _exclusion(self, member: Member, port: str | None) -> Iterator[None]:
        """Only one thread at a time is in the component."""
        execution = member.execution
        with execution.lock:
            outer, execution.thread_inside = execution.thread_inside, threading.get_ident()
            try:
                yield
            finally:
                execution.thread_inside = outer

    def _begin_execution(self, member: Member) -> None:
        """The component and its container are operational."""
        execution = member.execution
        if execution.extended:
            self._begin_pace(member)
        if execution.definition == s.SELF_EXECUTING and execution.trigger is None:
            trigger = execution.trigger = Trigger()
            runs = self._run_paced if execution.extended else self._keep_running
            threading.Thread(target=runs, args=(member, trigger), daemon=True).start()

    def _end_execution(self, member: Member) -> None:
        """The component is about to be shut down; also called of one that never executed."""
        if member.execution.trigger:
            member.execution.trigger.end()
            member.execution.trigger = None
        self._end_pace(member)

    def _keep_running(self, member: Member, trigger: Trigger) -> None:
        while not trigger.ended.wait(self.period):
            self._run(member, trigger)

    def _run(self, member: Member, trigger: Trigger) -> None:
        """Run once; an exception is dropped, because no caller waits for the result."""
        body_run = self._execution_api(member).run
        with suppress(Exception):
            self._execute(member, None, lambda: trigger.run(body_run))

    def _execution_api(self, member: Member) -> pm.ComponentExecution:
        policy = member.execution.extended[0].definition if member.execution.extended else s.SELF_EXECUTING
        api = member.body.get_policy_element(policy, s.SELF_EXECUTION_API)
        if api is None:
            raise pm.UcmError(f"component {member.id} does not provide {s.SELF_EXECUTION_API}")
        return api
