"""A look at the motion: what its samples showed since the last one, taken into what is known of it.

It is a function of its own, as it is due once in many samples of a fast log.
"""

from __future__ import annotations

import casadi as ca

from pyimu.attitude.filter.gravity_update import (
    scaled_tilt,
    tilt_variance,
    vertical,
    white_variance,
)
from pyimu.attitude.filter.layout import Layout
from pyimu.attitude.filter.memory import Memory
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.slow_motion import Bounds
from pyimu.attitude.filter.unscented import Estimate
from pyimu.attitude.filter.velocity import Motion, followed, unlevelled
from pyimu.block.plain import plain_function

OPTIONS = {"cse": True}


def look(layout: Layout) -> ca.Function:
    """``motion, x, p, h -> motion``: with what was gathered, and the estimate before the updates of
    the sample.
    """
    motion, working, p, h = symbols = layout.symbols(ca.SX, "motion x p h")
    x, settings = Memory.estimate_of(working), Settings.of(layout.compensation, p)
    at = settings.scalar
    white = ca.sum1(white_variance(settings, h)) * (h / 3)
    bounds = Bounds(at["motion_share"], white, at["motion_time"], unlevelled(at))
    moves, before = at["accel_std"] > 0, Motion.unpack(motion)
    after = followed(before, x, moves, bounds, at["gravity"] ** 2 * _tilt(x), h)
    return plain_function("look", symbols, [after.pack()], OPTIONS)


def _tilt(x: Estimate):
    """rad^2; the variance of the tilt, with what the gyro's scale factors make of it."""
    up = vertical(x)
    return tilt_variance(x.covariance, up) + ca.sumsqr(scaled_tilt(x, up)) / 2
