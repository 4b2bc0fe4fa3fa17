"""Rest from the samples of the last tenths of a second, by what was measured until now.

It is the test of ``pyimu.ins.detector``, a generalised likelihood ratio (Skog et al. 2010)
over the noise of the part, on a window that ends with the sample. Sums over ``SLOTS`` parts of the
window are kept, so that it moves on by one part at a time and the memory does not depend on the
sample rate. What a sample says alone counts too: the window is still full of rest when a motion
begins.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.detector import FALSE_ALARM
from pyimu.ins.pushes import STEADY_GATE
from pyimu.numerics.laws import chi2, norm
from pyimu.symbolic.linear import cholesky, forward, reciprocal

SLOTS = 10
"""Parts of a window."""

AXES = 6

WIDTH = AXES + 1
"""Numbers of a part: the sums of rate and force over their noise, and that of all squares."""

SIZE = 2 + SLOTS * WIDTH
"""Numbers of the memory: samples of the last part, whole parts before it, the parts from it on."""

OUTLIER = float(chi2.isf(FALSE_ALARM, AXES))
"""Squared distance of a sample from its window's mean over the noise, beyond which it moves."""

SURE = float(norm.isf(FALSE_ALARM))


@dataclass(frozen=True)
class Window:
    """The window with a sample: its ``memory``, its ``mean`` rate (3,) rad/s and ``force`` (3,)
    m/s^2 and over how many samples, and whether it is ``alike``, that is whether nothing in it
    moved, 0 or 1.
    """

    memory: ca.SX
    mean: ca.SX
    force: ca.SX
    count: ca.SX
    alike: ca.SX


def followed(memory, rate, force, lost, settings: Settings, h) -> Window:
    """The window after a sample; one that is ``lost`` (0 or 1) empties it."""
    at = settings.scalar
    std = ca.vertcat(settings.gyro.white, settings.accel.white) * ca.sqrt(reciprocal(h))
    std = ca.fmax(std * at["rest_noise"], 1e-12)
    values = ca.vertcat(rate, force) / std
    before = _mean(memory, at["rest_window"], h)
    length = _length(at["rest_window"], h)
    count, whole, parts = memory[0], memory[1], memory[2:]
    full = count >= length
    now = ca.vertcat(values, ca.sumsqr(values))
    last = now + ca.if_else(full, 0, parts[:WIDTH])
    older = ca.if_else(full, parts[:-WIDTH], parts[WIDTH:])
    count = ca.if_else(full, 1, count + 1)
    whole = ca.fmin(whole + full, SLOTS - 1)
    after = (1 - lost) * ca.vertcat(count, whole, last, older)
    total, n = _total(after), after[0] + after[1] * length
    n = ca.fmax(n, 1)
    squares = total[AXES] - ca.sumsqr(total[:AXES]) / n
    near = ca.sumsqr(values - before[0]) <= OUTLIER * (1 + 1 / ca.fmax(before[1], 1))
    alike = (after[1] >= SLOTS - 1) * (squares <= _threshold(n)) * near
    mean = total[:AXES] / n * std
    return Window(after, mean[:3], mean[3:], n, alike)


def _length(window, h):
    """Samples of a part."""
    return ca.fmax(1, ca.floor(window / (SLOTS * h) + 0.5))


def _total(memory):
    """The sums (7,) over the window."""
    return ca.sum2(ca.reshape(memory[2:], WIDTH, SLOTS))


def _mean(memory, window, h) -> tuple:
    """The mean (6,) of the samples over their noise, and of how many."""
    n = memory[0] + memory[1] * _length(window, h)
    return _total(memory)[:AXES] / ca.fmax(n, 1), n


def _threshold(n):
    """That of ``detector.threshold`` by Wilson and Hilferty 1931: 0.35 % too high for 10 samples,
    less than 0.1 % from 30 on.
    """
    freedom = AXES * ca.fmax(n - 1, 1)
    spread = 2 / (9 * freedom)
    return freedom * (1 - spread + SURE * ca.sqrt(spread)) ** 3


def is_no_turn(found: Window, expected, covariance, settings: Settings, h):
    """Whether the mean rate is the ``expected`` one (3,) rad/s, known with this ``covariance`` (3,
    3): a steady turn is as even as a rest. 0 or 1.
    """
    noise = settings.gyro.white**2 * reciprocal(h * found.count)
    off = forward(cholesky(covariance + ca.diag(noise)), found.mean - expected)
    return ca.sumsqr(off) <= STEADY_GATE + 3
