"""What is required: documents with line numbers, requirements, interpretations, profiles."""
