"""Certificates: signed archives from which a stranger derives every verdict again, without the product."""
