"""The catalogue of sensor error effects, one file per physical cause; importing it fills ``pyimu.effect.CATALOGUE``.

Effects of one stage act in the order of their definition, the files in the order of this list.
"""
# ruff: noqa: F401
# isort: off

from pyimu.effects import motion, dynamics, alignment, scale, coupling, acceleration, thermal
from pyimu.effects import bias, course, surroundings, clock, noise, output
