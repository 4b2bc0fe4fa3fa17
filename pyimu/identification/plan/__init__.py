"""The next experiment: which motion would show an effect, how well, and in what time."""
