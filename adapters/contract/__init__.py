"""The adapter contract: everything that an adapter and the harness share.

``scenario`` is what is asked of a framework, ``trace`` is what happened, ``messages`` carries both over the wire,
``programming_model`` holds clause 11's interfaces in Python, and ``adapter`` is the class that a Python adapter derives from.
"""
