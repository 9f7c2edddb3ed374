"""Cleans foreign text: text of a framework under test is bounded and made harmless before it is shown.

Products, error details and stack traces come from the framework and may hold anything: markup, terminal escapes, NULs,
lone surrogates, megabytes. Each format escapes markup; this module removes everything else.
"""

from __future__ import annotations

import re
from typing import Any, TypeVar

import msgspec

from ucm_cts.harness.results.values import Report

AnyReport = TypeVar("AnyReport", bound=Report)

LONGEST = 2_000
"""Characters that a single text of a report may have."""

LONGEST_STACKS = 16_000
"""Characters that the stacks of an incident may have."""

_CONTROL = {code: chr(0x2400 + code) for code in range(32) if chr(code) not in "\t\n"} | {127: "\u2421"}
_UNSAFE = re.compile(
    "[\u0080-\u009f\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]"
)
_SPACE = re.compile(r"\s+")


def clean(text: str, limit: int = LONGEST) -> str:
    """``text`` bounded to ``limit`` characters, with control characters shown and those that mislead replaced."""
    left_out = len(text) - limit
    if left_out > 0:
        text = text[:limit]
    text = _UNSAFE.sub("\ufffd", text.replace("\r\n", "\n").translate(_CONTROL))
    return f"{text} [{left_out} more characters left out]" if left_out > 0 else text


def one_line(text: str, limit: int = 200) -> str:
    """``text`` on one line, at most ``limit`` characters long, with an ellipsis for the rest."""
    text = _SPACE.sub(" ", clean(text[: 4 * limit], 4 * limit)).strip()
    return text if len(text) <= limit else text[: limit - 1] + "…"


def clean_report(report: AnyReport) -> AnyReport:
    """The same report with every text cleaned."""
    return msgspec.convert(_walk(msgspec.to_builtins(report)), type(report))


def _walk(value: Any, limit: int = LONGEST) -> Any:
    if isinstance(value, str):
        return clean(value, limit)
    if isinstance(value, dict):
        return {
            clean(key, 200): _walk(item, LONGEST_STACKS if key == "stacks" else limit) for key, item in value.items()
        }
    if isinstance(value, list | tuple):
        return [_walk(item, limit) for item in value]
    return value
