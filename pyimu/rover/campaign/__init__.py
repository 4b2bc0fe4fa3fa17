"""A campaign: many varied drives, each a pure function of the settings and of its number."""
