"""What may be said of what was found: the verdict, what became of each candidate, and why."""
