"""What is checked: requirement catalogue, interpretations, life-cycle table, probe models, scenarios, pytest module."""
