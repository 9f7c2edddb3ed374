"""How it is checked: driver, host processes, judge, evidence, reports, command line, pytest plugin."""
