"""Noise coefficients with their intervals, from Allan deviations."""
