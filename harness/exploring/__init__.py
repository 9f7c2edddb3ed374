"""What did nobody think of? Scenarios are drawn, and drawn anew from those that showed something new."""
