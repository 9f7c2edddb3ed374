"""The subject of a claim: where headers declare it, and which failed claims make others meaningless."""

from __future__ import annotations

import re

from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.claims import Claim
from ucm_cts.reference_models.mapping.cpp.classes import Connected, Named, Returned

_AT_LAST = (claims.Implemented, claims.Runs)
_USED = (
    claims.Arity,
    claims.Passed,
    claims.Startup,
    claims.StartupTakes,
    claims.ConnectionTo,
    claims.ConnectionShape,
)
"""What implementations rely on, beside what is not there at all."""


def lacks(claim: Claim, failed: Claim) -> str:
    """What ``claim`` needs and ``failed`` says is not there; nothing if ``claim`` can be judged all the same."""
    if isinstance(failed, claims.Declares):
        return f"{failed.name} is not declared" if _speaks_of(claim, failed.name) and claim != failed else ""
    if isinstance(failed, claims.DeclaresConnection):
        return f"{failed.connection} is not declared" if _uses_connection(claim, failed) else ""
    if isinstance(failed, claims.Arity) and _uses_function(claim, failed):
        return f"{failed.method} is not declared"
    if isinstance(failed, claims.ReturnsReference) and _uses_result(claim, failed):
        return f"{failed.getter} leads to no class"
    if isinstance(claim, claims.Copied | claims.Changed | claims.Constructed) and _keeps_nothing(claim, failed):
        return f"a field of {claim.owner} cannot be written and read"
    if isinstance(claim, _AT_LAST) and isinstance(failed, _USED):
        return "what it uses is not as it should be" if _owner(claim) == _owner(failed) else ""
    return ""


def _keeps_nothing(claim: claims.Copied | claims.Changed | claims.Constructed, failed: Claim) -> bool:
    """Whether a field that ``claim`` uses is not as it should be."""
    used = [name for name, _ in claim.fields] if isinstance(claim, claims.Constructed) else [claim.field]
    return isinstance(failed, claims.Field) and failed.owner == claim.owner and failed.field in used


def line_of(claim: Claim, text: str) -> int:
    """The line of a header's ``text`` that declares what ``claim`` is about, counted from 1; 0 if there is none."""
    types = claim.types if isinstance(claim, claims.Works) else ("",)
    name = (_owner(claim) or _class_name(getattr(claim, "name", "")) or types[0]).rpartition("::")[2]
    if not name:
        return 0
    whole = rf"\b{re.escape(name)}\b"
    found = re.search(rf"\b(?:class|struct|enum|namespace)\s+(?:class\s+)?{whole}(?!\s*;)", text)
    found = found or re.search(rf"{whole}(?=\s*(?:;|=))", text)
    if found is None:
        return 0
    at = found.start()
    members = (getattr(claim, field, "") for field in ("method", "field", "case", "enumerator", "getter", "connection"))
    for member in filter(None, members):
        inside = re.search(rf"\b{re.escape(member)}\b", text[at:])
        at += inside.start() if inside else 0
    return text.count("\n", 0, at) + 1


def _owner(claim: Claim) -> str:
    """The class that the model's element became."""
    return _class_name(getattr(claim, "owner", getattr(claim, "derived", None)))


def _class_name(value: object) -> str:
    """The class that ``value`` names, or in which what it names stands; nothing if it names none."""
    if isinstance(value, Named):
        return value.name
    if isinstance(value, Returned | Connected):
        return value.owner
    return value if isinstance(value, str) else ""


def _speaks_of(claim: Claim, name: str) -> bool:
    for field in ("name", "owner", "derived"):
        value = getattr(claim, field, None)
        if value == name or (isinstance(value, Named) and value.name == name):
            return True
        if isinstance(value, Returned | Connected) and value.owner == name:
            return True
    return False


def _uses_connection(claim: Claim, failed: claims.DeclaresConnection) -> bool:
    if getattr(claim, "connection", None) == failed.connection and getattr(claim, "owner", None) == failed.owner:
        return claim != failed
    if getattr(claim, "owner", None) == Connected(failed.owner, failed.connection):
        return True
    startup = claim.startup if isinstance(claim, claims.StartupTakes) else claim
    if isinstance(startup, claims.Startup) and startup.owner == failed.owner:
        return failed.connection in startup.connections
    return isinstance(claim, _AT_LAST) and _owner(claim) == failed.owner


def _uses_result(claim: Claim, failed: claims.ReturnsReference) -> bool:
    reached = Returned(failed.owner, failed.getter)
    at_last = isinstance(claim, _AT_LAST) and _owner(claim) == failed.owner
    return at_last or getattr(claim, "owner", None) == reached


def _uses_function(claim: Claim, failed: claims.Arity) -> bool:
    same_class = getattr(claim, "owner", None) == failed.owner
    if isinstance(claim, claims.Passed | claims.Pure):
        return same_class and (claim.method, claim.parameters) == (failed.method, failed.parameters)
    if isinstance(claim, _AT_LAST):
        return _owner(claim) == _owner(failed)
    if isinstance(failed.owner, Named):
        reached = Returned(failed.owner.name, failed.method)
        if isinstance(claim, claims.ReturnsReference):
            return (claim.owner, claim.getter) == (reached.owner, reached.getter)
        return getattr(claim, "owner", None) == reached
    return False
