"""What a gyro's numbers are of which the header says an angle's unit: ``Gyro X (deg)``."""

from __future__ import annotations

import numpy as np

from pyimu.recording.guess.gravity_turning import LIKE, turning_of_gravity
from pyimu.recording.guess.numbers import UnitGuess
from pyimu.units import parse

APART = 0.2
"""Logarithm of the factor between two readings from which on gravity tells them apart: its turning
may show a gyro's size a tenth too large or too small, of a sensor that is shaken."""


def angle_of_rate(
    unit: str, said: str, angles: np.ndarray, force: np.ndarray | None, period: float | None
) -> UnitGuess:
    """What a gyro's numbers (n, 3) are of which the header says an angle's ``unit``, as it ``said``
    it: that a second, the other unit a second, or the angles between samples ``period`` s apart, by
    how gravity turns. At 57 Hz the last two are the same numbers, and near it both are named.
    """
    own = f"{unit}/s"
    asked = UnitGuess(own, f"the header says {said}: a second, of a rate?")
    if force is None or period is None:
        return asked
    slope = turning_of_gravity(angles, force, period)
    if slope is None:
        return asked
    factor, each = parse(unit).factor, 1 / period
    other = next(u for u in ("rad/s", "deg/s") if not np.isclose(parse(u).factor, factor, 0.01))
    seen = f"the header says {said}, and gravity turns"
    readings = {
        factor: asked,
        parse(other).factor: UnitGuess(other, f"{seen} as these say in {other}"),
        factor * each: UnitGuess(own, f"{seen} so far from sample to sample", each),
    }
    off = {size: abs(float(np.log(slope / size))) for size in readings}
    near, second, *_ = sorted(off, key=off.__getitem__)
    if off[near] > np.log(LIKE):
        return asked
    if abs(np.log(second / near)) < APART:
        why = f"{seen} {slope:.3g} rad for 1 of these: {other}, or {unit} from sample to sample?"
        size = float(np.degrees(factor * each))
        return UnitGuess(None, why, sizes=(size,), choices=(other,))
    return readings[near]
