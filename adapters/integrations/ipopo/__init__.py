"""iPOPO, a service-oriented component framework for Python, by the Python SDK: a real framework, not made for UCM."""

try:
    import pelix.ipopo.decorators  # noqa: F401 - the adapter needs it
except ImportError as error:
    raise ImportError(f"iPOPO cannot be imported ({error}): pip install 'ucm-cts[ipopo]'") from None
