"""A tool chain's commands: how its vendor describes them, and how they are run within limits."""
