"""Errors on rows that were not fitted, of attitude and heading too, and what makes them worse."""
