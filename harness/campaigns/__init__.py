"""Carries out the campaigns and self-tests of a plan in units, on several workers (docs/campaigns.md)."""
