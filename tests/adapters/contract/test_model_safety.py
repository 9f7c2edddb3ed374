"""Hostile models are refused with one clear line, in time and memory that do not depend on their expansion."""

from __future__ import annotations

import tracemalloc

import pytest

from ucm_cts.adapters.contract.metamodel import reading as reading_module
from ucm_cts.adapters.contract.metamodel.contracts import ContractModule
from ucm_cts.adapters.contract.metamodel.reading import DEEPEST, LONGEST, Problem, read_model

MEGABYTE = 1 << 20


def only(xml: bytes) -> Problem:
    """The one problem of a model that is not read."""
    reading = read_model(xml, "m.xml")
    (problem,) = reading.problems
    assert reading.model.modules == ()
    assert problem.message.isprintable()
    assert len(problem.message) < 200
    return problem


def names(xml: bytes) -> list[str]:
    reading = read_model(xml, "m.xml")
    assert reading.problems == ()
    return [module.name for module in reading.model.modules]


BOMB = b"".join(b'<!ENTITY e%d "%s">' % (n, b"&e%d;" % (n - 1) * 10 if n else b"boom") for n in range(10))
MODULE = '<ContractModule name="é"/>'

DOCTYPES = {
    "empty": b"<!DOCTYPE ContractModule>",
    "bomb": b"<!DOCTYPE ContractModule [%s]>" % BOMB,
    "file": b'<!DOCTYPE ContractModule [<!ENTITY e9 SYSTEM "file:///etc/hostname">]>',
    "schema from elsewhere": b'<!DOCTYPE ContractModule SYSTEM "http://localhost/m.dtd">',
    "parameters": b'<!DOCTYPE ContractModule [<!ENTITY % p SYSTEM "file:///dev/zero"> %p;]>',
    "default attributes": b'<!DOCTYPE ContractModule [<!ATTLIST ContractModule name CDATA "m">]>',
    "after a comment": b"<!-- <x> --><?p?>\n<!DOCTYPE ContractModule>",
}


@pytest.mark.parametrize("doctype", DOCTYPES.values(), ids=DOCTYPES.keys())
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_document_types_are_refused(doctype: bytes, encoding: str) -> None:
    xml = (doctype + b'<ContractModule name="&e9;"/>').decode().encode(encoding)
    assert "take the DOCTYPE out" in only(xml).message


def test_undeclared_entities_are_refused() -> None:
    assert only(b'<ContractModule name="&e9;"/>').kind == "not XML"


ENCODINGS = {
    "UTF-8": MODULE.encode(),
    "a byte order mark": MODULE.encode("utf-8-sig"),
    "UTF-16": MODULE.encode("utf-16"),
    "UTF-16 without a mark": f'<?xml version="1.0" encoding="utf-16"?>{MODULE}'.encode("utf-16-be"),
    "Latin-1": f'<?xml version="1.0" encoding="ISO-8859-1"?>{MODULE}'.encode("latin-1"),
    "ASCII": b'<?xml version="1.0" encoding="US-ASCII"?><ContractModule name="&#233;"/>',
}


@pytest.mark.parametrize("xml", ENCODINGS.values(), ids=ENCODINGS.keys())
def test_encodings_of_xml_are_read(xml: bytes) -> None:
    assert names(xml) == ["é"]


WRONG_ENCODINGS = {
    "Latin-1 that says nothing": MODULE.encode("latin-1"),
    "Latin-1 that says UTF-8": f'<?xml version="1.0" encoding="UTF-8"?>{MODULE}'.encode("latin-1"),
    "UTF-8 that says UTF-16": f'<?xml version="1.0" encoding="UTF-16"?>{MODULE}'.encode(),
    "UTF-8 that says ASCII": f'<?xml version="1.0" encoding="US-ASCII"?>{MODULE}'.encode(),
    "UTF-32": MODULE.encode("utf-32"),
    "UTF-7": f'<?xml version="1.0" encoding="UTF-7"?>{MODULE}'.encode("utf-7"),
    "an unknown encoding": f'<?xml version="1.0" encoding="zork"?>{MODULE}'.encode(),
    "no encoding of text": f'<?xml version="1.0" encoding="hex"?>{MODULE}'.encode(),
    "a long name": f'<?xml version="1.0" encoding="z{"o" * 100_000}rk"?>{MODULE}'.encode(),
    "half a character": MODULE.encode()[:23] + b'"/>',
    "a surrogate": b'<ContractModule name="\xed\xa0\x80"/>',
    "too long a form": b'<ContractModule name="\xc0\xaf"/>',
    "UTF-16 of odd length": MODULE.encode("utf-16") + b"\0",
}


@pytest.mark.parametrize("xml", WRONG_ENCODINGS.values(), ids=WRONG_ENCODINGS.keys())
def test_wrong_encodings_are_refused(xml: bytes) -> None:
    assert only(xml).kind in ("not XML", "refused")


