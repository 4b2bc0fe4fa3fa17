"""What the loop found, for people and as files."""
