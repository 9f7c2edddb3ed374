"""Conformant tool chains that read open places of clause 9 otherwise than the reference one, given as rows of a table."""

from __future__ import annotations

from ucm_cts.adapters.mutants.toolchain.deviations import register_table

register_table("variants/readings.yaml")
