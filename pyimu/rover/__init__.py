"""Rover drives: the motion, the built-in recording of the demo, the paper's test drives."""
