"""For whom: what a vendor states, and what follows from it."""
