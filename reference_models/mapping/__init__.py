"""What the language mappings demand of generated files."""
