"""Rest within a run: how a body at rest is told from one that moves, and what that may get wrong.

At rest no sample differs from the mean of those before it by more than noise, neither the rate nor
the force. The gyro then measures its own bias, and what noise it has since the last sample is no
turn. A body that turns steadily about the vertical looks the same; it is taken for one at rest
only where the bias is not known better.

A body that drives on evenly, on a smooth way, looks the same, too, and may turn slowly about the
vertical, as on a bend. While the velocity is not known, stillness is a rest without doubt only of a
body that was seen to shake where it drove. In doubt the gyro measures its bias about the level axes
alone, and the heading is turned on by it.

A body that is held still sways. Below ``1 / FAST`` Hz the density of the rate beyond the gyro's own
is that of the sway, by which a sample is trusted less. One that sways floats, flies or is held, and
stands on nothing that would keep it from turning slowly about the vertical, as a ship at its
anchor: that is doubt as well.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.symbolic.linear import reciprocal

FAST, SLOW = 0.3, 3.0
"""s; time constants of two means of the rate. Their difference shows what is slower than noise."""

SHARE = (SLOW - FAST) ** 2 / (2 * FAST * SLOW * (FAST + SLOW))
"""Mean square in 1/s of that difference for noise of density 1: each mean alone has the variance
1/(2 T), the two together 1/(T1 + T2)."""

SWAY_TIME = 10.0
"""s; time constant of the density of the sway: some thirty independent values of that difference,
on three axes."""

BY_CHANCE = 1.3
"""Times the density of white noise that the sway must exceed: twice by what it scatters."""

SWAYS, FLICKERS = 6.5, 3e-9
"""By how much more than the density of white noise, over the root of the s over which it is taken,
and (rad/s)^2 s beside it: beyond that a body sways. Of three values in a second, chi-squared, that
is by chance once in ten million over 10 s, and in a million over 3 s. After 10 s it is 3 times the
density; the rests of BROAD on a table have 0.7 to 1.7 times, and a flicker of 20 deg/h has the
second. A ship that rolls by 0.05 deg in 8 s has 4 times that of a consumer's gyro."""

TURN_STD = 0.01
"""rad/s; of the turn of a body that sways, 20 deg in half a minute."""

OUTLIER = 30.0
"""Squared noise of three axes over the variance of one, which a sample exceeds with a probability
of 1.4e-6."""

MOVES = 16.3
"""The same, which the mean force of one rest in a thousand exceeds: that is put off."""

GATE = 25.0
"""Squared difference of rate and bias over its variance beyond which a body turns steadily."""

NEW = 9.0
"""The same about the vertical of a body that was not at rest before. A bias of the standard
deviation s is as probable there as an even turn of up to w where the square is 2 ln(w / s): 6 with
0.05 and 1 deg/s."""

UNKNOWN, LONGER, LEAST_TURN = 2e-3, 2.5, 6e-4
"""rad/s, s, rad/s; of a gyro whose bias about the vertical is less known than that a turn by hand
would pass for a rest unless gravity moves in the body's axes. That it does not shows in so long a
time to a thirtieth of a degree per second, the last."""

DRIFTS = 7.0
"""1/sqrt(s); times the gyro's white noise by which its bias is soon another where its part does not
say so, as it warms up or as gravity comes to pull it another way: a gyro of 1 deg/sqrt(h) by 0.1
deg/s, one of 0.1 deg/sqrt(h) by 40 deg/h. It is at most ``UNKNOWN``."""

TELLS, MOST_FORCE = 2.0, 1.2
"""How often what ``turns`` can tell a level rate must be, so that gravity that stands still in the
body's axes excludes it: noise hides such a turn with four standard deviations. And the most force
over gravity. A vehicle that turns evenly, leaning as it is pushed, turns about the vertical alone,
which is farther from a force of that size than the level is only beyond the root of 2."""

LEAST_FORCE = 1e-6
"""(m/s^2)^2; a smaller one has no direction."""

STEADY, SLOW_SWAY = 0.1, 0.5
"""Shares of a sample's tolerance that are those of the mean, of force and rate: gravity that turns
in the body's axes by 2e-3 rad changes the mean force by 0.02 m/s^2. The mean shows that a motion
begins while its samples are still lost in noise."""

CALM_TIME = 10.0
"""s; of a drive, over which the share of it that looks like rest is averaged."""

CALM = 0.2
"""That share beyond which a rest is not told from driving on: of a drive that begins by being taken
for calm, 16 s must shake, or a sixth of that for each second that looked like rest before."""

LEAST_CALM = 1e-9
"""Share of a drive that is as good as none: one that fell on would come to numbers with which a
processor is slow (half as slow again for the whole step, after an hour of a body that shakes)."""


