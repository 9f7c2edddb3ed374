"""Bad documents give one clear message with file and line, whatever is wrong with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from ucm_cts.harness.documents import LARGEST, DocumentError
from ucm_cts.harness.scenarios.scripts import read_scripts

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
