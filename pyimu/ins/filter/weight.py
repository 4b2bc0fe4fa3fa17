"""What of a motion tells the filter something: what exceeds its own errors.

With the errors of ``prediction`` a turn by the vector D in world axes adds A D x (c x phi) to that
of the resting force, as the weight wanders from axis to axis of the body: that tells the tilt from
the accelerometer's bias. But D is measured: with the gyro's noise, with its gains' errors, and in
axes that are themselves tilted by phi. What is of second order in such errors is in no linear
filter, and would undo what they seem to tell. By the noise of a straight leg of 7 s a tilt known to
30 mrad was one known to 26, and by a turn on a level floor, whose axis only seemed tilted, one of
15 mrad one of 5, as the vertical channel is good to 1 mm/s.

So of a turn counts what its own errors do not explain, apart for its vertical part, on which the
horizontal of the error depends, and its horizontal part, on which the vertical does. What of that
does not count acts as noise. And of a scale factor's turn about the axis of a motion only the part
that counts tilts the body.

A velocity counts likewise beside an error of the attitude or of the accelerometer's gains. When a
body whose tilt nobody knows turns on the spot, 2 m/s are estimated and none are there. And what
once counted does until a rest, however much the errors grow on the way: the gains have undone at
the end of a leg what they did at its start, and a tilt makes a climb of all of it.

A heading of which nothing is known makes of the Earth's rate one in any direction. Linear in its
error, a half-turn wide, the least tilt at a stop and the noise of a gyro at rest turned it by tens
of degrees. The bias has that share of the Earth's rate then.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.filter.layout import BASE, HEADING, TURN, Layout, State
from pyimu.numerics.laws import chi2

BY_CHANCE = 1e-3
"""Probability with which errors alone exceed what they may be."""

UPRIGHT, FLAT, ALL = (float(chi2.isf(BY_CHANCE, n)) for n in (1, 2, 3))
"""Squares over the variance of an axis, from which on a vector counts: of its vertical part, of its
horizontal part, of all of it."""

KNOWN = 0.5
"""rad; standard deviation up to which a heading is known well enough that the Earth's rate, which
turns with it, is linear in its error."""

TINY = 1e-30


def upright_of(settings: Settings) -> ca.SX:
    """Gravity's reaction (3,) m/s^2 in world axes."""
    return ca.vertcat(0, 0, settings.scalar["gravity"])


def in_world(layout: Layout, x: State, axes):
    """A = R (1 + M) R^T of the accelerometer (3, 3), with R the ``axes`` (3, 3)."""
    return ca.SX.eye(3) + axes @ layout.matrix(x.gains, "accel") @ axes.T


def earth_by_turn(x: State, earth):
    """What an attitude error makes of the Earth's rate in the body (3, 3), in world axes."""
    known = ca.fmin(1, ca.fmax(0, 2 - x.covariance[HEADING, HEADING] / KNOWN**2))
    return ca.skew(earth) @ ca.diag(ca.vertcat(1, 1, known))


@dataclass(frozen=True)
class Wander:
    """How the weight wanders: the ``shares`` (3,) of a turn about east, north and up that count,
    and the density (m/s^2)^2/s of the ``noise`` of the vertical force that the rest stands for.
    """

    shares: ca.SX
    noise: ca.SX

    @classmethod
    def of(cls, layout: Layout, x: State, rate, axes, mean_time: float, settings: Settings):
        """From the mean ``rate`` (3,) rad/s over ``mean_time`` s in body axes, whose ``axes`` (3,
        3) turn it to the world's.
        """
        spread, gravity = x.covariance, settings.scalar["gravity"]
        turn = axes @ rate
        gains = slice(BASE, BASE + len(layout.gains))
        by_gains = axes @ layout.slopes("gyro", rate)
        own = ca.diag(by_gains @ spread[gains, gains] @ by_gains.T)
        own = own + ca.mmax(settings.gyro.white) ** 2 / (2 * mean_time)
        tilt = (spread[TURN, TURN][0, 0] + spread[TURN, TURN][1, 1]) / 2
        level, upright = ca.sumsqr(turn[:2]), turn[2] ** 2
        of_level = (own[0] + own[1]) / 2 + tilt * upright
        flat = _share(level, FLAT * of_level)
        about = _share(upright, UPRIGHT * own[2])
        # it is alike over a radian of a turn: as white noise of that density it grows as it does
        lasting = 1 / ca.sqrt(ca.fmax(upright, TINY))
        noise = (1 - flat) * about * gravity**2 * level * tilt * lasting
        return cls(ca.vertcat(flat, flat, about), noise)

    def by_tilt(self, spin, upright):
        """What an attitude error before a turn ``spin`` (3, 3) makes of that of the resting force
        after it (3, 3), of an accelerometer without gains.
        """
        turn = ca.vertcat(spin[2, 1] - spin[1, 2], spin[0, 2] - spin[2, 0], spin[1, 0] - spin[0, 1])
        counted = ca.skew(self.shares * turn / 2)
        return -(counted + counted @ counted / 2) @ ca.skew(upright)

    def by_turn(self, shift):
        """Of a ``shift`` (3,) of the weight in body axes, which a level turn makes, what counts."""
        return self.shares[0] * shift

    def by_gains(self, layout: Layout, rate, axes):
        """What the gyro's gains make of a ``rate`` (3,) in body axes, in the world's (3, g)."""
        turn = axes @ rate
        size = ca.fmax(ca.sumsqr(turn), TINY)
        kept = self.shares * turn
        share = ca.sqrt(ca.sumsqr(kept) / size)
        slopes = axes @ layout.slopes("gyro", rate)
        along = turn.T @ slopes / size
        return share * (slopes - turn @ along) + kept @ along


def followed(before, velocity, variance):
    """The velocity (3,) that counts, after one that did ``before``: of the change what the error of
    the ``velocity``, of this ``variance`` per axis, does not explain.
    """
    change = velocity - before
    return before + change * _share(ca.sumsqr(change), ALL * variance)


def bowed(variance):
    """Mean square of 1 - cos z of a normal z of this ``variance``: 3/4 of its square if small."""
    once = ca.exp(-variance / 2)
    return ca.fmax(0, 1.5 - 2 * once + (once**2) ** 2 / 2)


def _share(size, least):
    """0 up to the ``least`` size, 1 from twice of it on."""
    return ca.fmin(1, ca.fmax(0, size / ca.fmax(least, TINY) - 1))
