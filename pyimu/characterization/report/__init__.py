"""What a characterisation found, for people and as files."""
