"""What is random in a residual, named by likelihood."""
