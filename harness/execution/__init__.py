"""Runs scenarios on one implementation under test: drive, judge, confirm, shorten."""
