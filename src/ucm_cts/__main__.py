"""``python -m ucm_cts`` and ``ucm-cts``."""

from __future__ import annotations

import os
import sys
from contextlib import suppress


def _open_standard_streams() -> None:
    """Lead standard streams that are closed to nowhere: other files would get their numbers, and what is printed to them."""
    for number, name, mode in ((0, "stdin", "r"), (1, "stdout", "w"), (2, "stderr", "w")):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # it gets the lowest free number
        if getattr(sys, name) is None:
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115 - lives as long as we do


def _prefer_what_is_installed() -> None:
    """Search modules where adapters lie, which is the current folder and ``PYTHONPATH``, after those that are installed.

    An adapter beside which a file ``rich.py`` lies would else run in the harness.
    """
    theirs = {"", os.getcwd(), *os.environ.get("PYTHONPATH", "").split(os.pathsep)}
    sys.path.sort(key=lambda place: place in theirs)
    os.environ.setdefault("HYPOTHESIS_NO_PLUGINS", "1")  # it would import what other packages publish for it


def main() -> None:
    """Run the command line."""
    _open_standard_streams()
    with suppress(OSError):  # there is no current folder, which the command line says
        _prefer_what_is_installed()
    try:
        from ucm_cts.harness.cli.commands import main as command_line
    except KeyboardInterrupt:
        sys.stderr.write("ucm-cts: interrupted\n")
        sys.exit(3)
    command_line()


if __name__ == "__main__":
    main()
