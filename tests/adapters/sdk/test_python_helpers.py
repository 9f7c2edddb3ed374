"""The parts that short Python adapters are made of: forwarding, ids, bodies, references, policies, fragments as connectors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from fragment_framework import FragmentsAdapter, in_short, served
from performing import answer

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.adapter import Adapter, NotOffered
from ucm_cts.adapters.contract.programming_model import (
    Connectable,
    FragmentObject,
    Implementation,
    NotFound,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.bodies import Methods, References, initialise, port_connections
from ucm_cts.adapters.sdk.python.forwarding import ContainerMembers, ForwardingAdapter, Ids
from ucm_cts.adapters.sdk.python.loading import CannotLoad, load
from ucm_cts.adapters.sdk.python.policies import Policies, PortTrace


class Trouble(Exception):
    pass


class Lost(Trouble):
    pass


class Crate:
    """A framework of few operations, which fail as they are told."""

    def __init__(self) -> None:
        self.calls: list[Any] = []

    def put(self, *given: Any) -> str:
        self.calls.append(given)
        return f"thing-{len(self.calls)}"

    def connect(self, name: Any, port: str, target: Any) -> object:
        self.calls.append((name, port, target))
        return SimpleNamespace(port=port)

    def take(self, name: Any) -> None:
        self.calls.append(name)
        raise {"lost": Lost, "other": Trouble, "undeclared": KeyError}.get(name, Lost)("no")

    def start(self) -> None:
        raise KeyError("not an error of the framework's own")

    def get_components(self) -> list[str]:
        return ["thing-9", "thing-1"]


class CrateAdapter(ForwardingAdapter):
    product = "Crate"
    errors: Any = {Trouble: UcmError, Lost: NotFound}
    names: Any = {"add_component": "put", "remove_component": "take"}
    numbered = True
    references = References(lambda own, value: own + value)

    def __init__(self) -> None:
        """Without a call of the base class's, as strangers write it."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> Crate:
        return Crate()

    def configuration(self, implementation: str, attributes: Mapping[str, str]) -> Sequence[Any]:
        return implementation, *attributes.items()

    def to_suite(self, reference: Any) -> PortElementObject | None:
        return self.references.wrap(reference)

    def to_framework(self, reference: PortElementObject | None) -> Any:
        return self.references.unwrap(reference)


def test_operations_are_forwarded_with_the_frameworks_own_names_ids_and_references() -> None:
    adapter = CrateAdapter()
    crate = adapter.create_runtime(())
    added = adapter.add_component(crate, "kind", {"a": "1"})
    connection = adapter.connect(crate, added, "out", adapter.to_suite(5))
    assert crate.calls == [("kind", ("a", "1")), ("thing-1", "out", 5)]
    assert (added, connection) == (1, 1)
    assert adapter.get_components(crate) == [2, 1], "a member that nobody added is seen, too"


def test_errors_get_their_declared_names_and_others_pass() -> None:
    adapter = CrateAdapter()
    crate = adapter.create_runtime(())
    for own, declared in (("lost", NotFound), ("other", UcmError), ("undeclared", KeyError)):
        with pytest.raises(declared):
            adapter.remove_component(crate, adapter.components.number(own))
    with pytest.raises(NotFound):
        adapter.remove_component(crate, 77)
    assert crate.calls == ["lost", "other", "undeclared", None], "an unknown id reaches the framework"
    with pytest.raises(KeyError):
        adapter.start(crate)


def test_what_the_framework_lacks_fails_and_of_profile_core_is_not_offered() -> None:
    adapter = CrateAdapter()
    crate = adapter.create_runtime(())
    with pytest.raises(UcmError, match="Crate has no stop"):
        adapter.stop(crate)
    with pytest.raises(NotOffered):
        adapter.link(crate, s.SERVICE_CONNECTOR, d.Interface({}))


def test_equal_ids_have_one_number_and_keep_it() -> None:
    ids = Ids(unknown="nobody")
    unhashable: list[int] = []
    assert ids.numbers(["a", "b", "a", unhashable, [], unhashable]) == [1, 2, 1, 3, 4, 3]
    assert ids.own(2) == "b"
    assert ids.own(3) is unhashable
    assert ids.own(77) == "nobody"


