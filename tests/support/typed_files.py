"""The generated files of the typed probes: what the reference tool chain makes of the probe models.

``PYTHONPATH=dev python tests/support/typed_files.py`` writes them again.
"""

from __future__ import annotations

from pathlib import Path

from files import ROOT

from ucm_cts.adapters.reference.toolchain.cpp.generator import generate_cpp11
from ucm_cts.adapters.reference.toolchain.cpp.lwucm_glue import generate_lwucm
from ucm_cts.adapters.reference.toolchain.cpp.support import SUPPORT_FILE
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.purposes.probes import PROBE_MODEL

REFERENCE_CPP = ROOT / "adapters" / "reference" / "cpp"
GENERATED = REFERENCE_CPP / "typed" / "generated"
COMMAND = "PYTHONPATH=dev python tests/support/typed_files.py"


def generated() -> dict[Path, str]:
    """The files by their paths. What they take from the platform is the framework's."""
    model, reported = reference().check(PROBE_MODEL.read_bytes(), PROBE_MODEL.name)
    assert model is not None, reported
    made = {GENERATED / name: text for name, text in {**generate_cpp11(model), **generate_lwucm(model)}.items()}
    return {REFERENCE_CPP / "framework" / "include" / SUPPORT_FILE: made.pop(GENERATED / SUPPORT_FILE), **made}


if __name__ == "__main__":
    for path, text in generated().items():
        path.write_text(text, encoding="utf-8")
