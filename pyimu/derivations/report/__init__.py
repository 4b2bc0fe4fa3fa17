"""The results as plain text, LaTeX and Markdown."""
