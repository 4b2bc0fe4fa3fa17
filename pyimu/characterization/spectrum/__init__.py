"""Power spectral density and its lines."""
