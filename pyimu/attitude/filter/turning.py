"""How much a body turns, and by how much its gyro's bias is then another than at rest.

What the model of a gyro lacks (scale factors that change, axes, g-sensitivity, timing) is a share
of the rate. Of a body that turns to and fro its mean is a bias: it comes with the motion, stays
while that goes on, and is gone at rest. On trial 11 of BROAD, a hand that moves to and fro at 0.6
rad/s, the bias is another by 1e-3 rad/s within seconds, for two minutes. A car, an aircraft and a
camera that pans turn a tenth of that, and have little of it. On recordings 02, 11 and 26 the bias
in motion is another than at rest by 0.9e-3 rad/s over 10 s, root mean square of its axes.
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

LASTS = 100.0
"""s; the time in which the bias of a body that moves on alike becomes another. Without that the arm
of run 6 of ``bodies.arm`` is 2.0 deg off and not 1.4; a heading is the better the less it does
(recordings 02, 11 and 26 of BROAD: the root mean square of what it drifts by in 20 s of motion is
0.44 deg without, and 0.46 deg with 100 s, as with 30 s)."""

OF_NOISE = 5.0
"""1/s^1.5; 1 rad/s, at which a body may turn, over the root of the time in which ``rate_noise`` is
the error of the axes, 0.04 s. From 2.5 to 10 the headings of recordings 02, 11 and 26 of BROAD
drift by the same to 2 %."""


def start(up):
    """What is kept (5,) before the first sample, of a body with the vertical ``up`` (3,)."""
    return ca.vertcat(0, 0, up)


def followed(before, rate, up, resting, h):
    """What is kept (5,) of how a body turns, after one more ``rate`` (3,) rad/s, less bias.

    The mean square of the rate in (rad/s)^2, how large a share (``_share``) of its variance in
    motion the bias has been given, and the mean of the vertical ``up`` (3,) in body axes: its
    length is 1 of a body that stays upright, and next to nothing of one that is turned all round.
    """
    gain = h * reciprocal(MEAN_TIME + h)
    square = before[0] + gain * (ca.sumsqr(rate) - before[0])
    mean = before[2:] + gain * (up - before[2:])
    return ca.vertcat(square, ca.fmax(_left(before, resting, h), _share(square)), mean)


def bias_variance(before, after, resting, std, h):
    """Variance in (rad/s)^2 that the bias gets as what ``followed`` keeps goes on from ``before``
    to ``after``, where it has the standard deviation ``std`` rad/s of a body that turns fast.

    As much as is not left of what it has been given: a body that turns now faster, now slower has
    the same bias, which changes no faster than in ``LASTS``. At rest it gets nothing.
    """
    return (1 - resting) * std**2 * (after[1] - _left(before, resting, h))


def false_rate(kept, noise):
    """rad/s; by how much a gyro with the relative ``noise`` (root of s) seems to have another bias
    about the vertical, by its axes and its timing, where it turns as ``kept``: a share of the rate,
    like the bias in motion.
    """
    return OF_NOISE * noise * ca.sqrt(_share(kept[0]))


def _left(before, resting, h):
    """Of the share that the bias has been given, what is left: none of a body at rest, 0 or 1."""
    return (1 - resting) * before[1] * LASTS * reciprocal(LASTS + h)


def _share(square):
    """Of the variance of a body that turns fast, at this mean ``square`` of the rate."""
    return square * reciprocal(square + FAST**2)
