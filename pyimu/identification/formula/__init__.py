"""A formula for an error that no effect of the catalogue describes."""
