"""Generates C++11 and C++03 from models (clause 13)."""
