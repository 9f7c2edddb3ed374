"""Sends traces of an earlier run again with new names, after as much time as they took.

For unknown scenarios it runs a framework that stops in the wrong order.
"""

from __future__ import annotations

from ucm_cts.adapters.mutants.python.cheats.replaying import Player, plays

plays("replays_in_time", __doc__ or "", "R-11.2.2.1-13")

player = Player("lived through")
answer = player.answer
