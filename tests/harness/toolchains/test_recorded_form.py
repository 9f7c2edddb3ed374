"""Records of tool chains as bytes: hostile ones are refused in one line, and nothing in them leads out of a folder."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import Any

import msgspec
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from recorded_toolchains import recorded

from ucm_cts.harness.certificates.toolchain_rejudging import judge_toolchain_again
from ucm_cts.harness.toolchains.recorded_form import RecordError, decoded, encoded, why_no_file
from ucm_cts.harness.toolchains.recording import ToolChainRecord


def a_record() -> ToolChainRecord:
    return recorded("idl", "data_types").record


def refusal(data: bytes) -> str:
    with pytest.raises(RecordError) as refused:
        decoded(data)
    text = str(refused.value)
    assert text
    assert "\n" not in text
    assert len(text) <= 400
    return text


def changed(**fields: object) -> bytes:
    """The bytes of a record with other fields at its top."""
    return json.dumps(json.loads(encoded(a_record())) | fields, separators=(",", ":"), ensure_ascii=False).encode()


def changed_answer(**fields: object) -> bytes:
    """The same for the first answer."""
    plain = json.loads(encoded(a_record()))
    plain["calls"][0]["said"][0] |= fields
    return json.dumps(plain, separators=(",", ":"), ensure_ascii=False).encode()


def files_called(*names: str) -> dict[str, int]:
    """The files of the first answer, the first of them under other ``names``."""
    (_, number), *others = a_record().calls[0].said[0].files.items()
    return {**dict.fromkeys(names, number), **dict(others)}


def test_a_record_comes_back_as_it_was() -> None:
    assert decoded(encoded(a_record())) == a_record()


def test_it_does_not_tell_where_the_tool_chain_was() -> None:
    assert a_record().toolchain.folder == a_record().toolchain.source == ""


def test_a_file_that_comes_of_many_models_is_kept_once() -> None:
    record = recorded("idl", "data_types or interfaces").record
    used = [number for call in record.calls for said in call.said for number in said.files.values()]
    assert len(set(used)) < len(used)
    assert len(set(record.texts)) == len(record.texts)


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("/etc/passwd", "is an absolute path"),
        ("../up.h", "leads out of its folder"),
        ("a/../../up.h", "leads out of its folder"),
        ("a//b.h", "is no plain path"),
        ("./b.h", "is no plain path"),
        ("", "is no plain path"),
        ("a/", "is no plain path"),
        ("a\u0000b.h", "holds characters that no file should"),
        ("a\nb.h", "holds characters that no file should"),
        ("a\u202eb.h", "holds characters that no file should"),
        ("x" * 300, "is too long"),
        ("x/" * 600 + "x", "is too long"),
    ],
)
def test_names_that_no_file_may_have(name: str, why: str) -> None:
    assert why in refusal(changed_answer(files=files_called(name)))


@pytest.mark.parametrize("name", ["a.h", "a/b/c.hpp", "ünïcode.idl", "with space.h", "..a", "a..b/c", "\\xff.h", "-o"])
def test_names_that_files_may_have(name: str) -> None:
    assert not why_no_file(name)


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "cannot be read"),
        (b"\xff\xfe", "cannot be read"),
        (b"[" * 100_000, "cannot be read"),
        (b'{"toolchain":' * 50_000, "cannot be read"),
        (b"null", "cannot be read"),
        (b" " * ((64 << 20) + 1), "has more than 64 MiB"),
    ],
)
def test_what_is_no_record(data: bytes, why: str) -> None:
    assert why in refusal(data)


@pytest.mark.parametrize(
    ("fields", "why"),
    [
        ({"unheard_of": 1}, "unknown field"),
        ({"started": "yesterday"}, "no date with a time and a zone"),
        ({"started": "2026-11-23"}, "no date with a time and a zone"),
        ({"seconds": 1e300}, "a time that no run takes"),
        ({"seconds": -1.0}, "a time that no run takes"),
        ({"jobs": 0}, "0 calls went on at a time"),
        ({"jobs": 10**9}, "1000000000 calls went on at a time"),
        ({"jobs": 10**30}, "calls went on at a time"),
        ({"task": "cpp11"}, "does not say how the tool chain did 'cpp11'"),
        ({"task": "rm"}, "cannot be read"),
        ({"texts": []}, "does not hold its texts"),
        ({"commands": [["x"], ["y"]]}, "does not hold its commands"),
    ],
)
def test_what_no_record_says(fields: dict[str, Any], why: str) -> None:
    assert why in refusal(changed(**fields))


@pytest.mark.parametrize(
    ("described", "why"),
    [
        ({"product": " "}, "product is empty"),
        ({"folder": "/home/them"}, "names the folder of the tool chain"),
        ({"seconds": 0}, "seconds is greater than 0"),
        ({"dialect": {"tags": {"Structure": "no name"}}}, "is no name of XML"),
        ({"idl": {"command": ["x", "{model}", "{out}"], "diagnostic": "(?P<line>"}}, "no regular expression"),
        ({"idl": {"command": ["x", "{model}", "{out}"], "refuses": [0]}}, "0 accepts it"),
        ({"idl": {"command": []}}, "the command for idl is empty"),
    ],
)
def test_descriptions_are_checked_as_in_a_file(described: dict[str, Any], why: str) -> None:
    toolchain = json.loads(msgspec.json.encode(a_record().toolchain))
    assert why in refusal(changed(toolchain=toolchain | described))


def test_references_lead_to_something() -> None:
    assert "does not hold its texts" in refusal(changed_answer(output=999))
    assert "does not hold its texts" in refusal(changed_answer(output=-1))
    assert "does not hold its commands" in refusal(changed_answer(command=5))


def test_one_answer_for_one_model() -> None:
    plain = json.loads(encoded(a_record()))
    plain["calls"] *= 2
    assert "two answers for one model" in refusal(json.dumps(plain, separators=(",", ":")).encode())


def test_a_name_is_a_file_or_a_folder() -> None:
    assert "both a generated file and a folder" in refusal(changed_answer(files=files_called("a", "a/b")))


def test_one_form_for_one_record() -> None:
    spaced = json.dumps(json.loads(encoded(a_record()))).encode()
    assert "not in the form in which the suite writes" in refusal(spaced)
    assert "not in the form in which the suite writes" in refusal(changed(warnings=[]))


def test_a_run_that_cannot_be_recorded_is_said() -> None:
    record = a_record()
    call, *others = record.calls
    said = msgspec.structs.replace(call.said[0], files=files_called("a\nb"))
    call = msgspec.structs.replace(call, said=(said, *call.said[1:]))
    with pytest.raises(RecordError, match="holds characters that no file should"):
        encoded(msgspec.structs.replace(record, calls=(call, *others)))


values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8) | st.sampled_from(["../x", "/x"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=6,
)


def places_in(value: Any, place: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [place, *(deeper for key, inner in items for deeper in places_in(inner, (*place, key)))]


PLAIN = encoded(a_record())
PLACES = places_in(json.loads(PLAIN))[1:]


def never_harms(data: bytes) -> None:
    """Either a refusal, or a record that can be judged without a traceback."""
    record = None
    with contextlib.suppress(RecordError):
        record = decoded(data)
    if record is not None and record.task == "idl":
        judge_toolchain_again(record, recorded("idl", "data_types").plan, is_vouched_for=False, expression="data_types")


@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
@given(place=st.sampled_from(PLACES), value=values)
def test_no_value_anywhere_does_harm(place: tuple[Any, ...], value: Any) -> None:
    plain = json.loads(PLAIN)
    inner = plain
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = value
    never_harms(json.dumps(plain, separators=(",", ":")).encode(errors="surrogatepass"))


@settings(max_examples=100, deadline=None, suppress_health_check=list(HealthCheck))
@given(first=st.integers(0, len(PLAIN)), length=st.integers(0, 40), put=st.binary(max_size=20))
def test_no_bytes_do_harm(first: int, length: int, put: bytes) -> None:
    never_harms(PLAIN[:first] + put + PLAIN[first + length :])


@settings(max_examples=100, deadline=None)
@given(name=st.text(max_size=30) | st.lists(st.sampled_from(["..", ".", "", "a", "/", "\\", "\x00"])).map("/".join))
def test_a_name_that_is_taken_stays_below_its_folder(name: str) -> None:
    if not why_no_file(name):
        folder = Path("/nowhere/below")
        assert (folder / name).resolve().is_relative_to(folder)
        assert (folder / name).resolve() != folder
