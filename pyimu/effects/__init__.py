"""The catalogue of sensor error effects, one file per physical cause; importing it fills ``pyimu.effect.CATALOGUE``."""

from pyimu.effects import acceleration, alignment, bias, dynamics, noise, output, scale, thermal  # noqa: F401
