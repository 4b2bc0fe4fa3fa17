"""What the names of columns say: words, axes and units, vectors, references."""
