"""Who is checked: the adapter contract, its SDKs, and the bundled adapters and frameworks."""
