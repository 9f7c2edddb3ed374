"""iPOPO, a service-oriented component framework for Python, by the Python SDK: a real framework, not made for UCM."""
