"""Generated mutants: a tool changes single lines of the reference frameworks (``tox -e generated``)."""
