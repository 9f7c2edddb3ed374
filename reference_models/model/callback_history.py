"""The callbacks of a body: the one that enters it now, and those that it has received before."""

from __future__ import annotations

from typing import NamedTuple

from ucm_cts.adapters.contract.scenario import Hook
from ucm_cts.adapters.contract.trace import Enter
from ucm_cts.reference_models.model.changing import Changing
from ucm_cts.reference_models.model.operation import Ongoing
from ucm_cts.reference_models.model.runtime import Member

_REMEMBERED = 50
"""The number of phases that findings list."""


class CallbackHistory(Changing):
    """The callbacks that one body has received so far, however many they are.

    ``first``, ``first_at``: the first callback of all and its ``n``.
    ``initialised``, ``removed``, ``begun``: on_init, on_remove or on_startup has come.
    ``regular``: on_init came first, and on_startup and on_shutdown in turn since.
    ``interfaces``: how often set_container_interface came.
    ``phases``: the last on_startup and on_shutdown, in their order.
    """

    first: str = ""
    first_at: int = 0
    initialised: bool = False
    removed: bool = False
    begun: bool = False
    regular: bool = True
    interfaces: int = 0
    phases: list[str] = []

    def add(self, hook: Hook, n: int) -> None:
        """One more callback has come, with the event ``n``."""
        if not self.first:
            self.first, self.first_at = hook, n
        if hook == "on_startup" or hook == "on_shutdown":
            self.regular = self.regular and self.initialised and self.in_operation == (hook == "on_shutdown")
            self.begun = self.begun or hook == "on_startup"
            self.phases.append(hook)
            if len(self.phases) > 2 * _REMEMBERED:
                del self.phases[:_REMEMBERED]
        elif hook == "on_init":
            self.regular = self.regular and not self.initialised and not self.phases
            self.initialised = True
        elif hook == "on_remove":
            self.regular = False
            self.removed = True
        elif hook == "set_container_interface":
            self.interfaces += 1

    @property
    def in_operation(self) -> bool:
        """Was the last phase to begin the operational one?"""
        return bool(self.phases) and self.phases[-1] == "on_startup"

    @property
    def is_whole_life(self) -> bool:
        """Has it been initialised, and then started and shut down, once or again and again, and nothing else?"""
        return self.regular and self.initialised and bool(self.phases) and not self.in_operation


class Callback(NamedTuple):
    """A body is entered by a callback.

    ``event``: the entry.
    ``member``: its instance; None if no add_component has returned for it.
    ``ongoing``: the operation in progress, if there is one.
    ``history``: the callbacks that the body received before.
    """

    event: Enter
    member: Member | None
    ongoing: Ongoing
    history: CallbackHistory
