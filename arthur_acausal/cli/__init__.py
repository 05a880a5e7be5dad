"""The command line `arthur`."""
