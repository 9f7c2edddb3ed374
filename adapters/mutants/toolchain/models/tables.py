"""Tool chains that are wrong about models, given as rows of tables."""

from __future__ import annotations

from ucm_cts.adapters.mutants.toolchain.deviations import register_table

for _name in ("unreported", "half_rules", "refused"):
    register_table(f"models/{_name}.yaml")
