"""Without a host: models that a framework ships, compared with 10.1."""
