"""A robot that drives along a square and stops: its path by the filter, the smoother, and integration."""
