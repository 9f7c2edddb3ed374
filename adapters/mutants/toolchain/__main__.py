"""``python -m ucm_cts.adapters.mutants.toolchain NAME check|idl|cpp11|cpp03 ...``: a mutant or variant at the command line."""

import sys

from ucm_cts.adapters.mutants.toolchain.registry import derived, mutants, variants
from ucm_cts.adapters.reference.toolchain.command import WRONG_USE, run

name = sys.argv.pop(1) if len(sys.argv) > 1 else ""
if name not in {**mutants(), **variants()}:
    sys.stderr.write(f"no tool chain is called '{name}'; there is {', '.join({**mutants(), **variants()})}\n")
    sys.exit(WRONG_USE)
run(derived(name))
