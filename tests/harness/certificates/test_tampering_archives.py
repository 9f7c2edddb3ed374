"""Hostile archives: each way has its own line, and nothing is unpacked."""

from __future__ import annotations

import stat
import zipfile
from collections.abc import Callable

import pytest
from forging import forger_of, intact, ordered, verify, zipped

from ucm_cts.harness.certificates import archive

MEMBERS = forger_of(intact()).members
NAMES = list(ordered(MEMBERS))


def _entry(name: str, change: Callable[[zipfile.ZipInfo], None]) -> bytes:
    """The archive, with a ``change`` of one entry."""
    return zipped(ordered(MEMBERS), lambda info: change(info) if info.filename == name else None)


def _set(**fields: object) -> Callable[[zipfile.ZipInfo], None]:
    def change(info: zipfile.ZipInfo) -> None:
        for name, value in fields.items():
            setattr(info, name, value)

    return change


def _kind(kind: int) -> Callable[[zipfile.ZipInfo], None]:
    return _set(external_attr=(kind | 0o644) << 16)


def _with(name: str, content: bytes = b"{}") -> bytes:
    return zipped({**ordered(MEMBERS), name: content})


def _without(name: str) -> bytes:
    return zipped({key: content for key, content in ordered(MEMBERS).items() if key != name})


def _twice(name: str) -> bytes:
    import io
    import warnings

    target = io.BytesIO(zipped(ordered(MEMBERS)))
    with warnings.catch_warnings(), zipfile.ZipFile(target, "a") as made:
        warnings.simplefilter("ignore")
        made.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), b"{}")
    return target.getvalue()


def _commented() -> bytes:
    import io

    target = io.BytesIO(intact())
    with zipfile.ZipFile(target, "a") as made:
        made.comment = b"hello"
    return target.getvalue()


def _flipped(where: int) -> bytes:
    data = bytearray(intact())
    data[where] ^= 1
    return bytes(data)


def _bomb() -> bytes:
    return zipped({**ordered(MEMBERS), "record.zst": bytes(30_000_000)}, compression=zipfile.ZIP_DEFLATED)


def _reordered() -> bytes:
    return zipped(dict(reversed(ordered(MEMBERS).items())))


def _many() -> bytes:
    return zipped({f"m{number}": b"" for number in range(1000)})


def _hidden_between() -> bytes:
    """Bytes between two members, which the table of the archive does not name."""
    data, extra = intact(), b"hidden"
    end = data.rfind(b"PK\x05\x06")
    start = int.from_bytes(data[end + 16 : end + 20], "little")
    tail = data[end : end + 16] + (start + len(extra)).to_bytes(4, "little") + data[end + 20 :]
    return data[:start] + extra + data[start:end] + tail


def _encrypted() -> bytes:
    data = bytearray(intact())
    table = data.find(b"PK\x01\x02")
    data[table + 8] |= 1
    return bytes(data)


def _local_name() -> bytes:
    """The entry of the table has another name than the member itself."""
    return intact().replace(b"statement.json", b"statemenX.json", 1)


def _said_larger() -> bytes:
    data = bytearray(intact())
    table = data.find(b"PK\x01\x02")
    data[table + 24 : table + 28] = (4_000_000_000).to_bytes(4, "little")
    return bytes(data)


