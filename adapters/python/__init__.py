"""The former place of the Python SDK, kept for one version; the SDK is in ``ucm_cts.adapters.sdk.python``."""
