"""Runs scenarios on one IUT: drives, judges, confirms and shortens."""
