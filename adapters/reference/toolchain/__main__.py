"""``python -m ucm_cts.adapters.reference.toolchain``."""

from ucm_cts.adapters.reference.toolchain.command import main

main()
