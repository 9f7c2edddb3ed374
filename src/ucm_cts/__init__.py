"""UCM-CTS: conformance test suite and certification harness for OMG's Unified Component Model."""

__version__ = "0.1.0"