BROKEN = {
    "nothing": b"",
    "space": b" \n ",
    "a mark alone": b"\xef\xbb\xbf",
    "a NUL in a name": b'<ContractModule name="a\0"/>',
    "a NUL at the end": MODULE.encode() + b"\0",
    "NULs": b"\0" * 1000,
    "a reference to NUL": b'<ContractModule name="&#0;"/>',
    "a truncated tag": b'<ContractModule name="m',
    "a truncated module": b'<ContractModule name="m">',
    "two roots": MODULE.encode() * 2,
    "two of one attribute": b'<ContractModule name="m" name="n"/>',
    "two of one attribute in a namespace": b'<ContractModule name="m" xmlns:a="u" xmlns:b="u" a:x="1" b:x="1"/>',
    "an undeclared prefix": b'<ContractModule name="m" x:y="1"/>',
    "tags that cross": b'<ContractModule name="m"><Structure name="s"></ContractModule></Structure>',
    "JSON": b'{"name": "m"}',
    "XML 1.1": b'<?xml version="1.1"?><ContractModule name="m\x01"/>',
    "a program": b"\x7fELF\x02\x01\x01" + bytes(100),
}


@pytest.mark.parametrize("xml", BROKEN.values(), ids=BROKEN.keys())
def test_bytes_that_are_no_xml_are_reported(xml: bytes) -> None:
    assert only(xml).kind == "not XML"


def test_truncated_files_are_reported_with_their_last_line() -> None:
    assert only(b'<ContractModule name="m">\n\n<Structure name="s"').line == 3


def test_depth_is_bounded() -> None:
    known = b'<ContractModule name="m">'
    deepest = known * DEEPEST + b"</ContractModule>" * DEEPEST
    assert names(deepest) == ["m"]
    for element, end in ((known, b"</ContractModule>"), (b"<Zork>", b"</Zork>")):
        deep = known + element * 100_000 + end * 100_000 + b"</ContractModule>"
        reading = read_model(deep, "m.xml")
        assert reading.problems[-1].message == f"is nested deeper than {DEEPEST} elements; make it flatter"


LONG = b"a" * (3 * LONGEST)
GIANTS = {
    "attribute": b'<ContractModule name="%s"/>' % LONG,
    "comment": b"<!--%s--><ContractModule name='m'/>" % LONG,
    "tag": b"<%s/>" % LONG,
    "instruction": b"<?p %s?><ContractModule name='m'/>" % LONG,
}


@pytest.mark.parametrize("xml", GIANTS.values(), ids=GIANTS.keys())
def test_giants_are_refused(xml: bytes) -> None:
    assert only(xml).kind == "refused"


def test_much_text_is_refused() -> None:
    reported = read_model(b"<ContractModule name='m'>%s</ContractModule>" % LONG, "m.xml").problems
    assert [problem.kind for problem in reported] == ["text", "refused"]


def test_giants_below_the_limit_are_read() -> None:
    name = "a" * (LONGEST // 2)
    assert names(f'<ContractModule name="{name}"/>'.encode()) == [name]
    reported = read_model(
        f'<ContractModule name="{name}" {name}=""><{name}/></ContractModule>'.encode(), "m.xml"
    ).problems
    assert [problem.kind for problem in reported] == ["unknown element", "unknown attribute"]
    assert all(len(problem.message) < 1000 for problem in reported)


def test_memory_is_bounded_by_the_size_of_the_file() -> None:
    xml = b'<ContractModule name="m">%s</ContractModule>' % (b"<Zork><a/><b/></Zork>" * 100_000)
    tracemalloc.start()
    try:
        reported = read_model(xml, "m.xml").problems
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert reported[-1].kind == "refused"
    assert most < 8 * MEGABYTE


def test_many_siblings_are_read() -> None:
    xml = b'<ContractModule name="m">%s</ContractModule>' % (b'<Structure name="s"/>' * 100_000)
    (module,) = read_model(xml, "m.xml").model.modules
    assert isinstance(module, ContractModule)
    assert len(module.data_types) == 100_000


def test_size_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    xml = b"<ContractModule name='m'><Structure name='s'/></ContractModule>"
    assert names(xml) == ["m"]
    monkeypatch.setattr(reading_module, "MOST_TAGS", 2)
    assert only(xml).message == "has more than 2 tags; split it"
    monkeypatch.setattr(reading_module, "LARGEST", 10)
    assert only(xml).message == "is larger than 10 bytes; split it"


@pytest.mark.parametrize(
    "number", ["9" * 20, "9" * 21, "9" * 100_000, "-" * 10, "0" * 21, "1e9", "0x10", "NaN", "٣", "1_000"]
)
def test_numbers_are_bounded(number: str) -> None:
    reading = read_model(
        f'<ContractModule name="m"><NativeType name="t" maxSize="{number}"/></ContractModule>'.encode(), "m.xml"
    )
    assert [problem.kind for problem in reading.problems] == ([] if number == "9" * 20 else ["bad number"])
