"""The effects, signals and parts as Modelica text.

The text is printed from the casadi functions from which the C of the units is printed, operation by
operation, so that both compute the same bits.
"""
