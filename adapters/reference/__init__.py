"""The reference frameworks and the reference tool chain."""
