"""The equations of the attitude filter, as a block: symbols in, C code out."""
