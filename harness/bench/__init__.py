"""What testing costs, against its limits and against what one would do instead (``tox -e bench``)."""