@dataclass(frozen=True)
class Stillness:
    """What the samples since the last that moved show.

    Of the rate (3,) rad/s and the force (3,) m/s^2 a ``fast`` and a ``slow`` mean; ``density``
    (rad/s)^2 s is that of the rate at low frequency, ``span`` s how long nothing has moved.
    ``rests`` says that this is a rest (1) and no steady turn (0), or was one until now (-1).
    """

    fast: ca.SX
    slow: ca.SX
    fast_force: ca.SX
    slow_force: ca.SX
    density: ca.SX
    span: ca.SX
    rests: ca.SX

    @classmethod
    def start(cls) -> Stillness:
        return cls(*(ca.SX.zeros(size) for size in SIZES))

    def pack(self) -> tuple:
        return tuple(vars(self).values())


SIZES = (3, 3, 3, 3, 1, 1, 1)
"""Of what ``Stillness.pack`` gives."""


def is_still(x: Stillness, rate, force, tolerance, noise, h):
    """Whether a ``rate`` (3,) rad/s and a ``force`` (3,) m/s^2 are like those before, 0 or 1.

    ``tolerance`` are by how much the two may be off beside white ``noise``, each (3,) of the
    variance of a sample.
    """
    rate_off, force_off = tolerance
    rate_noise, force_noise = (OUTLIER / 3 * ca.sum1(v) for v in noise)
    return (
        (ca.sumsqr(rate - x.slow) <= rate_off**2 + rate_noise)
        * (ca.sumsqr(force - x.slow_force) <= force_off**2 + force_noise)
        * (
            ca.sumsqr(x.fast_force - x.slow_force)
            <= (STEADY * force_off) ** 2 + force_noise * SHARE * h
        )
        * (ca.sumsqr(x.fast - x.slow) <= (SLOW_SWAY * rate_off) ** 2 + rate_noise * SHARE * h)
    )


def followed(x: Stillness, rate, force, still, h) -> Stillness:
    """The same after one more sample, which ``still`` (0 or 1) says to be like the others.

    Whether it ``rests`` stays as it is.
    """
    span = still * (x.span + h)
    share = h / ca.fmax(span, h)

    def mean(before, value, time):
        return before + ca.fmax(share, h / (time + h)) * (value - before)

    fast, slow = mean(x.fast, rate, FAST), mean(x.slow, rate, SLOW)
    seen = ca.sumsqr(fast - slow) * (1 / (3 * SHARE))
    return Stillness(
        fast,
        slow,
        mean(x.fast_force, force, FAST),
        mean(x.slow_force, force, SLOW),
        still * mean(x.density, seen, SWAY_TIME),
        span,
        x.rests,
    )


def calmer(calm, before: Stillness, still, may_drive, h):
    """The share ``calm`` of a drive that looks like rest, after one more sample.

    It changes where the body ``may_drive`` (0 or 1) because its velocity is not known, with every
    sample that is not ``still`` (0 or 1): that ends what had looked like rest ``before`` without
    being one, if it lasted longer than samples of a shaking body do by chance.
    """
    ended = before.span * (before.rests <= 0) * (before.span > FAST)
    after = (calm * CALM_TIME + ended) / (CALM_TIME + ended + h)
    return ca.fmax(calm + may_drive * (1 - still) * (after - calm), LEAST_CALM)


def kept(before: Stillness, after: Stillness, safe, later, now) -> tuple:
    """What was known ``FAST`` to twice that before, and up to that, after one more sample.

    The last samples before one that shows a motion may be of that motion: ``safe`` was known before
    them. ``later`` takes its place in time, and ``now`` that one's.
    """
    due = passes(before.span, after.span)
    return ca.if_else(due, later, safe), ca.if_else(due, now, later)


def passes(before, after):
    """Whether a span of ``before`` s that has become ``after`` s has passed a multiple of ``FAST``,
    0 or 1.
    """
    return ca.floor(after * (1 / FAST)) > ca.floor(before * (1 / FAST))


def is_rest(rate, covariance, up, noise, span, rests=1, drifts=0):
    """Whether a body that has been still for ``span`` s rests, 0 or 1.

    ``rate`` (3,) rad/s is its mean rate less the bias as it was known, with this ``covariance`` (3,
    3); ``up`` (3,) is the vertical, ``noise`` (rad/s)^2 s the density of the gyro's white noise. A
    body that ``rests``, 0 or 1, does so until that is contradicted. A bias that ``drifts``
    (rad/s)^2 beyond what its part says is more likely than so slow an even turn.
    """
    along, own, white = ca.dot(up, rate), ca.dot(up, covariance @ up), noise / span
    level = ca.sumsqr(rate) - along**2 <= GATE * (ca.trace(covariance) - own + 2 * white)
    gate = ca.if_else(rests, GATE, NEW)
    return level * (along**2 <= ca.fmax(gate * (own + white), drifts))


