"""``ucm-cts-toolchain check|idl|cpp11|cpp03``: the reference tool chain at the command line."""

from __future__ import annotations

import gc
import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

import click

from ucm_cts.adapters.reference.toolchain.diagnostics import Diagnostic
from ucm_cts.adapters.reference.toolchain.program import Program, reference

ACCEPTED, REFUSED, WRONG_USE = 0, 1, 2

LARGEST = 1 << 30
"""Bytes a model may have."""

_model = click.argument("model", type=click.Path(dir_okay=False, path_type=Path))
_GENERATED = {
    "idl": "IDL",
    "cpp11": "C++11 headers",
    "cpp03": "C++03 headers",
    "lwucm": "what lwucm needs to host typed bodies beside the C++11 headers",
}
_out = click.option("--out", type=click.Path(file_okay=False, path_type=Path), required=True, help="Where files go.")


def command_line(program: Program) -> click.Group:
    """The commands of ``program``."""

    @click.group(name="ucm-cts-toolchain", context_settings={"help_option_names": ["-h", "--help"]})
    def group() -> None:
        """Check UCM models and generate code from them.

        Exit status: 0 the model is well-formed, 1 it is not, 2 wrong use.
        """

    @group.command()
    @click.argument(
        "models", nargs=-1, required=True, type=click.Path(dir_okay=False, path_type=Path), metavar="MODEL..."
    )
    def check(models: tuple[Path, ...]) -> None:
        """Say what is wrong with each MODEL for itself, a line each: FILE:LINE: error: MESSAGE [REQUIREMENT, clause]."""
        _print([diagnostic for model in models for diagnostic in _checked(program, model)])

    for task, what in _GENERATED.items():
        group.add_command(_generating(program, task, what))
    return group


def _generating(program: Program, task: str, what: str) -> click.Command:
    @click.command(name=task, help=f"Generate {what} from MODEL.")
    @_model
    @_out
    def generate(model: Path, out: Path) -> None:
        with _opened(model) as stream:
            files, diagnostics = program.generate(task, stream, str(model))
        for name, content in files.items():
            path = out / name
            try:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(content, encoding="utf-8")
            except OSError as error:
                raise click.ClickException(f"{path} cannot be written: {error.strerror}; name another folder") from None
        _print(diagnostics)

    return generate


def _checked(program: Program, model: Path) -> list[Diagnostic]:
    with _opened(model) as stream:
        return program.check(stream, str(model))[1]


@contextmanager
def _opened(path: Path) -> Iterator[BinaryIO]:
    """The file at ``path``, in which one can go back; what cannot be read is named."""
    try:
        with path.open("rb") as stream:
            found = stream if stream.seekable() else io.BytesIO(stream.read(LARGEST + 1))
            if found.seek(0, os.SEEK_END) > LARGEST:
                raise click.ClickException(f"{path} has more than {LARGEST} bytes; split it")
            yield found
    except OSError as error:
        raise click.ClickException(f"{path} cannot be read: {error.strerror}") from None


def _print(diagnostics: list[Diagnostic]) -> None:
    for diagnostic in diagnostics:
        click.echo(str(diagnostic))
    if diagnostics:
        sys.exit(REFUSED)


def main() -> None:
    """The console entry point."""
    run(reference())


def run(program: Program) -> None:
    """Do what the command line asks of ``program``."""
    gc.disable()  # a model lives as long as the process: looking for garbage in it would only take time
    try:
        command_line(program)(standalone_mode=False)
    except click.exceptions.Exit as end:
        sys.exit(end.exit_code)
    except click.ClickException as error:
        error.show()
        sys.exit(WRONG_USE)
    except (click.exceptions.Abort, KeyboardInterrupt):
        click.echo("ucm-cts-toolchain: interrupted", err=True)
        sys.exit(WRONG_USE)
