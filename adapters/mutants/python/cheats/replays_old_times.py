"""Sends traces of an earlier run again with new names and the old times."""

from __future__ import annotations

from ucm_cts.adapters.mutants.python.cheats.replaying import Player, plays

plays("replays_old_times", __doc__ or "", "contradiction")

player = Player("old")
answer = player.answer
