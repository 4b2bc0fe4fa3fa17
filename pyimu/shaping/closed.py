"""Allan deviations in closed form: those of ``pyimu.model.deviations``."""

from pyimu.model.deviations import (
    angle_quantization_deviation,
    flicker_floor,
    gauss_markov_deviation,
    ramp_deviation,
    random_walk_deviation,
    white_deviation,
)

__all__ = [
    "angle_quantization_deviation",
    "flicker_floor",
    "gauss_markov_deviation",
    "ramp_deviation",
    "random_walk_deviation",
    "white_deviation",
]
