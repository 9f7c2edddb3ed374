"""The profiles: what a run can certify, and which requirements belong to each."""

from __future__ import annotations

from collections.abc import Mapping

FRAMEWORK_PROFILES = ("container", "core", "extensions")
"""Of running frameworks, behind an adapter."""

TOOLCHAIN_PROFILES = ("pim", "idl", "cpp11", "cpp03")
"""Of tool chains, behind command lines."""

PROFILES = (*FRAMEWORK_PROFILES, *TOOLCHAIN_PROFILES)
"""What a run can choose; nothing is pending of what they ask for. Of ``extensions`` they ask for the parts that nothing is pending of."""

PARTS: Mapping[str, tuple[str, ...]] = {
    "container": ("container",),
    "core": ("container", "core"),
    "extensions": ("container", "core", "extensions"),
    "pim": ("pim",),
    "idl": ("idl", "code"),
    "cpp11": ("code", "cpp", "cpp11"),
    "cpp03": ("code", "cpp", "cpp03"),
}
"""The requirements that belong to a profile, by what the catalogue files them under; ``code`` is asked of all that generate code."""
