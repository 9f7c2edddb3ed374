"""Fixtures of several test modules, the lane of each test, and which worker runs it."""

import signal
from pathlib import Path

import pytest
from command_line import within
from cpp_builds import builds

__all__ = ["builds"]
NATIVE = {"builds", "java", "vendor"}
"""Fixtures that need a compiler."""

# A shell that runs the tests in the background may have them ignore these; then no test could interrupt what it starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working folder, with the adapters of tests/support/subjects.py within reach of hosts."""
    within(tmp_path, monkeypatch)
    return tmp_path


@pytest.hookimpl(tryfirst=True)  # before -m selects
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """A test that uses such a fixture is native; a test that is neither native nor slow is fast.

    The fast tests of a file run on one worker, because they share caches; so do the native ones. Slow tests
    are handed out one by one, and first.
    """
    for item in items:
        if NATIVE & {*getattr(item, "fixturenames", ())}:
            item.add_marker(pytest.mark.native)
        lane = next((lane for lane in ("slow", "native") if item.get_closest_marker(lane)), "fast")
        if lane == "fast":
            item.add_marker(pytest.mark.fast)
        if lane != "slow" and config.pluginmanager.hasplugin("xdist"):
            item.add_marker(pytest.mark.xdist_group(item.path.stem))
    items.sort(key=lambda item: item.get_closest_marker("fast") is not None)
