"""Generated mutants: a tool changes single lines of the reference frameworks; does the suite notice? (``tox -e generated``)"""
