"""Sends traces of an earlier run again with new names and new times, at once."""

from __future__ import annotations

from ucm_cts.adapters.mutants.python.cheats.replaying import Player, plays

# Scenarios with pauses. On a busy machine so much time may pass as the trace says; what is unforeseen shows it then.
plays("replays_new_times", __doc__ or "", "contradiction", clauses=("10.1.4.1",), or_else=("R-11.2.2.1-13",))

player = Player("new")
answer = player.answer
