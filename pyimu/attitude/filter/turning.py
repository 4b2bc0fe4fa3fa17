"""How much a body turns, and by how much its gyro's bias is then another than at rest.

What the model of a gyro lacks (scale factors that change, axes, g-sensitivity, timing) is a share
of the rate. Of a body that turns to and fro its mean is a bias: it comes with the motion, stays
while that goes on, and is gone at rest. On trial 11 of BROAD, a hand that moves to and fro at 0.6
rad/s, the bias is another by 1e-3 rad/s within seconds, for two minutes. A car, an aircraft and a
camera that pans turn a tenth of that, and have little of it.
"""

from __future__ import annotations

import casadi as ca

from pyimu.symbolic.linear import reciprocal

MEAN_TIME = 10.0
"""s; over which the square of the rate is averaged."""

FAST = 0.5
"""rad/s; root mean square of the rate of a body that turns fast: beyond it the bias of a real gyro
grows no further on trials 02, 11 and 26 of BROAD (``benchmarks/attitude_real.py``), below it it is
a share of the rate."""


def followed(before, rate, h):
    """The mean square of the rate in (rad/s)^2 after one more ``rate`` (3,) rad/s, less bias."""
    return before + h * reciprocal(MEAN_TIME + h) * (ca.sumsqr(rate) - before)


def bias_variance(before, after, std):
    """Variance in (rad/s)^2 that the bias gets as the mean square of the rate goes on from
    ``before`` to ``after``, where it has the standard deviation ``std`` rad/s of a body that turns
    fast.

    As much as it has more of when the body turns faster. What it had, it keeps.
    """
    return std**2 * ca.fmax(_share(after) - _share(before), 0)


def _share(square):
    """Of the variance of a body that turns fast, at this mean ``square`` of the rate."""
    return square * reciprocal(square + FAST**2)
