"""The slow part of the body's velocity: how much of it there is, as the run itself shows.

A tilt that is wrong makes a velocity that grows slowly, and a slow velocity is taken for one. How
well the velocity tells of the tilt is therefore a matter of its density at low frequency. One of
the variance s^2 and the correlation time T has 2 T s^2 there; one that goes to and fro fast, as of
a hand that shakes, of taps and vibration, has next to nothing.

The innovations of a filter whose model is right are white (Mehra 1972, section III), so that their
density is that of the measurement, here the velocity of the body. It is looked at where it tilts
the attitude. With a velocity of density R, a gyro of density Q and g the filter is that of a double
integrator: v' = g p + k (y - v), p' = w^2 / g (y - v) with w^2 = g sqrt(Q / R) and k = sqrt(2) w,
so that the tilt has the velocity's noise by w^2 s / (s^2 + k s + w^2), which passes what is near
the frequency w. The difference of two low passes of the time 1/w in a row passes s w / (s + w)^2,
of the same slopes. k is P over R, P the filter's own variance of the velocity. What the gyro's own
errors add there makes the density larger, and never less.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.symbolic.linear import reciprocal

SLOWNESS = 2**0.5
"""1/w over R/P, the time in which the filter follows the velocity. White noise of density D leaves
D / (4 times 1/w) of variance in the difference of the two low passes."""

LONGEST = 10.0
"""Correlation times of the velocity that such a low pass takes at most."""

SPAN = 15.0
"""Times of the low pass over which the density is averaged: on two axes to a seventh of itself.
Chosen with seeds 5, 902 and 903 of ``benchmarks/attitude_honesty.py``, as the two that follow."""

PRIOR = 0.01
"""Weight of a velocity of the correlation time T against what the run has shown, where both have
the same size; it grows with the square of the present size, of which the run has shown nothing."""

START = 1e-4
"""(m/s)^2; variance of a velocity of which little has been seen before the run."""

PUSHED = 0.03
"""Correlation times over which a drift (``velocity.Motion``) is not believed at all. From .03 to .5
vehicles come out the same; with .5 a body that was pushed does not know its velocity well enough to
be called at rest, with 0 the heading of a vehicle is 1.2 to 1.6 times as far off."""

LEAST = 0.03
"""s; what the accelerometer's noise makes of velocity in so short a time is the least."""

TINY = 1e-12
"""(m/s)^2; stands for no variance where it is divided by."""


@dataclass(frozen=True)
class SlowMotion:
    """The slow part of the body's velocity across the vertical.

    ``low`` (4,) m/s are the two low passes of its parts east and north, ``lagged`` m^2/s the
    density of a velocity of its size and of the correlation time T, as late as these; ``seen`` and
    ``expected`` m^2/s are the means of the density that they show and of that one. ``used`` m^2/s
    is the density with which the velocity is measured, ``share`` how much that is of 2 T s^2.
    """

    low: ca.SX
    lagged: ca.SX
    seen: ca.SX
    expected: ca.SX
    used: ca.SX
    share: ca.SX

    @classmethod
    def start(cls, variance, time) -> SlowMotion:
        """That before the first sample, of a velocity with a ``variance`` in (m/s)^2."""
        little = 2 * time * START
        return cls(ca.SX.zeros(4), little, little, little, 2 * time * variance, ca.SX(1))

    def pack(self) -> tuple:
        return tuple(vars(self).values())


SIZES = (4, 1, 1, 1, 1, 1)
"""Of what ``SlowMotion.pack`` gives."""


@dataclass(frozen=True)
class Bounds:
    """Between what the density lies: the least ``share`` of that of the correlation ``time`` in s
    that it is believed to have, and what the ``noise`` of the accelerometer, (m/s^2)^2 s, makes.
    ``unlevelled`` is how little was known of the tilt before the first sample, 0 to 1.
    """

    share: ca.SX
    noise: ca.SX
    time: ca.SX
    unlevelled: ca.SX | float = 0.0

    @property
    def least(self):
        """m^2/s; the least density."""
        return self.noise * LEAST**2


def followed(
    before: SlowMotion, level, variance, drift, own, bounds: Bounds, span, h
) -> SlowMotion:
    """The slow motion after one more look.

    ``level`` (2,) m/s is the mean velocity east and north over a ``span`` in s, before the
    measurements of its samples, of period ``h`` s. ``own`` (m/s)^2 is the variance of a sample's
    velocity in the filter, ``variance`` (m/s)^2 that of the body's velocity and ``drift`` (m/s)^2
    what it has beside.
    """
    whole = 2 * bounds.time * variance
    follows, least, most = SLOWNESS * before.used, 2 * span, LONGEST * bounds.time
    time = ca.fmin(ca.fmax(follows * reciprocal(own + TINY), least), most)

    def gain_over(times):
        """span / (``times`` time + span), without waiting for the quotient that the time is."""
        within = span * (own + TINY) * reciprocal(times * follows + span * (own + TINY))
        longest, shortest = span / (times * most + span), 1 / (2 * times + 1)
        return ca.fmin(ca.fmax(within, longest), shortest)

    gain, slow_gain = gain_over(1.0), gain_over(SPAN)
    first = before.low[:2] + gain * (level - before.low[:2])
    second = before.low[2:] + gain * (first - before.low[2:])
    found = 2 * time * ca.sumsqr(first - second) - own * h
    lagged = before.lagged + gain * (whole - before.lagged)
    seen = before.seen + slow_gain * (found - before.seen)
    expected = before.expected + slow_gain * (lagged - before.expected)
    prior = PRIOR * whole * ca.fmax(1, whole * reciprocal(expected + TINY))
    share = (ca.fmax(seen, 0) + prior) * reciprocal(expected + prior + TINY)
    share = ca.fmin(ca.fmax(share, bounds.share), 1)
    density = ca.fmax(ca.fmax(whole * share, PUSHED * bounds.time * drift), bounds.least)
    used = density * reciprocal(whole + TINY)
    return SlowMotion(ca.vertcat(first, second), lagged, seen, expected, density, used)
