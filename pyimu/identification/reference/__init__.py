"""The reference as an instrument with errors of its own, log by log."""
