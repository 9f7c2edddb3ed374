"""The archive of a certificate (``.ucmcert``): a zip file of which each byte is prescribed.

The members have fixed names, stand in a fixed order and are stored as they are. So the bytes of an archive follow from its
members: one that holds the same and has other bytes was made by somebody else, and is refused.
"""

from __future__ import annotations

import io
import stat
import struct
import zipfile
from collections.abc import Iterator, Mapping

import zstandard

from ucm_cts.harness.certificates.problems import Problem, Unreadable, unreadable
from ucm_cts.harness.results.foreign import one_line

ENVELOPE, REPORT, STATEMENT, MODELS = "envelope.json", "report.json", "statement.json", "models.json"
WAIVERS, ENVIRONMENT, CHALLENGE, RECORD = "waivers.json", "environment.json", "challenge.json", "record.zst"

_MIB = 1 << 20

LARGEST: Mapping[str, int] = {
    ENVELOPE: 8 * _MIB,
    REPORT: 64 * _MIB,
    STATEMENT: _MIB,
    MODELS: 8 * _MIB,
    WAIVERS: _MIB,
    ENVIRONMENT: _MIB,
    CHALLENGE: _MIB,
    RECORD: 64 * _MIB,
}
"""The members in their order, and the bytes that each may have."""

OPTIONAL = (MODELS, CHALLENGE)
"""Members that not every certificate has: the vendor's own models, and an auditor's challenge."""

LARGEST_ARCHIVE = 128 * _MIB
"""Bytes an archive may have."""

LARGEST_RECORD = 128 * _MIB
"""Bytes a record may have when it is unpacked."""

_WINDOW = 128 * _MIB
_LEVEL = 10
_START, _END = b"PK\x03\x04", b"PK\x05\x06"
_END_SIZE = 22
_MOST_MEMBERS = 64


def written(members: Mapping[str, bytes]) -> bytes:
    """The archive that holds ``members``."""
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_STORED) as archive:
        for name in LARGEST:
            if name in members:
                info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
                info.create_system, info.external_attr = 3, (stat.S_IFREG | 0o644) << 16
                archive.writestr(info, members[name])
    return target.getvalue()


def read(data: bytes) -> dict[str, bytes]:
    """The members of the archive ``data``. Raises ``Unreadable`` with all that is wrong with it."""
    _check_ends(data)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            problems = [*_wrong(archive)]
            if problems:
                raise Unreadable(*problems)
            members = {}
            for info in archive.infolist():
                try:
                    members[info.filename] = archive.read(info)
                except zipfile.BadZipFile:
                    problems.append(_problem(f"'{info.filename}' was damaged or changed: its checksum is wrong"))
    except (zipfile.BadZipFile, NotImplementedError, struct.error, ValueError, EOFError, OverflowError, OSError):
        raise unreadable("archive", "the table of the archive cannot be read; it was cut or changed") from None
    if problems:
        raise Unreadable(*problems)
    if written(members) != data:
        raise unreadable(
            "archive",
            "the archive has bytes that belong to no member, or fields that ucm-cts writes otherwise; it was written by another program",
        )
    return members


def packed(record: bytes) -> bytes:
    """``record``, compressed."""
    return zstandard.ZstdCompressor(_LEVEL, write_checksum=True, write_content_size=True).compress(record)


def unpacked(content: bytes) -> bytes:
    """The record in ``content``. Raises ``Unreadable`` before it takes more memory than a record may have."""
    try:
        size = zstandard.frame_content_size(content)
        if size < 0:
            raise unreadable("record", f"'{RECORD}' does not say how large it is")
        if size > LARGEST_RECORD:
            raise unreadable(
                "record", f"'{RECORD}' would have {size:,} bytes unpacked; a record has at most {LARGEST_RECORD:,}"
            )
        return zstandard.ZstdDecompressor(max_window_size=_WINDOW).decompress(
            content, read_across_frames=False, allow_extra_data=False
        )
    except zstandard.ZstdError:
        raise unreadable("record", f"'{RECORD}' cannot be unpacked, or something follows it") from None


def _problem(detail: str) -> Problem:
    return Problem("archive", detail)


def _check_ends(data: bytes) -> None:
    if not data:
        raise unreadable("archive", "the file is empty")
    if len(data) > LARGEST_ARCHIVE:
        raise unreadable("archive", f"the file has more than {LARGEST_ARCHIVE:,} bytes, the most of a certificate")
    end = data.rfind(_END)
    if not data.startswith(_START):
        if end >= 0 and _START in data:
            raise unreadable(
                "archive", "something stands before the archive; a certificate begins with its first member"
            )
        raise unreadable("archive", "this is no certificate: no archive begins here")
    if end < 0 or end + _END_SIZE > len(data):
        raise unreadable("archive", "the archive was cut: its end is missing; get the certificate again")
    comment = int.from_bytes(data[end + 20 : end + _END_SIZE], "little")
    if comment:
        raise unreadable("archive", "the archive has a comment; a certificate has none")
    if end + _END_SIZE < len(data):
        raise unreadable("archive", f"{len(data) - end - _END_SIZE} bytes follow the end of the archive")


def _wrong(archive: zipfile.ZipFile) -> Iterator[Problem]:
    infos = archive.infolist()
    if len(infos) > _MOST_MEMBERS:
        yield _problem(f"the archive has {len(infos):,} members; a certificate has at most {len(LARGEST)}")
        return
    for info in infos:
        yield from map(_problem, _wrong_member(info))
    names = [info.filename for info in infos]
    known = [name for name in names if name in LARGEST]
    for name in dict.fromkeys(name for name in known if known.count(name) > 1):
        yield _problem(f"'{name}' is in the archive {known.count(name)} times")
    for name in LARGEST:
        if name not in names and name not in OPTIONAL:
            yield _problem(f"'{name}' is missing")
    if list(dict.fromkeys(known)) != [name for name in LARGEST if name in known]:
        yield _problem(f"the members stand in another order than {', '.join(n for n in LARGEST if n in known)}")


def _wrong_member(info: zipfile.ZipInfo) -> Iterator[str]:
    shown = f"'{one_line(info.filename, 60)}'"
    kind = stat.S_IFMT(info.external_attr >> 16)
    if info.filename.startswith(("/", "\\")) or ".." in info.filename.replace("\\", "/").split("/"):
        yield f"{shown} leads out of the archive (path traversal)"
    elif info.is_dir():
        yield f"{shown} is a folder; a certificate has none"
    elif info.filename not in LARGEST:
        yield f"{shown} is no member of a certificate"
    if kind == stat.S_IFLNK:
        yield f"{shown} is a link; a certificate has none"
    elif kind not in (0, stat.S_IFREG, stat.S_IFDIR):
        yield f"{shown} is a device, a pipe or a socket; a certificate has none"
    if info.flag_bits & 1:
        yield f"{shown} is encrypted; a certificate can be read by everybody"
    if info.compress_type != zipfile.ZIP_STORED:
        yield f"{shown} is compressed by the archive, to {info.file_size:,} bytes unpacked; members are stored as they are"
    if info.comment:
        yield f"{shown} has a comment; a certificate has none"
    if info.extra:
        yield f"{shown} has extra fields; a certificate has none"
    most = LARGEST.get(info.filename, LARGEST_ARCHIVE)
    if info.file_size > most:
        yield f"{shown} is said to have {info.file_size:,} bytes; it has at most {most:,}"
