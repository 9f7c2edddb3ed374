"""An exploration that tests of this folder share."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import ucm_cts, within
from explorations import REQUIREMENT, SUBJECT


@pytest.fixture(scope="session")
def found(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of an exploration that has found the one defect of its subject."""
    folder = tmp_path_factory.mktemp("found")
    with pytest.MonkeyPatch.context() as patch:
        within(folder, patch)
        outcome = ucm_cts("explore", SUBJECT, "--budget", "60scenarios", "--seed", "1", "--out", folder / "out")
    assert (outcome.status, outcome.err) == (1, "")
    assert f"✗ {REQUIREMENT}" in outcome.out
    assert "ucm-cts replay " in outcome.out
    return folder / "out"
