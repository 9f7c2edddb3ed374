"""The callbacks that a body has received so far, as far as properties ask for them, however many they are."""

from __future__ import annotations

from ucm_cts.adapters.contract.scenario import Hook

_REMEMBERED = 50
"""So many phases are told of one by one."""


class CallbackHistory:
    """The callbacks of one body. ``first`` is the first of all, ``first_at`` its ``n``; ``interfaces`` counts
    set_container_interface.

    ``regular`` says that of a component's life there was on_init first, and on_startup and on_shutdown in turn since;
    ``phases`` are the last of these two, ``begun`` whether on_startup has ever come.
    """

    __slots__ = ("begun", "first", "first_at", "initialised", "interfaces", "phases", "regular", "removed")

    def __init__(self) -> None:
        self.first = ""
        self.first_at = 0
        self.initialised = False
        self.removed = False
        self.begun = False
        self.regular = True
        self.interfaces = 0
        self.phases: list[str] = []

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
