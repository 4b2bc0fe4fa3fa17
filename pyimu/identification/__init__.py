"""The loop: what a model lacks to explain measured logs."""
