"""The summary of a campaign: in a terminal, as a page, and as data."""
