"""What the raw samples show, before a model is blamed for its residual."""
