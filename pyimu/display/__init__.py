"""How values show themselves to people: in a line, in a notebook, and how far work is."""
