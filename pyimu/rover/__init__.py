"""Rover drives: the motion, and the built-in recording of the demo."""
