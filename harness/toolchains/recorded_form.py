"""The record of a run on a tool chain as bytes, and back: nothing in hostile bytes gets further than one line that refuses them."""

from __future__ import annotations

import datetime
import math
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath

import msgspec

from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.results.foreign import clean, one_line
from ucm_cts.harness.toolchains.commands.description import check_description
from ucm_cts.harness.toolchains.recording import Said, ToolChainRecord

LARGEST = 64 << 20
"""Bytes that a record may have."""

MOST_FILES, MOST_CHARACTERS = 2_000, 64 << 20
"""Files, and characters in them, that may come of one model."""

MOST_GENERATED = 512 << 20
"""Characters in the files of all models; one that comes of several models counts each time."""

MOST_JOBS, LONGEST = 4_096, 366 * 86_400.0
"""Calls at a time, and seconds of a run."""

LONGEST_NAME, LONGEST_PART = 1_000, 255
"""Bytes that the name of a generated file may have, and each part between slashes."""

_PLACE = Path("the record")


class RecordError(Exception):
    """Bytes are no record, or a run cannot be kept as one; the text is one line that says why."""

    def __init__(self, problem: str) -> None:
        super().__init__(one_line(problem, 400))


def encoded(record: ToolChainRecord) -> bytes:
    """``record`` as JSON. Raises ``RecordError`` if it is beyond the limits, or holds what ``decoded`` refuses."""
    try:
        data = msgspec.json.encode(record)
    except (UnicodeEncodeError, msgspec.MsgspecError, ValueError) as error:
        raise RecordError(f"the run cannot be recorded: {error}") from None
    _check_size(data, "the tool chain printed and wrote too much for one")
    _check(record)
    return data


def decoded(data: bytes) -> ToolChainRecord:
    """The record that ``data`` is. Raises ``RecordError``."""
    _check_size(data, "it is refused")
    try:
        record = msgspec.json.decode(data, type=ToolChainRecord)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError, ValueError) as error:
        raise RecordError(f"the record of the tool chain cannot be read: {error}") from None
    _check(record)
    if msgspec.json.encode(record) != data:
        raise RecordError("the record of the tool chain is not in the form in which the suite writes records")
    return record


def _check_size(data: bytes, otherwise: str) -> None:
    if len(data) > LARGEST:
        raise RecordError(f"the record of the tool chain has more than {LARGEST >> 20} MiB; {otherwise}")


def _check(record: ToolChainRecord) -> None:
    """What types do not say. Raises ``RecordError``."""
    if record.toolchain.command_for(record.task) is None:
        raise RecordError(f"the record does not say how the tool chain did '{record.task}'")
    try:
        check_description(_PLACE, record.toolchain, {})
    except DocumentError as error:
        raise RecordError(str(error)) from None
    if record.toolchain.folder or record.toolchain.source:
        raise RecordError("the record names the folder of the tool chain, which is nobody's business")
    if not _is_moment(record.started):
        raise RecordError(
            f"the record says that the run began at '{record.started}', which is no date with a time and a zone"
        )
    times = [record.seconds, *(moment for call in record.calls for moment in (call.begun, call.ended))]
    if not all(math.isfinite(moment) and 0 <= moment <= LONGEST for moment in times):
        raise RecordError("the record holds a time that no run takes")
    if not 1 <= record.jobs <= MOST_JOBS:
        raise RecordError(f"the record says that {record.jobs} calls went on at a time; 1 to {MOST_JOBS} can")
    asked = [(call.again_for, said.name) for call in record.calls for said in call.said]
    if len(set(asked)) != len(asked) or not all(call.said for call in record.calls):
        raise RecordError("the record has two answers for one model, or a call without any")
    if any(
        not call.again_for and before.again_for for before, call in zip(record.calls, record.calls[1:], strict=False)
    ):
        raise RecordError("the record has a first look after a second one")
    _check_references(record)
    for said in _answers(record):
        _check_files(said, record)
    generated = sum(len(record.texts[number]) for said in _answers(record) for number in said.files.values())
    if generated > MOST_GENERATED:
        raise RecordError(f"the record holds more than {MOST_GENERATED >> 20} Mi characters of generated files")


def _answers(record: ToolChainRecord) -> Iterator[Said]:
    return (said for call in record.calls for said in call.said)


def _is_moment(text: str) -> bool:
    """Whether ``text`` is a date and a time with a zone, ISO 8601."""
    try:
        return datetime.datetime.fromisoformat(text).tzinfo is not None
    except ValueError:
        return False


def _check_references(record: ToolChainRecord) -> None:
    """Each text and each command is there once, and in the order in which it is first referred to."""
    for what, held, used in (
        ("commands", record.commands, [said.command for said in _answers(record)]),
        ("texts", record.texts, [n for said in _answers(record) for n in (said.output, *said.files.values())]),
    ):
        if list(dict.fromkeys(used)) != list(range(len(held))):
            raise RecordError(f"the record does not hold its {what} as calls refer to them")
        if len(set(held)) != len(held):
            raise RecordError(f"the record holds some of its {what} twice")


def _check_files(said: Said, record: ToolChainRecord) -> None:
    """Files can be written below any folder, and nowhere else."""
    if len(said.files) > MOST_FILES or sum(len(record.texts[n]) for n in said.files.values()) > MOST_CHARACTERS:
        raise RecordError(
            f"{one_line(said.name, 80)}: more files, or more in them, than a tool chain may write for one model"
        )
    for name in said.files:
        why = why_no_file(name)
        if why:
            raise RecordError(
                f"{one_line(said.name, 80)}: a generated file is called '{one_line(name, 80)}', which {why}"
            )
    both = _files_and_folders(said.files)
    if both:
        raise RecordError(
            f"{one_line(said.name, 80)}: '{one_line(both, 80)}' is both a generated file and a folder of others"
        )


def why_no_file(name: str) -> str:
    """Why no file below a folder is called ``name``; empty if one may be."""
    parts = name.split("/")
    if name.startswith("/"):
        return "is an absolute path"
    if ".." in parts:
        return "leads out of its folder"
    if "" in parts or "." in parts:
        return "is no plain path"
    if clean(name, len(name)) != name or "\n" in name or "\t" in name:
        return "holds characters that no file should"
    if len(name.encode()) > LONGEST_NAME or any(len(part.encode()) > LONGEST_PART for part in parts):
        return "is too long"
    return ""


def _files_and_folders(files: Mapping[str, object]) -> str:
    """A name that is that of a file and of a folder; empty if there is none."""
    folders = {str(folder) for name in files for folder in PurePosixPath(name).parents}
    return next((name for name in files if name in folders), "")
