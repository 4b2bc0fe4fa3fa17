"""The model that came out: each coefficient with its interval, and all of them as a part."""
