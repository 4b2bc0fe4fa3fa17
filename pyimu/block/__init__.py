"""A sampled system, and every way to run it."""
