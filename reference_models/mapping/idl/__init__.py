"""What clause 12 makes of a model: declarations, and the requirements that ask for them."""
