"""The rate that a reference saw."""
