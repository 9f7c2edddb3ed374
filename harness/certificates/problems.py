"""What is wrong with a certificate."""

from __future__ import annotations

from ucm_cts.adapters.contract.value import Value


class Problem(Value, frozen=True):
    """One reason why a certificate does not stand.

    ``check``: a fixed word for each way of failing: ``signature``, ``digest``, ``record``, ``verdict``, ``report``, ...
    ``detail``: what is wrong, where, and what to do, on one line.
    """

    check: str
    detail: str
