"""The blocks of the system around sensor and filter: true motion, low-pass."""
