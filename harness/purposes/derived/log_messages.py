"""Scenarios of the trace (10.1.4.2): texts and severities of messages.

A component writes when the test calls it; what was traced is read back afterwards, and once more after a pause, for records
that come late.
"""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario
from ucm_cts.harness.purposes.container_services import HAS_TRACE, TRACE
from ucm_cts.harness.purposes.scripts import TestPurpose

_CLAUSE = "10.1.4.2"
_COMMON = ("debug", "info", "warning", "error")
_UNPROTECTED = Policy(s.UNPROTECTED_PASSIVE)
_LATER = 30
"""Milliseconds until the log is read again."""

_IN_VAIN = 400
"""Milliseconds of patience for a record that must not come."""

_NARROW = (
    "x",
    "simple",
    "sentence with several words, a comma; and (brackets).",
    "percents %s %d %n %% {0} {name} $HOME \\n \\0 \\",
    "markup <b>&amp;</b> 'single' \"double\" `back` #5 ~tilde ^ | @",
    "spaces   between  ",
    "manywords" + " 0123456789abcdef" * 14 + " 56789ab",
)
"""ASCII, the last one of 255 characters."""

_WIDE = (
    "",
    "latinones äöüß éèê ñ ÿ",
    "otherones λόγος журнал 日志 سجل ログ",
    "beyondbmp \U0001d11e \U0001f600 \U00020000 \U0010fffd",
    "onelonger" + "." * 247,
    ("verylarge" + " lorem ipsum" * 5461)[:65_536],
)
"""Empty; beyond ASCII; beyond the BMP; of 256 and of 65,536 characters. A message begins with a word for which a run puts a random one of
nine letters (harness/execution/disguise.py), so the word of a long message has nine letters, too.
"""

_MANY = 250


def log_message_purposes() -> list[TestPurpose]:
    """All purposes; some are only for vendors with certain readings."""
    texts = ("R-10.1.4.2-53", "R-10.1.4.2-26", "R-10.1.4.2-25", "R-10.1.4.2-51")
    own = ("R-10.1.4.2-25", "R-10.1.4.2-26", "R-10.1.4.2-51")
    return [
        _purpose("log/narrow texts", "Messages of ASCII characters are written.", texts, _written("info", _NARROW)),
        _purpose(
            "log/wide texts",
            "Messages are written that are empty, long, not ASCII or beyond the Basic Multilingual Plane.",
            ("R-10.1.4.2-47", "R-10.1.4.2-26"),
            _written("error", _WIDE, more=1),
            under=("log-message=wide-unbounded",),
        ),
        _purpose(
            "log/many records",
            "So many messages are written that a seldom loss shows.",
            ("R-10.1.4.2-26", "R-10.1.4.2-25", "R-10.1.4.2-51"),
            _writing([(_COMMON[number % 4], f"record {number}") for number in range(_MANY)]),
        ),
        _purpose(
            "log/severities of the model",
            "Messages are written with the severities that only the model has.",
            own,
            _with_severities("trace", "critical"),
            under=("log-severity-set=model-6",),
        ),
        _purpose(
            "log/severities of IDL",
            "A message is written with the severity that only IDL has.",
            own,
            _with_severities("fatal"),
            under=("log-severity-set=idl-5",),
        ),
    ]


def _written(severity: str, texts: Sequence[str], more: int = 0) -> Scenario:
    """Waits for ``more`` records than the component writes: that one is missing shows only when it has been waited for in vain."""
    return _writing([(severity, text) for text in texts], more)


def _with_severities(*severities: str) -> Scenario:
    return _writing([(severity, f"message of {severity}") for severity in (*severities, *_COMMON)])


def _writing(messages: Sequence[tuple[str, str]], more: int = 0) -> Scenario:
    calls = tuple(s.CallMethod(TRACE, "log", message) for message in messages)
    policies = (_UNPROTECTED, HAS_TRACE)
    writer = Declaration(("in.api",), plan={"exchange": calls}, policies=policies)
    steps = (
        s.AddComponent("writer"),
        s.GetPortElement("writer", "in.api", "api"),
        s.Start(),
        s.Invoke("api", 1),
        s.ReadLog(len(messages) + more),
        *(() if more else (s.Pause(_LATER), s.ReadLog(len(messages)))),
        s.Stop(),
    )
    return Scenario({"writer": writer}, steps, _IN_VAIN) if more else Scenario({"writer": writer}, steps)


def _purpose(
    name: str, text: str, requirements: tuple[str, ...], scenario: Scenario, under: tuple[str, ...] = ()
) -> TestPurpose:
    return TestPurpose(name, _CLAUSE, text, requirements, ((name, scenario),), under=under)
