"""Which specification a verdict is about (``suite/specification.yaml``)."""

from __future__ import annotations

import functools

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE


class Specification(Value, frozen=True):
    """The specification that the requirements are taken from.

    ``acronym``, ``title`` and ``publisher``: what it is called, and who publishes it.
    ``version`` and ``document``: its version and document number, empty if its text names none.
    ``documents``: numbers of further documents that it names as its own, by what they hold.
    ``sha256``: the digest of its text as the authors of the suite had it.
    """

    acronym: str
    title: str
    publisher: str
    version: str
    document: str
    documents: dict[str, str]
    sha256: str

    @property
    def name(self) -> str:
        """What to call it where one line is all there is: publisher, acronym, version and document numbers."""
        what = " ".join(filter(None, (self.publisher, self.acronym, self.version)))
        numbers = [self.document] if self.document else [f"{held} {number}" for held, number in self.documents.items()]
        return f"{what} ({', '.join(numbers)})"


@functools.cache
def load_specification() -> Specification:
    """The specification of this suite. Raises ``DocumentError``."""
    return read(SUITE / "specification.yaml", Specification)
