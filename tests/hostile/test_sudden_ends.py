"""However a run ends, nothing of the product goes on, and nothing of it is left."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from aftermath import nothing_left  # noqa: F401 - a fixture

from ucm_cts.harness.hosting.sandbox import why_none

pytestmark = pytest.mark.skipif(bool(why_none()), reason=f"no sandbox here: {why_none()}")

WAITS = """
import os, signal, subprocess
from pathlib import Path
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

def leave(place):
    subprocess.Popen(["/bin/sleep", "600"], start_new_session=True, env={})
    Path(place, "left").write_text("behind")

leave("/tmp")

class Waits(ReferenceAdapter):
    'Never comes back from the first scenario, leaves processes and files behind, and stops the process that forks hosts.'

    def create_runtime(self, implementations):
        leave("/dev/shm")
        leave(".")
        os.kill(os.getppid(), signal.SIGSTOP)  # which would end what is left
        Path("calls").write_text("waiting")
        subprocess.run(["/bin/sleep", "600"])
"""


@pytest.fixture
def calls(here: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A pipe to which the adapter writes when it waits."""
    (here / "waiting.py").write_text(WAITS)
    (here / "temporary").mkdir()
    monkeypatch.setenv("TMPDIR", str(here / "temporary"))
    os.mkfifo(here / "calls")
    pipe = os.open(here / "calls", os.O_RDWR)
    yield pipe
    os.close(pipe)


@pytest.mark.usefixtures("nothing_left")
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_nothing_outlives_a_run_that_is_ended(here: Path, calls: int, how: signal.Signals) -> None:
    run = ("run", "waiting:Waits", "--timeout", "60", "--out", "out", "-k", "R-11.2.2.1-13")
    command = ["env", "--default-signal", sys.executable, "-m", "ucm_cts", *run]  # a job in the background ignores some
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        assert select.select([calls], [], [], 60)[0], "the framework was never called"
        process.send_signal(how)
        process.wait(60)
    assert list((here / "temporary").iterdir()) == []
    assert not (here / "left").exists()
    assert not Path("/dev/shm/left").exists()
    assert not Path("/tmp/left").exists()
