"""``python -m ucm_cts`` and ``ucm-cts``."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def _open_standard_streams() -> None:
    """Lead standard streams that are closed to nowhere: other files would get their numbers, and what is printed to them."""
    for number, name, mode in ((0, "stdin", "r"), (1, "stdout", "w"), (2, "stderr", "w")):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # it gets the lowest free number
        if getattr(sys, name) is None:
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115 - lives as long as we do


def main() -> None:
    """Run the command line; ``--cmakedir`` prints where CMake finds the package."""
    if sys.argv[1:] == ["--cmakedir"]:
        folder = Path(__file__).parent / "share" / "cmake" / "ucm_cts"
        if not folder.is_dir():
            sys.stderr.write(
                "ucm-cts: this installation has no CMake package: install a C++ compiler, cmake and nlohmann-json3-dev, then "
                "ucm-cts again, with UCM_CTS_COMPILED=1 to see what is missing\n"
            )
            sys.exit(2)
        print(folder)
        return
    _open_standard_streams()
    try:
        from ucm_cts.harness.cli.commands import main as command_line
    except KeyboardInterrupt:
        sys.stderr.write("ucm-cts: interrupted\n")
        sys.exit(3)
    command_line()


if __name__ == "__main__":
    main()
