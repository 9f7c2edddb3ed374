"""Says what a published name stands for: ``python -m ucm_cts.adapters.sdk.python.naming MODULE NAME DESCRIPTOR``.

Importing the module runs its code, so the harness has this process do it. One line of JSON goes to the descriptor: ``{"path": TEXT}``,
``{"type": NAME}`` of anything that is no path, or ``{"fails": REASON}``.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
from contextlib import suppress
from functools import reduce
from pathlib import Path


def main() -> None:
    module, name, descriptor = sys.argv[1:]
    line = (json.dumps(_meaning(module, name)) + "\n").encode()
    with suppress(OSError):
        os.write(int(descriptor), line)
    os._exit(0)  # whatever threads the module has started


def _meaning(module: str, name: str) -> dict[str, str]:
    try:
        found: object = reduce(getattr, name.split("."), importlib.import_module(module))
        return {"path": str(found)} if isinstance(found, str | Path) else {"type": type(found).__name__}
    except (Exception, SystemExit) as error:  # noqa: BLE001 - it may do anything
        return {"fails": f"{type(error).__name__}: {error}"}


if __name__ == "__main__":
    main()