def soon_drifts(noise):
    """(rad/s)^2 by which the bias of a gyro of this white ``noise`` (rad/s)^2 s is soon another."""
    return ca.fmin(DRIFTS**2 * noise, UNKNOWN**2)


def turns(x: Stillness, gravity, noise, h):
    """Whether gravity [m/s^2] moves in the axes of a body that has been still, 0 or 1.

    ``noise`` (3,) (m/s^2)^2 is the variance of a sample of the accelerometer.
    """
    return ca.sumsqr(x.fast_force - x.slow_force) > _told_turn(x, gravity, noise, h)[1]


def _told_turn(x: Stillness, gravity, noise, h):
    """By how many s the one mean is later than the other, and the least square of their difference
    in (m/s^2)^2 that tells a turn.
    """
    later = ca.fmin(x.span / 2, SLOW) - FAST
    by_noise = MOVES / 3 * ca.sum1(noise) * SHARE * h
    return later, (LEAST_TURN * gravity * later) ** 2 + by_noise


def wrong_bias(x: Stillness, rate, covariance, density, gravity, noise, h):
    """Variance in (rad/s)^2 of an axis by which a bias is wrong that a body at rest contradicts.

    By ``rate`` (3,) rad/s, the mean less the bias as it was known with this ``covariance`` (3, 3),
    the body turns about a level axis, far more than that and noise of this ``density`` (rad/s)^2 s
    make it. Then gravity would turn in its axes; where it does not, the bias has drifted as its
    part does not say. Elsewhere it is 0. ``gravity`` and ``noise`` as for ``turns``.
    """
    force, span = ca.fmax(ca.sumsqr(x.slow_force), LEAST_FORCE), ca.fmax(x.span, h)
    up = x.slow_force * reciprocal(ca.sqrt(force))
    along = ca.dot(up, rate) ** 2
    level = ca.sumsqr(rate) - along
    own = ca.trace(covariance) - ca.dot(up, covariance @ up) + 2 * density * reciprocal(span)
    later, least = _told_turn(x, gravity, noise, h)
    told = TELLS**2 * least <= level * (gravity * later) ** 2
    stands = (x.span >= LONGER) * (1 - turns(x, gravity, noise, h))
    leans = 1 - (along <= level) * (force <= (MOST_FORCE * gravity) ** 2)
    return stands * told * (1 - leans) * (level > GATE * own) * level / 2


def begins(before: Stillness, after: Stillness, time, unknown, moves, h):
    """Whether with this sample the body has been still so long that it may rest, 0 or 1.

    That is ``time`` s, and each ``LONGER`` where the bias about the vertical is ``unknown`` (0 or
    1): then gravity may not move (``turns``), which ``moves`` says.
    """
    longer = ca.fmax(time, LONGER)
    soon = (before.span + h / 2 < time) * (after.span + h / 2 >= time)
    late = ca.floor((after.span + h / 2) / longer) > ca.floor((before.span + h / 2) / longer)
    return ca.fmax(soon * (1 - unknown), late * (before.rests <= 0) * (1 - unknown * moves))


def share_of_noise(x: Stillness, noise):
    """Which share of a sample's rate less bias is noise, in a rest.

    ``noise`` (rad/s)^2 s is the density of the gyro's own.
    """
    return noise / (noise + sway(x, noise))


def sways(x: Stillness, noise):
    """Whether a body that is still stands on nothing solid, 0 or 1; ``noise`` as for ``sway``."""
    return (x.span >= SLOW) * (x.density > swaying_density(x.span, noise))


def stands(x: Stillness, noise):
    """Whether a body has been still for long and clearly does not sway, 0 or 1."""
    return (x.span >= SWAY_TIME) * (2 * x.density <= swaying_density(x.span, noise) + noise)


def swaying_density(span, noise):
    """The density of the rate in (rad/s)^2 s over ``span`` s beyond which a body sways."""
    over = ca.fmax(ca.fmin(span, SWAY_TIME), SLOW)
    return (1 + SWAYS * reciprocal(ca.sqrt(over))) * noise + FLICKERS


def turns_unseen(before: Stillness, after: Stillness, noise, known, own):
    """Variance in (rad/s)^2 of the turn about the vertical that a rest has hidden until the sample
    with which it shows that the body sways, and 0 with any other.

    ``known`` (rad/s)^2 was that of the bias before the rest, ``own`` is what it has become since.
    """
    shows = sways(after, noise) * (1 - sways(before, noise))
    return shows * ca.fmax(ca.fmin(known, TURN_STD**2) - own, 0)


def sway(x: Stillness, noise):
    """Density in (rad/s)^2 s of the rate that is no ``noise`` of the gyro."""
    return ca.fmax(x.density - BY_CHANCE * noise, 0)
