"""Measures what testing costs, against limits and against other ways to test (``tox -e bench``)."""
