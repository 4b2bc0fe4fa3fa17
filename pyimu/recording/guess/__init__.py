"""What the columns of a foreign log may be: by their names, their stated units, their numbers."""
