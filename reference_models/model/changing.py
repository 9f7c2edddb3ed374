"""The base of what changes while a trace is read."""

from __future__ import annotations

import msgspec


class Changing(msgspec.Struct, eq=False):
    """A part of the model that changes, and equals nothing but itself. Structs take a third of the time of dataclasses to make: every
    operation of a trace makes several.
    """
