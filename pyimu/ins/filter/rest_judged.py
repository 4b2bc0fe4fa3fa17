"""Whether what looks still is a rest, by what was measured until now.

A constant speed looks like a rest, and a gentle push does to a window that is shorter than it. Both
begin at a rest: while the window has looked still since, its mean force is that of the rest, over
tenths of a second and over seconds, and a speed that came up within a few seconds of one is known,
whatever the part's errors. What is judged to drive does so for as long as it looks still, or until
that speed has gone, by a push back or by the estimate. Later than some minutes a rest is taken for
one, and where the estimate contradicts it, it is weighed down: a wrong estimate must not keep all
rests out. Where of a drive no more is known than that it is slow, it is told to be so.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.detector import FORCE_KEPT, FORCE_TURNED
from pyimu.ins.filter.kept import Kept
from pyimu.ins.filter.rest_level import GATE, Level, Slow
from pyimu.ins.filter.rest_window import Window
from pyimu.ins.pushes import FOLLOWED, FORCE_STAYS, LEAST_SPEED, MOMENT
from pyimu.ins.speeds import APART, RETURNED
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import reciprocal

RECENT = 5.0
"""s; of motion since a rest, after which no speed is known well enough to keep a rest out."""

LONGEST = 60.0
"""s; of a drive that looks still and is not pushed, after which a rest is taken for one."""

PUSHED, DRIVEN = 2 * LONGEST, 3 * LONGEST
"""s; of a push, and of a drive with its pushes, likewise. Assumed: 0.02 m/s^2 make 2.4 m/s in the
one."""

YOUNG = 2.4
"""s; the force of a rest that is younger may be that of the end of a brake."""

SETTLING, BRIEF = 1.0, 1.0
"""s; a rest of less than the one that is over may have been the middle of a brake; and for less
than the other a body is shoved."""


MOVED, ANEW, SHOVED = 1.0, 2.0, 3.0
"""Kinds: by its velocity the body moves; what was taken for its rest was the end of a motion, and
the rest begins now; it was shoved or pushed out of its rest."""

SIZES = (1, 3, 1, 3, 1)


class Left(NamedTuple):
    """What of these is seen in a sample, 0 for nothing; the ``gain`` (3,) m/s in world axes within
    some ``seconds``, the ``variance`` (3,) of it in body axes, and for how many s the body had
    rested before.
    """

    kind: ca.SX
    gain: ca.SX
    seconds: ca.SX
    variance: ca.SX
    age: ca.SX


NOTHING = Left(*(ca.SX.zeros(size) for size in SIZES))


class Motion(NamedTuple):
    """What is estimated of a body's motion: ``velocity`` (3,) m/s, its ``covariance`` (3, 3), and
    the attitude ``q`` (4,).
    """

    velocity: ca.SX
    covariance: ca.SX
    q: ca.SX


class Seen(NamedTuple):
    """What a sample shows: the ``window`` and the ``slow`` means; whether the window ``looks``
    still and whether a rest was ``told``, 0 or 1; and the ``rate`` (3,) rad/s without the gyro's
    bias.
    """

    window: Window
    slow: Slow
    looks: ca.SX
    told: ca.SX
    rate: ca.SX


@dataclass(frozen=True)
class Judged(Kept):
    """What is kept from sample to sample.

    ``kept`` says whether the window has looked still since the last rest but for moments, 0 or 1;
    ``apart`` s is for how long it has not looked still now, ``moved`` s for how long in all since
    that rest, ``driven`` s how long it looked still and was none; ``calm`` s since when no push was
    seen, and below 0 for how long one lasts; ``fastest`` (3,) m/s is the largest velocity of the
    present drive, 0 without; ``force`` (3,) m/s^2 that of the rest in present axes, ``q`` (4,) its
    attitude; ``returned`` says whether a push back was seen of the present drive, ``rested`` s is
    how long the last rest lasted and ``since`` s how long ago it ended, and
    ``swept`` rad how far the body has turned since, to and fro.
    """

    SIZES: ClassVar = (1, 1, 1, 1, 1, 3, 3, 4, 1, 1, 1, 1)

    kept: ca.SX
    apart: ca.SX
    moved: ca.SX
    driven: ca.SX
    calm: ca.SX
    fastest: ca.SX
    force: ca.SX
    q: ca.SX
    returned: ca.SX
    rested: ca.SX
    since: ca.SX
    swept: ca.SX

    @property
    def resting(self):
        """Whether it was at rest, 0 or 1."""
        return self.kept * (self.moved + self.driven <= 0)

    @property
    def lapsed(self):
        """Whether a drive has looked still for too long, 0 or 1."""
        steady = ca.fmin(self.driven, self.calm) > LONGEST
        return ca.fmax(ca.fmax(steady, self.calm < -PUSHED), self.driven > DRIVEN)


class Verdict(NamedTuple):
    """What is judged of a sample: whether the body is at ``rest``; what of it has ``left``
    one; the square of the speed of a drive of which no more is known, ``slow`` m^2/s^2, 0 of all
    others, and that of a drive that ``ends``.
    """

    rest: ca.SX
    left: Left
    slow: ca.SX
    ends: ca.SX


def judged(
    memory: Judged, x: Motion, seen: Seen, settings: Settings, h
) -> tuple[Verdict, Judged, Level]:
    """What is judged of a sample, and the memories after it."""
    slow, looks, fastest = seen.slow, seen.looks, ca.sumsqr(memory.fastest)
    none, resting, lapsed = fastest <= 0, memory.resting, memory.lapsed
    near = ca.fmax(memory.kept, fastest > 0)
    pushed = _is_pushed(memory, near, seen.window, settings, h)
    pushed = ca.fmax(pushed, near * slow.now)
    moves = (1 - resting) * _moves(memory, x)
    gain = quaternion.rotate(x.q, slow.gain.speed)
    shows, old = looks * memory.kept * slow.left * (1 - slow.leans), slow.gain.age >= YOUNG
    shoved = shows * old * none
    # What has hardly begun to rest and is pushed, or leans, begins to rest now.
    anew = looks * memory.kept * none * ca.fmax(shows * (1 - old), resting * slow.leans)
    settles = memory.kept * (memory.rested < SETTLING) * (memory.moved < BRIEF) * none
    anew = ca.fmax(anew, looks * ca.fmax(moves, pushed) * settles)
    moves, pushed = moves * (1 - settles), pushed * (1 - settles)
    back = ca.dot(gain, memory.fastest) <= -RETURNED * fastest
    returned = ca.fmax(memory.returned, shows * (fastest > 0) * back)
    still_fast = ca.dot(x.velocity, memory.fastest) >= RETURNED * fastest
    gone = ca.fmax((memory.calm < MOMENT) * (1 - still_fast) * (1 - moves), returned)
    drives_on = (fastest > 0) * (memory.apart < APART) * (1 - gone)
    drives = ca.fmax(ca.fmax(drives_on, moves * (memory.moved < RECENT)), ca.fmax(pushed, shoved))
    refused = looks * drives * (1 - lapsed)
    rest = ca.fmax(seen.told, looks * (1 - refused))
    shoved, anew = shoved * (1 - rest), anew * rest
    begins = rest * ca.fmax(ca.fmax(1 - memory.kept, lapsed), anew)
    square, own = _speed(x)
    grown = (fastest > 0) * (square > fastest + GATE * own)
    # A push that goes on makes it faster by so much, whatever is known of the speed.
    onward = ca.dot(quaternion.rotate(x.q, slow.memory.push), memory.fastest) > 0
    faster = refused * ca.fmax(grown, moves * (square > fastest))
    known = memory.fastest + refused * onward * quaternion.rotate(x.q, slow.faster)
    velocity = ca.if_else(shoved, gain, ca.if_else(faster, x.velocity, known))
    after = _after(memory, x, seen, (rest, begins, pushed, returned, velocity), h)
    kind = refused * moves * none * (1 - shoved) * MOVED
    kind = ca.if_else(shoved, SHOVED, ca.if_else(anew, ANEW, kind))
    seconds, variance, age = slow.gain.seconds, slow.gain.variance, slow.gain.age
    verdict = Verdict(
        rest,
        Left(kind, gain, seconds, variance, age),
        refused * (fastest > 0) * (1 - onward) * (own > fastest) * fastest,
        fastest * (ca.sumsqr(after.fastest) <= 0) * (1 - lapsed),
    )
    cleared = ca.fmax(begins, rest * (fastest > 0))
    near = ca.fmax(after.kept, ca.sumsqr(after.fastest) > 0)
    return verdict, after, slow.memory.after(cleared, slow.gain, shoved, near)


def _after(memory: Judged, x: Motion, seen: Seen, now: tuple, h) -> Judged:
    """The memory after a sample, by what is known ``now``: whether the body is at rest, whether one
    begins, whether it is pushed and its push back was seen, and the velocity of its drive.
    """
    rest, begins, pushed, returned, fastest = now
    looks, going, force = seen.looks, 1 - rest, seen.window.force
    apart = (1 - looks) * (memory.apart + h)
    lasts = going * (apart < APART)
    follow = memory.force + (force - memory.force) * h / FOLLOWED
    turned = memory.force - h * (1 - looks) * ca.cross(seen.rate, memory.force)
    longest = ca.if_else(ca.sumsqr(memory.fastest) > 0, APART, BRIEF)
    calm = ca.if_else(pushed, ca.fmin(memory.calm, 0) - h, ca.fmax(memory.calm, 0) + h)
    return Judged(
        kept=ca.fmax(rest, memory.kept * (apart < longest)),
        apart=apart,
        moved=going * (memory.moved + (1 - looks) * h),
        driven=lasts * (memory.driven + looks * h),
        calm=looks * calm,
        fastest=lasts * fastest,
        force=ca.if_else(rest, ca.if_else(begins, force, follow), turned),
        q=ca.if_else(rest, x.q, memory.q),
        returned=lasts * returned,
        rested=ca.if_else(rest, (1 - begins) * memory.rested + h, memory.rested),
        since=going * (memory.since + h),
        swept=going * (memory.swept + h * (1 - looks) * ca.norm_2(seen.rate)),
    )


def _is_pushed(memory: Judged, near, found: Window, settings: Settings, h):
    """Whether the window's mean force is another than that of the rest before, 0 or 1."""
    white = (settings.accel.white * settings.scalar["rest_noise"]) ** 2
    variance = ca.sum1(white) / 3 * reciprocal(h * found.count)
    stays = FORCE_KEPT**2 + FORCE_TURNED**2 * memory.swept**2
    stays = ca.if_else(near, FORCE_STAYS**2, stays)
    off = ca.sumsqr(found.force - memory.force) > GATE * (stays + 2 * variance)
    return off * (ca.sumsqr(memory.q) > 0)


def _chord(memory: Judged, x: Motion):
    """By how much the body has turned since the last rest, squared, of small angles in rad."""
    return 4 * ca.fmax(1 - ca.dot(x.q, memory.q) ** 2, 0)


def _speed(x: Motion) -> tuple:
    """The square of the speed, and the variance of the velocity in its direction."""
    square = ca.sumsqr(x.velocity)
    own = ca.dot(x.velocity, x.covariance @ x.velocity)
    return square, own * reciprocal(ca.fmax(square, 1e-12))


def _moves(memory: Judged, x: Motion):
    """Whether the velocity is another than zero, 0 or 1, by its variance in its own direction and
    by how far the accelerometer's error may have changed since the rest.
    """
    square, own = _speed(x)
    time = memory.moved + memory.driven
    unknown = (FORCE_STAYS**2 + FORCE_TURNED**2 * _chord(memory, x)) * time**2
    drifts = (FORCE_STAYS / 3 * memory.since) ** 2
    variance = own + unknown + drifts
    return square > LEAST_SPEED**2 + GATE * variance
