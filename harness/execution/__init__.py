"""Running it: drive, judge, look again, shorten."""
