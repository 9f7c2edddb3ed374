"""The reference tool chain ``ucm-cts-toolchain``: checks UCM models and generates IDL, C++11 and C++03 from them.

It is an adapter like any other: written from the clauses, it knows neither the suite's cases nor what the suite expects.
"""
