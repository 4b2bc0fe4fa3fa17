"""Small numerics that scipy and LAPACK have, without what these cost in a short run."""
