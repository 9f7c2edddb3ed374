"""Fixtures for hostile subjects: whatever they do, no process and no descriptor is left of them."""

from __future__ import annotations

import os
import secrets
import select
import time
from collections.abc import Iterator
from contextlib import suppress

import psutil
import pytest

_MARK = "UCM_CTS_TEST"


def _marked(mark: str) -> list[psutil.Process]:
    found = []
    for process in psutil.process_iter():
        with suppress(psutil.Error):
            if process.pid != os.getpid() and process.environ().get(_MARK) == mark:
                found.append(process)
    return found


def sleepers() -> set[psutil.Process]:
    """The processes that attacks leave behind without any mark."""
    found = set()
    for process in psutil.process_iter():
        with suppress(psutil.Error):
            if process.cmdline() == ["/bin/sleep", "600"]:
                found.add(process)
    return found


@pytest.fixture
def nothing_left(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Afterwards no descriptor is open, and no process lives, that did not before."""
    mark = secrets.token_hex(16)
    monkeypatch.setenv(_MARK, mark)
    before, slept = set(os.listdir("/proc/self/fd")), sleepers()
    yield
    assert set(os.listdir("/proc/self/fd")) <= before
    until = time.monotonic() + 5
    alive = [one for one in [*_marked(mark), *(sleepers() - slept)] if not _ends(one, until)]
    assert not [process.cmdline() for process in alive]


def _ends(process: psutil.Process, until: float) -> bool:
    """Whether it ends before ``until``: those that were killed take a moment."""
    try:
        handle = os.pidfd_open(process.pid)
    except OSError:
        return True
    try:
        return bool(select.select([handle], [], [], max(until - time.monotonic(), 0))[0])
    finally:
        os.close(handle)
