"""What the pages and listings of the package are made of."""