def test_hint_names_an_adapter_that_is_complete(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "crates.py").write_text(
        "from ucm_cts.adapters.sdk.python.forwarding import ForwardingAdapter\n"
        "class Crates(ForwardingAdapter):\n    def create_runtime(self, implementations): ...\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(CannotLoad, match=r"did you mean crates:Crates$"):
        load("crates")
    with pytest.raises(CannotLoad, match=r"; there is Crates$"):
        load("crates:Other")


@pytest.mark.parametrize("field", ["product", "version", "port_element_name"])
def test_what_an_adapter_says_of_itself_is_text(field: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / f"no_{field}.py").write_text(
        "from ucm_cts.adapters.sdk.python.forwarding import ForwardingAdapter\n"
        "class Crates(ForwardingAdapter):\n    def create_runtime(self, implementations): ...\n"
        f"    {field} = property(lambda self: 'x')\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(CannotLoad, match=f"^no_{field}:Crates has a {field} that is no text; write {field} = "):
        load(f"no_{field}:Crates")


def test_references_come_back_as_they_were() -> None:
    references = References(lambda own, value: own + value)
    wrapped = references.wrap(5)
    assert wrapped is not None
    assert (wrapped.exchange(2), references.unwrap(wrapped)) == (7, 5)
    assert references.wrap(None) is references.unwrap(None) is None
    foreign = Methods()
    assert references.unwrap(foreign) is foreign
    with pytest.raises(UcmError):
        wrapped.call("ask", [])


def test_port_elements_of_functions() -> None:
    clock = Methods(get_local_time=lambda: [[1, 2]])
    assert clock.call("get_local_time", []) == [[1, 2]]
    with pytest.raises(UcmError):
        clock.call("log", ["info", "text"])
    with pytest.raises(UcmError):
        clock.exchange(1)


class Noted(FragmentObject):
    """A fragment that notes its calls."""

    def __init__(self) -> None:
        self.calls: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        return lambda *arguments: self.calls.append((name, *arguments))

    def set_container_interface(self, container: Any) -> None:
        self.calls.append(container)


def test_first_calls_of_a_body_are_in_order() -> None:
    adapter = CrateAdapter()
    members = ContainerMembers(adapter, adapter.create_runtime(()))
    body: Any = Noted()
    initialise(body, {"a": "1"}, members)
    assert body.calls == [("set_attribute", "a", "1"), members, ("on_init",)]
    assert members.get_components() == [1, 2]
    plain: Any = SimpleNamespace(on_init=lambda: None)
    assert not isinstance(plain, Connectable)
    initialise(plain, {}, members)


def test_references_of_one_port_element_are_one_connection() -> None:
    a, b, c = Methods(), Methods(), Methods()
    assert port_connections([("x", a), ("y", b), ("x", c)]) == [PortConnection("x", (a, c)), PortConnection("y", (b,))]


def test_policies_are_sorted() -> None:
    other = s.Policy("other")
    policies = Policies.of(
        (
            s.Policy(s.ACTIVE, "in"),
            s.Policy(s.ACTIVE, "also"),
            s.Policy(s.CLOCK, element="clock_clock_api"),
            s.Policy(s.PORT_TRACE, "in", {s.METHODS_TO_TRACE: "ask, tell", s.LOG_SEVERITY: "info"}),
            s.Policy(s.PORT_TRACE),
            other,
        )
    )
    assert policies == Policies(
        (s.ACTIVE,),
        ("in", "also"),
        {"clock_clock_api": s.CLOCK},
        (PortTrace("in", frozenset({"ask", "tell"}), "info"), PortTrace(None, frozenset(), "")),
        (other,),
    )
    assert policies.execution == s.ACTIVE
    assert Policies.of(()).execution == s.UNPROTECTED_PASSIVE
    with pytest.raises(UcmError):
        _ = Policies.of((s.Policy(s.ACTIVE, "in"), s.Policy(s.PROTECTED_PASSIVE))).execution


def outcomes(adapter: type[Adapter], *steps: s.Step) -> list[Any]:
    traced = answer(served(*steps), adapter)
    assert isinstance(traced, m.Traced), traced
    return in_short(traced.events)


def test_connectors_made_of_fragments_behave_like_others() -> None:
    steps = (
        s.GetComponents(),
        s.Attach("l", "server", "S", "in"),
        s.Break("l"),
        s.Invoke("go", 1),
        s.Mend("l"),
        s.Detach("l", "C", "out"),
        s.Stop(),
        s.RemoveComponent("S"),
        s.Detach("l", "C", "out"),
        s.Detach("l", "C", "out"),
        s.Detach("l", "S", "in"),
        s.RemoveComponent("S"),
        s.Start(),
        s.Destroy(),
    )
    events = outcomes(FragmentsAdapter, *steps)
    assert events == [
        ((7,), False),
        2,
        "UCM_ERROR",
        (None, True),
        "UCM_ERROR",
        "UCM_ERROR",
        "NOT_FOUND",
        "UCM_ERROR",
    ]
    others = outcomes(ReferenceAdapter, *steps)
    assert others[:5] == events[:5], "up to the removal of a server, which is not in use there"


def test_ends_that_cannot_be_made_leave_no_fragment() -> None:
    again = (
        s.Stop(),
        s.Attach("l", "client", "C", "out"),
        s.Attach("l", "client", "C", "go"),
        s.Attach("l", "server", "C", "go"),
    )
    events = outcomes(FragmentsAdapter, *again, s.GetComponents())
    assert events == [((7,), False), "UCM_ERROR", "BAD_PARAMETER", "BAD_PARAMETER", 2]