ARCHIVES: dict[str, tuple[Callable[[], bytes], str]] = {
    "empty": (lambda: b"", "is empty"),
    "no archive": (lambda: b"hello, I am a certificate", "no archive begins here"),
    "cut in the middle": (lambda: intact()[: len(intact()) // 2], "was cut: its end is missing"),
    "cut at the end": (lambda: intact()[:-7], "was cut: its end is missing"),
    "something before": (lambda: b"#!/bin/sh\n" + intact(), "something stands before the archive"),
    "something after": (lambda: intact() + b"tail", "4 bytes follow the end"),
    "comment of the archive": (_commented, "the archive has a comment"),
    "comment of a member": (lambda: _entry("report.json", _set(comment=b"x")), "'report.json' has a comment"),
    "extra fields": (lambda: _entry("report.json", _set(extra=b"\x99\x99\x00\x00")), "'report.json' has extra fields"),
    "path traversal": (lambda: _with("../../etc/passwd"), "leads out of the archive"),
    "path traversal of other systems": (lambda: _with("..\\..\\boot.ini"), "leads out of the archive"),
    "absolute path": (lambda: _with("/etc/passwd"), "leads out of the archive"),
    "folder": (lambda: _with("folder/"), "'folder/' is a folder"),
    "surplus member": (lambda: _with("readme.txt"), "'readme.txt' is no member of a certificate"),
    "link": (lambda: _entry("record.zst", _kind(stat.S_IFLNK)), "'record.zst' is a link"),
    "pipe": (lambda: _entry("record.zst", _kind(stat.S_IFIFO)), "'record.zst' is a device, a pipe or a socket"),
    "device": (lambda: _entry("record.zst", _kind(stat.S_IFCHR)), "'record.zst' is a device, a pipe or a socket"),
    "compressed bomb": (_bomb, "is compressed by the archive, to 30,000,000 bytes unpacked"),
    "encrypted": (_encrypted, "'envelope.json' is encrypted"),
    "member twice": (lambda: _twice("report.json"), "'report.json' is in the archive 2 times"),
    "other order": (_reordered, "stand in another order"),
    "thousands of members": (_many, "has 1,000 members"),
    "damaged member": (lambda: _flipped(400), "was damaged or changed: its checksum is wrong"),
    "hidden bytes": (_hidden_between, "cannot be read|belong to no member"),
    "other name in the table": (_local_name, "cannot be read|checksum|belong to no member"),
    "said to be large": (_said_larger, "said to have 4,000,000,000 bytes|cannot be read"),
    "other permissions": (
        lambda: _entry("report.json", _kind(stat.S_IFREG | stat.S_ISUID)),
        "written by another program",
    ),
    "other date": (lambda: _entry("report.json", _set(date_time=(2020, 1, 1, 0, 0, 0))), "written by another program"),
    **{f"{name} is missing": (lambda name=name: _without(name), f"'{name}' is missing") for name in NAMES},  # type: ignore[misc]
}


@pytest.mark.parametrize("way", ARCHIVES)
def test_each_hostile_archive_has_its_own_line(way: str) -> None:
    make, detail = ARCHIVES[way]
    verified = verify(make())
    assert {problem.check for problem in verified.problems} == {"archive"}
    import re

    assert re.search(detail, " / ".join(problem.detail for problem in verified.problems)), verified.problems


def test_several_faults_of_an_archive_are_told_together() -> None:
    members = {**ordered(MEMBERS), "../x": b"", "note.txt": b""}
    del members["waivers.json"]
    details = [problem.detail for problem in verify(zipped(members)).problems]
    assert len(details) == 3
    assert all(any(word in detail for detail in details) for word in ("leads out", "note.txt", "waivers.json"))


def test_a_record_that_grows_is_refused_before_it_is_unpacked() -> None:
    import zstandard

    forger = forger_of(intact())
    forger.members[archive.RECORD] = zstandard.ZstdCompressor(1).compress(bytes(archive.LARGEST_RECORD + 1))
    (problem,) = verify(forger.resigned()).problems
    assert problem.check == "record"
    assert "134,217,729 bytes unpacked" in problem.detail


@pytest.mark.parametrize("way", ["cut", "followed", "no size", "text"])
def test_a_record_must_be_one_whole_frame(way: str) -> None:
    import zstandard

    forger = forger_of(intact())
    packed = forger.members[archive.RECORD]
    unsized = zstandard.ZstdCompressor(1, write_content_size=False).compressobj()
    forger.members[archive.RECORD] = {
        "cut": packed[:-9],
        "followed": packed + b"more",
        "no size": unsized.compress(b"x" * 100) + unsized.flush(),
        "text": b"no record",
    }[way]
    assert [problem.check for problem in verify(forger.resigned()).problems] == ["record"]
