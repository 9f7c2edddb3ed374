"""Tables of test purposes: rows, names in texts, names that become values, and rows inside rows."""

from pathlib import Path

import pytest

from ucm_cts.adapters.contract.scenario import AddComponent, CreateContainer, Start
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.purposes.tables import purposes_of

TABLE = """
- rows:
    - {kind: plain, policies: [], places: [], place: null}
    - {kind: active, policies: [{definition: protected_active_component}], places: [{name: one}, {name: two}], place: two}
  id: some/$kind
  clause: 11.2.3
  text: A component is $kind.
  requirements: [R-11.2.3-01]
  scenarios:
    - name: some/$kind/only
      components: {server: {policies: $policies}}
      steps:
        - {rows: $places, op: create_container, bind: $name}
        - {op: add_component, component: server, container: $place}
        - {op: start}
"""


def test_row_becomes_a_purpose(tmp_path: Path) -> None:
    (tmp_path / "some.yaml").write_text(TABLE)
    plain, active = purposes_of("some", tmp_path)
    assert (plain.id, plain.text) == ("some/plain", "A component is plain.")
    ((name, scenario),) = plain.scenarios
    assert name == "some/plain/only"
    assert scenario.steps == (AddComponent("server"), Start())
    ((_, scenario),) = active.scenarios
    assert scenario.steps == (CreateContainer("one"), CreateContainer("two"), AddComponent("server", "two"), Start())
    assert scenario.components["server"].policies[0].definition == "protected_active_component"


def test_mistakes_are_reported(tmp_path: Path) -> None:
    (tmp_path / "some.yaml").write_text(TABLE.replace("op: start", "op: fly"))
    with pytest.raises(DocumentError, match=r"some\.yaml.*fly"):
        purposes_of("some", tmp_path)
    (tmp_path / "some.yaml").write_text(TABLE.replace("$places", "$spaces"))
    with pytest.raises(KeyError, match="spaces"):
        purposes_of("some", tmp_path)
