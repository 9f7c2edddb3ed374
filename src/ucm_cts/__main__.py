"""``python -m ucm_cts`` and ``ucm-cts``."""

from __future__ import annotations

import sys
from pathlib import Path


def main() -> None:
    """Run the command line; ``--cmakedir`` prints where CMake finds the package."""
    if sys.argv[1:] == ["--cmakedir"]:
        print(Path(__file__).parent / "share" / "cmake" / "ucm_cts")
        return
    try:
        from ucm_cts.harness.cli.commands import main as command_line
    except KeyboardInterrupt:
        sys.stderr.write("ucm-cts: interrupted\n")
        sys.exit(3)
    command_line()


if __name__ == "__main__":
    main()
