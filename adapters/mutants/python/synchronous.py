"""A message connector that delivers on the emitter's thread, for wrong frameworks to spoil."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.reference.python.connectors import OK, Link, Taker


class Synchronous(Link):
    """Messages are delivered by the emitter's thread."""

    def _emit(self, method: str, arguments: Sequence[Datum]) -> str:
        if self.broken:
            return super()._emit(method, arguments)
        for taker in self.takers:
            if taker.entrance.is_open:
                self._hand_over(taker, method, self._copied(arguments))
        return OK

    def _hand_over(self, taker: Taker, method: str, arguments: list[Datum]) -> None:
        with suppress(Exception):
            taker.enter(method, arguments)
