"""A workshop of a vendor and an auditor: keys, and certificates of real runs."""

from __future__ import annotations

from pathlib import Path

from command_line import Outcome, ucm_cts

FEW = ("--explore", "10scenarios")


class Workshop:
    """A folder with keys of a vendor and an auditor, and a certificate of the Python reference framework."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name, place in (("acme", "keys"), ("auditor", "auditors")):
            assert ucm_cts("key", name, "--out", folder).status == 0
            (folder / place).mkdir()
            (folder / f"{name}.pub").rename(folder / place / f"{name}.pub")
        self.certificate = folder / "acme.ucmcert"

    def certify(self, adapter: str, out: str, *more: str | Path) -> Outcome:
        """``ucm-cts certify``."""
        arguments = ("--out", self.folder / out, "--report", self.folder / f"{out}-report", *FEW, *more)
        key = () if "--key" in more else ("--key", self.folder / "acme.pem")
        return ucm_cts("certify", adapter, *key, *arguments)

    def verify(self, file: Path, *more: str | Path) -> Outcome:
        """``ucm-cts verify`` with the vendor's key."""
        return ucm_cts("verify", file, "--trust", self.folder / "keys", *more)
