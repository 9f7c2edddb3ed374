"""A call through a service connector whose ends are known (10.1.5.1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ucm_cts.adapters.contract.data_types import Interface, Method
from ucm_cts.adapters.contract.trace import Exit
from ucm_cts.reference_models.model.links import End, LinkState
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall

Trouble = Literal[
    "", "not served", "elsewhere", "twice", "arguments", "results", "failed", "early", "swallowed", "translated"
]
"""What went wrong with a call that nothing disturbed: its server was not entered, another body was, the server was twice;
values changed on their way; it ended with an exception of the framework's own, or before its server was done; the server's
exception did not arrive, or another one did.
"""


@dataclass(frozen=True)
class ServiceCall:
    """A call through a service connector whose ends are known: ``client`` and ``server`` were attached and operational."""

    call: MethodCall
    link: LinkState
    client: End
    server: End
    interface: Interface

    @property
    def method(self) -> Method | None:
        """The method called, if its interface has it."""
        return self.interface.methods.get(self.call.request.method or "")

    @property
    def is_inherited(self) -> bool:
        """Is its method one of another interface that this one inherits (9.2.7.2)?"""
        return self.call.request.method in self.interface.inherited

    @property
    def over(self) -> int:
        """The event that ended it; later than all if none did."""
        return self.call.over

    @property
    def served(self) -> list[Delivery]:
        """The entries into its server."""
        return self.call.delivered_to(self.server.member, self.server.port)

    @property
    def exit(self) -> Exit | None:
        """How its server was left."""
        return self.served[0].exit if self.served else None

    def meets(self, other: ServiceCall) -> bool:
        """Was the other, a call of another client, in progress at the same time?"""
        apart = self.over < other.call.request.n or other.over < self.call.request.n
        return self.link is other.link and self.client is not other.client and not apart
