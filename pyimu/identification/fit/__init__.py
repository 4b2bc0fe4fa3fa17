"""Fitting a sensor model to logs: residual, columns, whitening, least squares, score."""
