"""The error-state filter of position as casadi symbols; nothing of a log."""
