"""What the run learns of the magnetic field from a sample: strength and dip, delay, a new place."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca

from pyimu.attitude.filter.field import ATTITUDES, TINY, Field
from pyimu.attitude.filter.gravity_update import tilt_variance, vertical
from pyimu.attitude.filter.late_heading import wrapped
from pyimu.attitude.filter.layout import Layout
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.timing import clock_error
from pyimu.attitude.filter.unscented import LARGEST_STD, Estimate
from pyimu.symbolic import quaternion

TURN = 1.0
"""rad; correlation angle of what is fixed to the body. A bias turns the direction by a cosine of
the body's attitude, whose autocorrelation has fallen to 1/e after 1.2 rad; soft iron has twice the
angle."""

WINDOW = 20.0
"""Attitudes over which the mean square of what turns with the body is averaged: it is then known to
a fifth."""

SMOOTHED = 0.2
"""s; over which noise is averaged out of strength, dip and direction."""

MEAN = 0.25
"""Share of the variance of what is fixed to the body that lasts all the same, because the body does
not take every attitude."""

FAST = 1.0
"""s; correlation time that stands for what changes faster than the body turns by ``TURN``. Chosen
on recordings 02, 11 and 26 of ``benchmarks/attitude_real.py``; from 0.5 to 4 s it makes little
difference."""

NEW_PLACE = 20.0
"""s; a field that differs from the known one, and stays as it is for so long, is that of a new
place."""

MOST = 2 * LARGEST_STD**2
"""rad^2; most variance of either of two angles of which the sum is then seen: each has half of it
then, no more than any angle has."""

BEYOND = 3.0
"""Standard deviations, of what turns with the body and of the tilt, by which strength and dip may
differ."""


@dataclass(frozen=True)
class Step:
    """What there is of a sample: its settings, its period ``h`` in s by the gyro's clock, and the
    body's ``turn`` (3,) rad in the period, against the world, of what was measured the share
    ``moving``.

    ``attitudes`` is how much of ``TURN`` that is, beside the gyro's noise.
    """

    settings: Settings
    h: ca.SX
    moving: ca.SX
    turn: ca.SX
    attitudes: ca.SX

    @classmethod
    def of(cls, layout: Layout, x: Estimate, p, h, rate, moving) -> Step:
        """Of the parameters, the compensated ``rate`` (3,) rad/s and the estimate ``x``."""
        settings = Settings.of(layout.compensation, p)
        h = h * (1 + clock_error(layout.compensation.part.gyro, settings.gyro_p))
        earth = quaternion.rotate(quaternion.conjugate(x.q), settings.earth)
        turned = (rate - x.bias - earth) * h * moving
        noise = 4 * ca.sumsqr(settings.gyro.white) * h
        size = ca.sqrt(ca.fmax(ca.sumsqr(turned) - noise, 0))
        return cls(settings, h, moving, turned, size / TURN)

    def __getitem__(self, name: str):
        return self.settings.scalar[name]


def stationary(kept: Field, step: Step):
    """The covariance (2, 2) in rad^2 of the parts of which nothing is known."""
    known = direction_variance(kept.known, ca.vertcat(kept.scatter, lasting_square(kept, step)))
    return ca.diag(ca.fmin(known + ca.vertcat(0, kept.bent), LARGEST_STD**2))


def lasting_time(kept: Field, step: Step):
    """Correlation time in s of what lasts of the direction.

    Where it may be bent for good it wanders about no faster than in any place, and farther.
    """
    usual = direction_variance(kept.known, lasting_square(kept, step))
    return step["field_time"] * (1 + kept.bent / ca.fmax(usual, TINY))


def lasting_square(kept: Field, step: Step):
    """What lasts of the field across its horizontal direction in every place, T^2."""
    return step["field_std"] ** 2 + MEAN * kept.scatter


def direction_variance(known, square):
    """Variance in rad^2 that ``square`` T^2 across the ``known`` field (2,) gives its direction."""
    return ca.fmin(square / ca.fmax(known[0], 1e-12) ** 2, LARGEST_STD**2)


def parts_of(seen):
    """Horizontal and upward part (2,) of the field ``seen`` (3,) in world axes."""
    return ca.vertcat(ca.norm_2(seen[:2]), seen[2])


def delayed(kept: Field, now, slope, x: Estimate, dt, step: Step) -> Field:
    """The memory with the magnetometer's delay, as strength and dip ``now`` (2,) show it.

    Through the attitude of now a field F of d s ago is F + d w x F, with w the body's rate: a
    regression on its ``slope`` (2,), of which an error of the tilt must not be taken for delay.
    """
    tilt = tilt_variance(x.covariance, vertical(x)) * ca.sumsqr(kept.known)
    weight = dt / (density(kept, step) + 2 * FAST * tilt + TINY)
    known = kept.late[1] + weight * ca.sumsqr(slope)
    change = weight * ca.dot(slope, now - kept.known) / known
    return replace(kept, late=ca.vertcat(kept.late[0] + change, known))


def density(kept: Field, step: Step):
    """Density in T^2 s of what changes within seconds."""
    return step["field_noise"] ** 2 + 2 * FAST * kept.scatter


def begun(kept: Field, now, usable, step: Step) -> Field:
    """The memory with the field of the first sample, where there was none.

    What is known of the place's stays; then the sample may show a disturbed one.
    """
    first = usable * (kept.learnt <= 0)
    known = ca.if_else(kept.learnt < 0, kept.known, now)
    begun = replace(kept, known=known, smooth=now, learnt=ca.fabs(kept.learnt))
    begun = replace(begun, covariance=stationary(begun, step))
    return chosen(first, begun, kept)


def chosen(flag, a: Field, b: Field) -> Field:
    """``a`` where the flag holds, else ``b``."""
    return Field(
        *(ca.if_else(flag, v, w) for v, w in zip(vars(a).values(), vars(b).values(), strict=True))
    )


def tolerance_of(kept: Field, x: Estimate, step: Step):
    """By how many T^2 the square of what strength and dip are off may be that of a good field."""
    size = ca.sumsqr(kept.known)
    wide = ca.fmax(size * step["field_tolerance"] ** 2, 2 * BEYOND**2 * kept.scatter)
    return wide + BEYOND**2 * size * tilt_variance(x.covariance, vertical(x))


def followed(kept: Field, now, usable, good, x: Estimate, dt, step: Step) -> Field:
    """The memory after horizontal and upward part ``now`` (2,) of a ``usable`` field, and what a
    ``good`` one shows.
    """
    tilt = tilt_variance(x.covariance, vertical(x)) * ca.sumsqr(kept.known)
    looks = good * (step.attitudes + dt / step["field_time"])
    smooth = kept.smooth + good * dt / (SMOOTHED + dt) * (now - kept.smooth)
    difference = smooth - kept.known
    known = kept.known + looks / (kept.learnt + looks + TINY) * difference
    noise = step["field_noise"] ** 2 / (2 * SMOOTHED) + tilt / 2
    excess = ca.sumsqr(difference) / 2 - noise - kept.scatter
    scatter = ca.fmax(kept.scatter + looks / (WINDOW + looks) * excess, 0)
    return replace(
        kept,
        known=known,
        learnt=ca.fmin(kept.learnt + looks, ATTITUDES),
        smooth=smooth,
        scatter=(step["field_turning_std"] > 0) * scatter,
        off=ca.if_else(usable, 1 - good, kept.off),
        known_for=kept.known_for + good * dt,
    )


def in_new_place(
    kept: Field, now, aside, usable, good, tolerance, x: Estimate, dt, step: Step
) -> tuple[Field, ca.SX, ca.SX]:
    """The memory with the ``other`` field after a sample that is not ``good``, and with that as the
    known one if it has lasted; whether it has, and what the heading is then less known by, rad^2.

    Which of the two is bent nobody knows: that it is the one has the odds of the time for which the
    other has been seen. The angle from north to the new one is seen by the heading: by that this is
    off as far as it leaned on the old one, or the new one's direction is. That is also off by as
    much as strength and dip are. Where these are within the ``tolerance`` T^2 of the old one's, so
    that the field is but seen ``aside`` of where it was, rad, the heading may as well be wrong by
    itself, and was right for as long as they agreed.
    """
    off, change = usable - good, now - kept.other
    begins = ca.logic_or(kept.other_for <= 0, ca.sumsqr(change) > tolerance)
    gain = ca.if_else(begins, 1, dt / (kept.other_for + dt))
    lasted = ca.if_else(begins, dt, kept.other_for + dt)
    other = kept.other + off * gain * change
    lasted = ca.if_else(off, lasted, ca.fmax(kept.other_for - good * dt, 0))
    new = lasted > NEW_PLACE
    between = ca.sumsqr(other - kept.known)
    alike, up = between <= tolerance, vertical(x)
    share = NEW_PLACE / (NEW_PLACE + kept.known_for)
    wrong = ca.fmax(share * _leaned(kept, up, step) ** 2, alike * share / (1 + share))
    square = wrapped(aside + ca.if_else(alike, 0, ca.sum1(kept.turned))) ** 2
    # What of these is beyond MOST the next sample could not tell from an angle that may be any.
    room = ca.fmax(MOST - ca.dot(up, x.covariance[:3, :3] @ up), 0)
    doubt = new * ca.fmin(wrong * square, room)
    bent = ca.fmin((1 - wrong) * square, MOST)
    here = _elsewhere(kept, other, bent, between, alike, step)
    after = replace(chosen(new, here, kept), other=other, other_for=lasted * (1 - new))
    return after, new, doubt


def _leaned(kept: Field, up, step: Step):
    """Which share of an angle by which the field was bent all the time the heading has, 0 to 1.

    The regression of its error on what lasts of the direction tells that of an angle as it is now.
    Of what wanders in the time T, the mean over a time t had T/t (1 - exp(-t/T)) of it at the end
    of that, some 1 / (1 + t/2T), and exp(-t/T) as much a time t later, some 1 / (1 + t/T).
    """
    now = ca.dot(up, kept.shared[:3, 1]) / ca.fmax(kept.covariance[1, 1], TINY)
    rate = 1 / lasting_time(kept, step)
    leaned = now * (1 + kept.known_for * rate / 2) * (1 + NEW_PLACE * rate)
    return ca.fmin(ca.fmax(leaned, 0), 1)


def _elsewhere(kept: Field, other, bent, between, alike, step: Step) -> Field:
    """The memory in the ``other`` field (2,), whose direction is off by ``bent`` rad^2 for good.

    Of a field that is not ``alike``, 0 or 1, that is at least what its square from the known one
    makes, ``between`` T^2, and nothing else is known of it.
    """
    usual = direction_variance(other, ca.vertcat(kept.scatter, lasting_square(kept, step)))
    differs = direction_variance(other, lasting_square(kept, step) + between / 2)
    lasting = ca.fmax(differs, bent)
    bent_still = ca.diag(ca.vertcat(0, bent)) + kept.covariance
    anew = ca.diag(ca.vertcat(usual[0], lasting))
    return replace(
        kept,
        known=ca.if_else(alike, kept.known, other),
        learnt=ca.if_else(alike, kept.learnt, 1),
        smooth=ca.if_else(alike, kept.smooth, other),
        turned=alike * kept.turned,
        covariance=ca.if_else(alike, bent_still, anew),
        shared=alike * kept.shared,
        beside=ca.SX(0),
        known_for=ca.SX(NEW_PLACE),
        bent=ca.if_else(alike, kept.bent + bent, lasting - usual[1]),
    )
