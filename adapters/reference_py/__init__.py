"""A small UCM framework in Python and its adapter: the first thing to read when writing an adapter or a framework."""
