"""One check of C++: a claim, its probe, and its lines in the translation unit."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from ucm_cts.harness.toolchains.cpp.listing import LISTED, RULE
from ucm_cts.harness.toolchains.cpp.probes.text import Text, connection_declared, connection_missing
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.expected import Expected

CHECKS = {
    "cpp_probes": "A probe, compiled and run against the headers, finds each declaration to be what the mapping says.",
    "cpp_headers": "Each header compiles alone and twice, and all together in either order, as the standard of the profile, and redefines no keyword.",
    "cpp_body": "Classes that implement the abstract classes, with all that they inherit, compile, link and are called.",
    "cpp_unexpected": "libclang finds nothing in the headers that the mapping excludes and no probe could see.",
    "cpp_generated": "The tool chain writes files for each legal model.",
    "cpp_decoration": "Annotations and comments in a model change nothing of what is generated.",
}
"""What the rules do."""

GENERATED = ("R-13-05", "cpp_generated")
"""The requirement that files can be had of legal models at all, and its rule."""

HEADERS = {"cpp11": "R-13-04", "cpp03": "R-13.10-01"}
"""The requirement that headers compile."""

_RESULT = re.compile(r"(begin|kept|broken|over|end) (\d+) ?(.*)")


def rule_of(claim: claims.Claim) -> str:
    """The rule that checks ``claim``."""
    if isinstance(claim, claims.Implemented | claims.Runs):
        return "cpp_body"
    return RULE if isinstance(claim, LISTED) else "cpp_probes"


@dataclass(frozen=True)
class Check:
    """A claim with its probe; ``number`` is unique in the translation unit."""

    number: int
    expected: Expected
    text: Text
    rule: str

    @property
    def tag(self) -> str:
        """What diagnostics call it instead of a file."""
        return f"{self.expected.requirement}#{self.number}"


def needed_support(claim: claims.Claim) -> str:
    """The class template of the framework that a probe for ``claim`` needs, empty for none."""
    match claim:
        case claims.ArrayOf() | claims.Sizes():
            return "array"
        case claims.SafeEnum() | claims.SafeEnumInner():
            return "safe_enum"
        case claims.ConnectionTo() | claims.ReturnsReference() | claims.ConnectionShape():
            return "shared_ptr"
    return ""


def outside(check: Check, is_left: bool) -> Iterator[str]:
    """The lines of ``check`` before all probes; ``is_left`` says whether its probe is compiled."""
    claim = check.expected.claim
    if isinstance(claim, claims.DeclaresConnection):
        declared = connection_declared if is_left else connection_missing
        yield f'#line 1 "{check.tag}"'
        yield declared(claim.owner, claim.connection)


def inside(check: Check) -> Iterator[str]:
    """The lines of the probe of ``check``."""
    yield f'#line 1 "{check.tag}"'
    body = "using ::ucts::operator==; " if "==" in check.text.declared + check.text.run else ""
    body += check.text.declared
    if check.text.run:
        body += f" inline void run_it() {{ {check.text.run} }}"
    yield f"namespace ucts_check_{check.number} {{ {body} }}"


def calls(checks: Iterable[Check]) -> Iterator[str]:
    """The lines of ``main`` that run the probes."""
    return (f"::ucts::run({c.number}, &ucts_check_{c.number}::run_it);" for c in checks if c.text.run)


def results(path: Path, token: str) -> Iterator[tuple[str, int, str]]:
    """What the program said in lines that begin with the ``token`` that it was given, and only those: headers may print, too."""
    text = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
    for line in text.split("\n"):
        match = _RESULT.fullmatch(line.removeprefix(f"{token} ")) if line.startswith(f"{token} ") else None
        if match is not None:
            yield match[1], int(match[2]), match[3]
