"""The subject of explorations in tests, and what an exploration writes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

SUBJECT, REQUIREMENT = "subjects:stops_in_startup_order", "R-11.2.2.1-13"
MENDED = "subjects:Mended"
REFERENCE = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"


def exploration(folder: Path) -> Any:
    """The document that an exploration has left in ``folder``."""
    return json.loads((folder / "exploration.json").read_text())
