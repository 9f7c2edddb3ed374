"""``Gst``: GStreamer's Python binding (PyGObject), from the first place where this interpreter finds it.

It is mostly installed by the system's package manager, for the system's interpreter. A virtual environment does not see
it there, but can use it if it is one of the same version of Python. Raises ``ImportError`` that says what to install.
"""

from __future__ import annotations

import sys

_OF_THE_SYSTEM = "/usr/lib/python3/dist-packages"  # Debian and what is made from it

sys.path.append(_OF_THE_SYSTEM)
try:
    import gi

    gi.require_version("Gst", "1.0")
    from gi.repository import Gst
except (ImportError, ValueError) as error:  # ValueError: GStreamer itself is not there
    raise ImportError(
        f"GStreamer 1.x is not here for Python {sys.version_info.major}.{sys.version_info.minor} ({error}); on Debian: "
        "apt-get install python3-gi gir1.2-gstreamer-1.0, and install ucm-cts in an environment of /usr/bin/python3"
    ) from error
finally:
    sys.path.remove(_OF_THE_SYSTEM)

__all__ = ["Gst"]

Gst.init(None)
