"""The report of the heading by several methods: terminal, page, pictures."""
