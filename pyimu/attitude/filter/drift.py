"""The walk of the gyro's bias as the rests of a run show it, beyond that of its part.

A part has the walk of a gyro on a bench. One that has just been switched on warms up, and drifts a
hundred times as fast. A rest shows the bias anew: where it is farther from what was known than
walk and noise account for, it has drifted, and until the next rest it will again. How it drifts
before the second rest a log tells beforehand (``pyimu.attitude.early_drift``), by a setting.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.stillness import MOVES, SLOW, Stillness
from pyimu.symbolic.linear import reciprocal

EXCEEDS = MOVES / 3
"""Times its variance that the mean square of three axes has in one rest of a thousand: of a bias
that is farther off there is more to learn than noise."""

SHORTEST = 10.0
"""s; the least time that a drift is spread over: what changes faster than that is no walk."""

LESS = 0.25
"""Share by which a smaller drift between two rests lessens what was learnt of those before."""

WHOLE = 2 * SLOW
"""s of a rest after which the slow mean of its rate is as good as it gets."""


@dataclass(frozen=True)
class Drift:
    """What was learnt of it.

    ``density`` (rad/s)^2/s is that of the walk beyond the part's, ``since`` s how long no rest has
    been seen, ``apart`` s how long none had been before the last.
    """

    density: ca.SX
    since: ca.SX
    apart: ca.SX

    @classmethod
    def start(cls, density: ca.SX | float = 0.0) -> Drift:
        return cls(ca.SX(density), ca.SX(0), ca.SX(0))

    def pack(self) -> tuple:
        return tuple(vars(self).values())


SIZES = (1, 1, 1)
"""Of what ``Drift.pack`` gives."""


def followed(x: Drift, before: Stillness, resting, off, variance, noise, axes, h):
    """The same after one more sample, and by how much in (rad/s)^2 an axis of the bias was less
    known than was thought.

    ``resting`` (0 or 1) says whether the body is; ``off`` (rad/s)^2 is then the square of its mean
    rate less bias, which ``noise`` and what is known of the bias make ``variance``, each the sum
    of so many ``axes``.
    """
    begins = resting * (x.since > 0)
    whole = resting * (before.span < WHOLE) * (before.span + h >= WHOLE)
    looks = begins + whole > 0
    apart = ca.if_else(begins, x.since, x.apart)
    time = ca.fmax(apart + before.span, SHORTEST)
    by_part = ca.fmax(variance - axes * x.density * time, noise)
    found = (off - by_part) * (off > EXCEEDS * by_part) * reciprocal(axes * time)
    gain = ca.if_else(found > x.density, 1, LESS * whole)
    density = x.density + looks * gain * (found - x.density)
    less_known = looks * (off - variance) * (off > EXCEEDS * variance) * reciprocal(axes)
    return Drift(density, (1 - resting) * (x.since + h), apart), less_known
