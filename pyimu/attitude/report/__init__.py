"""The report of the attitude filter over a log: for a terminal, as a page, and as data."""
