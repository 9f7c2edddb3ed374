"""The rules of 9.5: components, their implementations and composites."""
