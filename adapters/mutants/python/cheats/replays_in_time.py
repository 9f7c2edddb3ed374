"""Tells traces of an earlier run again in new names, and lets as much time pass as they tell of; where it knows no trace it runs a framework that stops in the wrong order."""

from __future__ import annotations

from ucm_cts.adapters.mutants.python.cheats.replaying import Player, plays

plays("replays_in_time", __doc__ or "", "R-11.2.2.1-13")

player = Player("lived through")
answer = player.answer
