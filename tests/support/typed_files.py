"""The generated files of the typed probes: what the reference tool chain makes of the probe models.

``PYTHONPATH=dev python tests/support/typed_files.py`` writes them again.
"""

from __future__ import annotations

from pathlib import Path

from files import ROOT
from lxml import etree

from ucm_cts.adapters.reference.toolchain.cpp.generator import generate_cpp11
from ucm_cts.adapters.reference.toolchain.cpp.lwucm_glue import generate_lwucm
from ucm_cts.adapters.reference.toolchain.cpp.support import SUPPORT_FILE
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.purposes.probes import PROBE_MODEL

REFERENCE_CPP = ROOT / "adapters" / "reference" / "cpp"
PLATFORM = REFERENCE_CPP / "framework" / "models"
PARTS = REFERENCE_CPP / "typed" / "parts.xml"
GENERATED = REFERENCE_CPP / "typed" / "generated"
COMMAND = "PYTHONPATH=dev python tests/support/typed_files.py"


def models() -> bytes:
    """One model of lwucm's platform and of all probes, which needs an execution policy for each body."""
    together = etree.Element("Model")
    together.extend(etree.parse(path).getroot() for path in sorted(PLATFORM.glob("*.xml")))
    for path in (PARTS, PROBE_MODEL):
        together.extend(etree.parse(path).getroot())
    for policy in together.iterfind(".//ComponentTechnicalPolicy[@name='unprotected']"):
        for body in together.iterfind(".//AtomicComponentImplementation"):
            if body.find("TechnicalPolicy[@name='self-executing']") is None:
                module = body.getparent().get("name")
                etree.SubElement(policy, "ManagedComponent", name=f"::{module}::{body.get('name')}")
                etree.SubElement(body, "TechnicalPolicy", name="::parts::unprotected")
    return etree.tostring(together)


def generated() -> dict[Path, str]:
    """The files by their paths. What they take from the platform is the framework's."""
    model, reported = reference().check(models(), PROBE_MODEL.name)
    assert model is not None, reported
    made = {GENERATED / name: text for name, text in {**generate_cpp11(model), **generate_lwucm(model)}.items()}
    return {REFERENCE_CPP / "framework" / "include" / SUPPORT_FILE: made.pop(GENERATED / SUPPORT_FILE), **made}


if __name__ == "__main__":
    for path, text in generated().items():
        path.write_text(text, encoding="utf-8")
