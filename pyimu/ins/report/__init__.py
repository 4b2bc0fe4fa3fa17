"""The report of a navigated recording: words, pictures, page and data."""
