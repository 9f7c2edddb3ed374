"""Deprecated: ``python -m ucm_cts.adapters.python.host`` still serves; the module is ``ucm_cts.adapters.sdk.python.host``."""

from __future__ import annotations

import sys

from ucm_cts.adapters.sdk.python.host import main, serve

__all__ = ["main", "serve"]

if __name__ == "__main__":
    print(f"{__spec__.name} is deprecated: use ucm_cts.adapters.sdk.python.host", file=sys.stderr)
    main()
