"""``python -m ucm_cts.adapters.toolchain``."""

from ucm_cts.adapters.toolchain.command import main

main()
