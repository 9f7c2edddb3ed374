"""Operators: each edits a legal model so that one requirement is broken, or so that it stays legal."""
