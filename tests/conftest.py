"""Fixtures of several test modules, and who runs what where there are several workers."""

import signal

import pytest
from cpp_builds import builds

__all__ = ["builds"]

# A shell that runs the tests in the background may have them ignore these; then no test could interrupt what it starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """A file stays with one worker, for what it keeps between tests; so do all that build the same C++ programs."""
    if config.pluginmanager.hasplugin("xdist"):
        for item in items:
            name = item.path.stem
            item.add_marker(pytest.mark.xdist_group("test_cpp" if name.startswith("test_cpp") else name))
