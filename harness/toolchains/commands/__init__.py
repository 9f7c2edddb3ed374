"""A tool chain's commands: their description by the vendor, and their execution within limits."""
