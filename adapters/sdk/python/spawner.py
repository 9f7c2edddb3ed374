"""A template for executable adapters: ``python -m ucm_cts.adapters.sdk.python.spawner PATH --control DESCRIPTOR [--preload LIBRARY]``.

The harness itself starts nothing: this small process forks quickly, reports how hosts end, and takes them along when
it or the harness ends, in every case.
"""

from __future__ import annotations

import argparse
import os
import signal
import socket
import sys
from typing import NoReturn

from ucm_cts.adapters.sdk.python.template import Template


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("path")
    parser.add_argument("--control", type=int, required=True)
    parser.add_argument("--preload", default="", help="a library that hosts load before all others")
    options = parser.parse_args()
    path: str = options.path
    environment = dict(os.environ)
    if options.preload:
        environment["LD_PRELOAD"] = ":".join(filter(None, (options.preload, environment.get("LD_PRELOAD"))))

    def become_host(source: int, target: int) -> NoReturn:
        os.dup2(source, 0)
        os.dup2(target, 1)
        os.closerange(3, max(source, target) + 1)
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
        try:
            os.execve(path, [path], environment)
        except OSError as error:
            print(f"{path} cannot be run: {error.strerror}", file=sys.stderr, flush=True)
            os._exit(127)

    Template(socket.socket(fileno=options.control), become_host).serve()


if __name__ == "__main__":
    main()
