"""What a log shows by itself: its trials, how it moves, what shakes it, a late thermometer."""
