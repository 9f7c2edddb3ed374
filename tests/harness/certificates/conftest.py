"""Certificates of real runs, made once; and a record of one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from workshop import Workshop

if TYPE_CHECKING:
    from judged_runs import Run


@pytest.fixture(scope="session")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    """With a certificate of a whole run."""
    made = Workshop(tmp_path_factory.mktemp("workshop"))
    library = made.folder / "libacme.so"
    library.write_bytes(b"a library")
    outcome = made.certify("reference-py", "acme.ucmcert", "--seed", "5", "--artifact", library)
    assert outcome.status == 0, outcome
    return made


@pytest.fixture(scope="module")
def conformant() -> Run:
    """A run of a conformant framework, with drawn scenarios."""
    # it loads the SDK, which remembers the hooks of threads: pytest must have set its own before
    from judged_runs import run_of

    return run_of("reference-py", "R-11.2.2.2-07", drawn=20)
