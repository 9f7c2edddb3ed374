"""Sends traces of an earlier run again with new names and new times, at once."""

from __future__ import annotations

from ucm_cts.adapters.mutants.python.cheats.replaying import Player, plays

plays("replays_new_times", __doc__ or "", "contradiction", clauses=("10.1.4.1",))  # scenarios with pauses

player = Player("new")
answer = player.answer
