"""Tells traces of an earlier run again in new names and with new times, at once."""

from __future__ import annotations

from ucm_cts.adapters.mutants.python.cheats.replaying import Player, plays

plays("replays_new_times", __doc__ or "", "contradiction", clauses=("10.1.4.1",))  # where time is let pass

player = Player("new")
answer = player.answer
