"""A host that asks for one derived framework loads what registers it, and nothing else: each trial of a mutant starts a host."""

from __future__ import annotations

import subprocess
import sys

import pytest

import ucm_cts.adapters.mutants.python as package
from ucm_cts.adapters.mutants.python.subjects import CHEATS, MUTANTS, VARIANTS

pytestmark = pytest.mark.fast

_LOADED = """
import sys
import ucm_cts.adapters.mutants.python as package
print(package.{name}.product, "ucm_cts.adapters.mutants.python.subjects" in sys.modules)
"""


def test_only_its_module_is_loaded() -> None:
    command = [sys.executable, "-c", _LOADED.format(name="refuses_to_end")]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert printed.split() == ["refuses_to_end", "False"]


def test_every_subject_is_found_by_its_name() -> None:
    known = [*MUTANTS.items(), *VARIANTS.items(), *CHEATS.items()]
    for name, one in known[::50]:
        assert one.adapter is None or getattr(package, name) is one.adapter
    assert len(dict(known)) == len(known), "two have one name"


@pytest.mark.parametrize("name", ["nothing_of_this_name", "_private"])
def test_unknown_name_is_no_attribute(name: str) -> None:
    assert not hasattr(package, name)
