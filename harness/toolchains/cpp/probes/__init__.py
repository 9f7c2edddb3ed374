"""Probes: claims about C++ declarations as code that a compiler accepts or refuses."""
