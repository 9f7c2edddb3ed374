"""Reads and checks a vendor's statement (ICS, IXIT), and selects what applies to the product."""
