"""Each error in a document gives one clear message with file and line."""

from __future__ import annotations

import datetime
from pathlib import Path

import pytest

from ucm_cts.harness.catalogue.documents import LARGEST, DocumentError
from ucm_cts.harness.purposes.scripts import read_scripts
from ucm_cts.harness.results.known_failures import KnownFailure, load_known_failures, waiver_for
from ucm_cts.reference_models.findings import Finding

GOOD = """\
scenario: one
components:
  server: {probe: sink}
steps:
  - {op: add_component, component: server}
  - {op: start}
"""

BAD = {
    "unknown field": (GOOD.replace("{op: start}", "{op: start, force: true}"), 6, "force"),
    "unknown operation": (GOOD.replace("op: start", "op: begin"), 6, "begin"),
    "wrong type": (GOOD.replace("component: server}", "component: 5}"), 5, "int"),
    "missing field": (GOOD.replace(", component: server", ""), 5, "component"),
    "unknown probe": (GOOD.replace("sink", "sonk"), 3, "sonk"),
    "unbound variable": (GOOD + "  - {op: remove_component, id: client}\n", 7, "client"),
    "no container": (GOOD.replace("{op: start}", "{op: start, container: nil}"), 6, "nil"),
    "no component": (GOOD + "  - {op: remove_component, id: nil}\n", 7, "nil"),
    "unknown gate": (GOOD + "  - {op: open, gate: g}\n", 7, "gate"),
    "reserved name": (GOOD.replace("server:", "manager:"), 3, "reserved"),
    "duplicate key": (GOOD + "steps: []\n", 7, "twice"),
    "anchor": (GOOD.replace("{probe: sink}", "&a {probe: sink}"), 3, "anchors"),
    "tag": (GOOD.replace("probe: sink", "probe: !!python/object:os.system sink"), 3, "tag"),
    "broken yaml": (GOOD + "  - {op: [\n", 8, "YAML"),
    "too deep": ("a: " + "[" * 5000 + "]" * 5000, 1, "nests"),
    "empty": ("", 1, "empty"),
    "huge number": (GOOD.replace("op: start", "op: start, thread: " + "9" * 400), 6, "number"),
}


@pytest.mark.parametrize(("text", "line", "word"), BAD.values(), ids=BAD.keys())
def test_error_names_file_line_and_problem(tmp_path: Path, text: str, line: int, word: str) -> None:
    path = tmp_path / "script.yaml"
    path.write_text(text)
    with pytest.raises(DocumentError) as caught:
        read_scripts(path)
    message = str(caught.value)
    assert message.startswith(f"{path}:{line}: "), message
    assert word in message


def test_messages_are_one_line_without_control_characters(tmp_path: Path) -> None:
    path = tmp_path / "script.yaml"
    for odd in ("\\e[31m\\u202e\\n\\r", "x" * 1_000_000):
        path.write_text(GOOD.replace("sink", f'"{odd}"'))
        with pytest.raises(DocumentError) as caught:
            read_scripts(path)
        message = str(caught.value)
        assert message.isprintable()
        assert len(message) < 1000


def test_known_failures_match_without_end_of_stars() -> None:
    finding = Finding("R", "rule", "cause", "expected", "stop shut down " + "ab" * 500)
    for pattern, fits in {
        "*" + "a*" * 300 + "c": False,
        "stop*" + "a*" * 300: True,
        "stop shut down *": True,
        "*shut*down*b": True,
        "stop": False,
        "*ba*ab": True,
        "stop*stop shut down *": False,
        "": False,
        "*": True,
        finding.observed: True,
        f"{finding.observed}*": True,
        f"{finding.observed}*b": False,
    }.items():
        entry = KnownFailure("R", pattern, "why", "2099-12-31")
        assert waiver_for(finding, [entry]) == ("why" if fits else ""), pattern


HOSTILE_LISTS = {
    "no list": ("requirement: R-11.2.3-15\n", 1, "array"),
    "no entry": ("- 5\n", 1, "object"),
    "not a date": ("- {requirement: R-11.2.3-15, observed: x, reason: y, expires: " + "9" * 40 + "}\n", 1, "number"),
    "tag": ("- !!python/object:os.system x\n", 1, "tag"),
    "aliases": ("- &a [*a, *a]\n", 1, "anchors"),
    "deep": ("[" * 10_000, 1, "nests"),
    "huge": ("#" * (LARGEST + 1), None, "larger"),
}


@pytest.mark.parametrize(("text", "line", "word"), HOSTILE_LISTS.values(), ids=HOSTILE_LISTS.keys())
def test_bad_known_failures(tmp_path: Path, text: str, line: int | None, word: str) -> None:
    path = tmp_path / "known.yaml"
    path.write_text(text)
    with pytest.raises(DocumentError) as caught:
        load_known_failures(path, ["R-11.2.3-15"], datetime.date(2030, 1, 1))
    assert str(caught.value).startswith(f"{path}:{line}: " if line else f"{path}: ")
    assert word in str(caught.value)


def test_good_script_is_read(tmp_path: Path) -> None:
    path = tmp_path / "script.yaml"
    path.write_text(GOOD)
    assert [script.scenario for script in read_scripts(path)] == ["one"]


def test_not_utf8_too_large_and_missing(tmp_path: Path) -> None:
    path = tmp_path / "script.yaml"
    path.write_bytes(b"a: 1\nb: \xff\n")
    with pytest.raises(DocumentError, match=r":2: is not UTF-8"):
        read_scripts(path)
    path.write_bytes(b"#" * (LARGEST + 1))
    with pytest.raises(DocumentError, match="larger"):
        read_scripts(path)
    with pytest.raises(DocumentError, match="cannot be read"):
        read_scripts(tmp_path / "nowhere.yaml")
    with pytest.raises(DocumentError, match="cannot be read"):
        read_scripts(tmp_path)
