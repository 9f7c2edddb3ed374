"""On what: from ADAPTER to a host that answers, whatever happens."""
