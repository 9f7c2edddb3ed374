"""All derived frameworks: importing this module imports every module that registers some."""

from __future__ import annotations

from importlib import import_module

from ucm_cts.adapters.mutants.python.registry import (
    CHEATS,
    CONTAINER,
    CORE,
    MUTANTS,
    PACED,
    POLICIES,
    REQUESTS,
    SHARED,
    TIMED,
    TRIGGERED,
    UNSEEN,
    VARIANTS,
    Cheat,
    Mutant,
    Variant,
    mutants_of,
    variants_of,
)

__all__ = [
    "CHEATS",
    "CONTAINER",
    "CORE",
    "MUTANTS",
    "PACED",
    "POLICIES",
    "REQUESTS",
    "SHARED",
    "TIMED",
    "TRIGGERED",
    "UNSEEN",
    "VARIANTS",
    "Cheat",
    "Mutant",
    "Variant",
    "mutants_of",
    "variants_of",
]

MODULES = {
    "variants": (
        "answers",
        "attachments",
        "clocks_and_traces",
        "declared",
        "direct_calls",
        "draining",
        "execution",
        "messages",
        "paced",
        "timed",
        "timed_numbers",
        "triggered",
        "triggered_apart",
        "phases",
        "policies_at_start",
        "readings",
        "requests",
        "restarts",
        "services",
        "shared_data",
        "starting",
        "undemanding",
    ),
    "life_cycle": ("business_calls", "components", "connections", "containers", "errors", "members", "states", "types"),
    "execution": ("policies", "running", "support"),
    "container_services": ("clocks", "logs", "port_traces"),
    "data": ("composite_types", "simple_types"),
    "connectors": (
        "ends",
        "message_delivery",
        "message_receivers",
        "return_codes",
        "service_calls",
        "service_values",
    ),
    "extensions": (
        *("requests", "responses", "request_connections", "request_situations"),
        *("shared_freezes", "shared_notices", "shared_reads", "shared_writes"),
        *("paced_calls", "paced_parameters", "paced_phases", "paced_runs", "paced_situations"),
        *("timer_callbacks", "timer_ends", "timer_expiry", "timer_service", "timer_situations"),
        *(
            "object_timer_answers",
            "object_timer_ends",
            "object_timer_service",
            "object_timer_situations",
            "object_timer_told",
            "object_timer_triggers",
        ),
    ),
    "dimensions": (
        "aftermath",
        "at_once",
        "callers",
        "configured",
        "counts",
        "counts_of_connectors",
        "early",
        "extras",
        "failures",
        "instances",
        "later_containers",
        "later_use",
        "moments",
        "numbers",
        "outlasting",
        "refusals",
        "sharing",
        "situations",
        "sizes",
    ),
    "cheats": (
        *("adapters", "exchanging", "intruding", "recognising", "tampering"),
        *("replays_in_time", "replays_new_times", "replays_old_times"),
    ),
}
"""By the folder: the modules that register mutants, variants or cheats."""

for _folder, _modules in MODULES.items():
    for _module in _modules:
        import_module(f"{__package__}.{_folder}.{_module}")
