"""iPOPO, a service-oriented component framework for Python, behind the Python door: a real framework, not made for UCM."""
