"""Certificates of real runs, made once."""

from __future__ import annotations

import pytest
from workshop import Workshop


@pytest.fixture(scope="session")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    """With a certificate of a whole run."""
    made = Workshop(tmp_path_factory.mktemp("workshop"))
    library = made.folder / "libacme.so"
    library.write_bytes(b"a library")
    outcome = made.certify("reference-py", "acme.ucmcert", "--seed", "5", "--artifact", library)
    assert outcome.status == 0, outcome
    return made
