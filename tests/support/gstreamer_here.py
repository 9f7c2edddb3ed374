"""Whether GStreamer is here; where the system has it for this version of Python, it has to be found."""

from __future__ import annotations

import importlib
import subprocess
import sys
from typing import Any

import pytest

_ADAPTER = "ucm_cts.adapters.integrations.gstreamer.adapter"
_ASK = """
import sys, gi
gi.require_version("Gst", "1.0")
from gi.repository import Gst
print(*sys.version_info[:2], sep=".")
"""


def gstreamer_adapter() -> Any:
    """The module ``ucm_cts.adapters.integrations.gstreamer.adapter``. Skips the test where GStreamer is not installed."""
    if _version_of_the_system() == f"{sys.version_info.major}.{sys.version_info.minor}":
        return importlib.import_module(_ADAPTER)
    return pytest.importorskip(_ADAPTER, exc_type=ImportError)


def _version_of_the_system() -> str:
    """The version of Python for which the system has GStreamer, empty if it has not."""
    try:
        asked = subprocess.run(["/usr/bin/python3", "-c", _ASK], capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return asked.stdout.strip()
