"""Changes of certificates, by those who cannot sign them and by those who can."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
from forging import (
    Forger,
    forger_of,
    intact,
    made_report,
)

from ucm_cts.harness.certificates.verified import Verified

FIRST = made_report().requirements[0].id
SECOND = made_report().requirements[1].id


def vendor(change: Callable[[Forger], object], kind: str = "plain") -> bytes:
    """The vendor changes what is to be signed, and signs it again."""
    forger = forger_of(intact(kind))
    change(forger)
    return forger.resigned()


def claimed(**changes: Any) -> Callable[[Forger], None]:
    """Changes what the certificate claims of its run."""

    def change(forger: Forger) -> None:
        forger.claims = msgspec.structs.replace(forger.claims, **changes)

    return change


def set_place(*path: str, to: Any) -> Callable[[Any], Any]:
    """Sets one place of a JSON document."""

    def change(document: Any) -> Any:
        inner = document
        for key in path[:-1]:
            inner = inner[key]
        inner[path[-1]] = to
        return document

    return change


def deep(depth: int = 100_000) -> bytes:
    """JSON that is nested deeper than any reader may follow."""
    return b"[" * depth + b"]" * depth


def flipped_verdict(forger: Forger) -> None:
    """What failed is said to have passed."""
    forger.requirement(FIRST, verdict="pass", findings=())
    forger.report(verdict="conformant")


def assert_refused(verified: Verified, check: str, detail: str) -> None:
    """One of the problems that were told is of ``check`` and says ``detail``."""
    found = [problem for problem in verified.problems if problem.check == check and detail in problem.detail]
    assert found, verified.problems
