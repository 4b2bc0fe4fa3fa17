"""Bias against temperature, and warm-up."""
