"""The calls of ``read_data`` of shared data (10.4.2.2), each with what its reader may read then."""

from __future__ import annotations

from dataclasses import dataclass

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.shared_data import is_disturbed
from ucm_cts.reference_models.model.shared_data_events import Publication, Reader, Session, SharedData, given
from ucm_cts.reference_models.model.shared_data_views import State, View, state_at, view_of


@dataclass(frozen=True)
class Reading:
    """A call of ``read_data`` with what is known of it.

    ``view``: what the reader may read.
    ``state``, ``session``: is it frozen, and by which session, or which was its last one?
    ``value``: what it got.
    """

    found: SharedData
    reader: Reader
    call: MethodCall
    view: View
    state: State
    session: Session | None
    value: Datum | None

    @property
    def published(self) -> list[Publication]:
        """The publications that had begun."""
        return [one for one in self.found.publications if one.since < self.call.over]

    @property
    def unread(self) -> list[Publication]:
        """The publications since the last read of this reader."""
        since = max((read.request.n for read in self.reader.reads if read.over < self.call.request.n), default=0)
        return [one for one in self.published if one.since > since]

    @property
    def previous(self) -> MethodCall | None:
        """The read of this reader before it, if nothing was published since."""
        reads = [read for read in self.reader.reads if read.over < self.call.request.n]
        if not reads or any(one.over > reads[-1].request.n for one in self.published):
            return None
        return reads[-1]


def reads_of(runtime: ObservedRuntime, found: SharedData) -> list[Reading]:
    """The calls of ``read_data`` that came back and that nothing disturbed."""
    return [
        Reading(found, reader, read, view_of(runtime, found, reader, read), *state_at(reader, read), given(read))
        for reader in found.readers
        for read in reader.reads
        if read.reply is not None and not read.reply.wrong and not is_disturbed(runtime, read)
    ]
