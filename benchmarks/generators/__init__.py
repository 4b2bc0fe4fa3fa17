"""Motions and sensors that the simulated logs of several benchmarks are made from.

Plain numpy and scipy: no equation here comes from the package that these logs try. Attitudes are
quaternions (w, x, y, z), Hamilton's product, body to world; axes are forward-left-up and
east-north-up; all is SI and radians.
"""
