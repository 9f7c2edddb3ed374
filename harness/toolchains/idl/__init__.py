"""Profile idl: reads a vendor's IDL and compares it with what clause 12 makes of the model."""
