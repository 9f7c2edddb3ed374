"""The harness: driver, host processes, monitor, evidence, reports, command line, pytest plugin."""
