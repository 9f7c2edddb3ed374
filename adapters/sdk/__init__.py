"""What adapters are written with, in each language."""
