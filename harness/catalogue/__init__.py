"""Reads requirements, interpretations, profiles and other documents."""
