"""Since when a defect shows: what a container has been through."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ucm_cts.adapters.contract.programming_model import (
    BadParameter,
    NotFound,
    UcmError,
)
from ucm_cts.adapters.mutants.python.registry import Base, is_below
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager


class History(Base):
    """A container that counts what it has been through."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.phases = self.refusals = self.failures = self.removals = self.removed_containers = 0

    @contextmanager
    def _operation(self) -> Iterator[None]:
        with super()._operation():
            try:
                yield
            except (NotFound, BadParameter):
                self.refusals += 1
                raise
            except UcmError as error:
                if " raised " in str(error):
                    self.failures += 1
                else:
                    self.refusals += 1
                raise

    def stop(self) -> None:
        was_started = self.is_started
        super().stop()
        self.phases += was_started

    def remove_component(self, comp_instance: int) -> None:
        super().remove_component(comp_instance)
        self.removals += 1

    def remove_container(self, sub_container: Container | None) -> None:
        ContainerManager.remove_container(self.manager, sub_container)
        self.removed_containers += 1


Situation = Callable[[Any], bool]
"""Says of a container with a history whether the defect shows in it."""


def after_a_phase(container: History) -> bool:
    return container.phases > 0


def after_two_phases(container: History) -> bool:
    return container.phases > 1


def after_a_refusal(container: History) -> bool:
    return container.refusals > 0


def after_a_failure(container: History) -> bool:
    return container.failures > 0


def after_a_removal(container: History) -> bool:
    return container.removals > 0


def in_a_second_container(container: History) -> bool:
    return is_below(container) and container not in container.manager.sub_containers[:1]


def after_a_removed_container(container: History) -> bool:
    return bool(vars(container.manager)["removed_containers"])


def beside_a_running_container(container: History) -> bool:
    everywhere = (container.manager, *container.manager.sub_containers)
    return any(other.is_started for other in everywhere if other is not container)


def with_eight_members(container: History) -> bool:
    return len(container.members) >= 8
