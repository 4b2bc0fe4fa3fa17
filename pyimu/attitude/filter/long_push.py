"""Pushes that last longer than a velocity that is bounded allows, as the run itself shows them.

An aircraft that turns, or a car in a long bend, is pushed one way for tens of seconds. The force of
it looks like gravity, and a tilt that follows it is off by the angle between the two. While the
gyro still knows the tilt better, the mean force across its vertical shows the push. With a variance
s^2 and a correlation time T it has the density 2 T s^2 at low frequency, and the velocity walks by
that.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.symbolic.linear import reciprocal

OVER, LASTS = 5.0, 10.0
"""Correlation times of a bounded velocity: over which the force is averaged, and of a push. The
longer the average, the less of a turn of 20 s is in it, and the less of a hand's motion. Chosen
with seed 90 of the aircraft and drones of ``benchmarks/attitude_honesty.py``."""

EXCEEDS = 3.0
"""By which factor the mean square of that average must exceed what tilt and bounded velocity make
of it, which they do with a probability of 5 %, exp(-3) of two axes."""

LEAST = 0.3
"""m/s^2; smaller pushes are no long ones: an accelerometer's bias of 20 mg turns with the body, and
looks like them."""

RISE, FALL = 3.0, 40.0
"""Correlation times of a bounded velocity over which the variance is averaged, where it rises and
where it falls: who turns now will turn again."""

EXCLUDED = 0.03
"""(m/s^2)^2; pushes that the run has not shown are none where they are less. With 0.01 the velocity
of a fast hand is learned late or never, with 0.06 that of a car from its pushes. Chosen on seeds 7,
9, 11 and 13 of the same bodies."""


@dataclass(frozen=True)
class LongPush:
    """The mean ``force`` (2,) m/s^2 east and north, and the variance (m/s^2)^2 of an axis of the
    pushes: what the run has ``shown`` of it, and what it has not excluded (``first``).
    """

    force: ca.SX
    shown: ca.SX
    first: ca.SX

    @classmethod
    def start(cls, first: ca.SX | float = 0.0) -> LongPush:
        return cls(ca.SX.zeros(2), ca.SX(0), ca.SX(first))

    def pack(self) -> tuple:
        return tuple(vars(self).values())

    @property
    def variance(self):
        """(m/s^2)^2; of an axis of the pushes."""
        return ca.fmax(self.shown, self.first)

    @property
    def is_excluded(self):
        """Whether there are no pushes but those that the run has shown, 0 or 1."""
        return self.first <= EXCLUDED

    def velocity(self, time):
        """(m/s)^2; of an axis, what a push that the run has shown leaves, with the ``time`` as for
        ``density``.
        """
        return (LASTS * time) ** 2 * self.shown

    def density(self, time):
        """(m/s^2)^2 s at low frequency, with the correlation ``time`` s of a bounded velocity."""
        return 2 * LASTS * time * self.variance


SIZES = (2, 1, 1)
"""Of what ``LongPush.pack`` gives."""


def followed(before: LongPush, level, own, across, time, span) -> LongPush:
    """The same after one more look.

    What is not excluded of pushes that were not seen falls to what the force shows by its size,
    tilt and all: where it is larger than they are, it says nothing against them.

    ``level`` (2,) m/s^2 is the mean force east and north by the estimate over a ``span`` in s,
    ``own`` (m/s^2)^2 the variance that its tilt makes of an axis, ``across`` (m/s)^2 that of the
    velocity, of a correlation ``time`` in s.
    """
    whole = OVER * time + span
    force = before.force + span / whole * (level - before.force)
    bounded = EXCEEDS * (own + across / whole**2) + LEAST**2
    found = ca.fmax(ca.sumsqr(force) / 2 - bounded, 0)
    rises, falls = (span * reciprocal(t * time + span) for t in (RISE, FALL))
    gain = ca.if_else(found > before.shown, rises, falls)
    shown = before.shown + gain * (found - before.shown)
    seen = ca.fmin(EXCEEDS * ca.sumsqr(force) / 2, before.first)
    first = before.first + span * reciprocal(whole) * (seen - before.first)
    return LongPush(force, shown, first)
