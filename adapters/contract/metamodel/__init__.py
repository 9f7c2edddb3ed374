"""The meta-model of clause 9 as typed values: what a UCM model says, whichever way it is written down.

One class for each concrete class of the text, with the text's own field names in Python's spelling. References are strings as
they stand in the model; ``names.py`` finds what they mean.
"""
