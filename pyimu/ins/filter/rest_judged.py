"""Whether what looks still is a rest, by what was measured until now.

A constant speed looks like a rest, and a gentle push does to a window that is shorter than it. Both
begin at a rest: while the window has looked still since, its mean force is that of the rest, and a
speed that came up within a few seconds of one is known, whatever the part's errors. What is judged
to drive does so for as long as it looks still, or until that speed has gone. Later than those few
seconds a rest is taken for one, and where the estimate contradicts it, it is weighed down: a wrong
estimate must not keep all rests out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.detector import FORCE_TURNED
from pyimu.ins.filter.rest_window import Window
from pyimu.ins.pushes import (
    FOLLOWED,
    FORCE_STAYS,
    LEAST_SPEED,
    MOMENT,
    SETTLED,
    STEADY_GATE,
)
from pyimu.ins.speeds import APART, RETURNED
from pyimu.symbolic.linear import reciprocal

RECENT = 5.0
"""s; of motion since a rest, after which no speed is known well enough to keep a rest out."""

LONGEST = 60.0
"""s; of a drive that looks still, after which a rest is taken for one."""

SIZES = (1, 1, 1, 1, 1, 3, 3, 4)

SIZE = sum(SIZES)
"""Numbers of the memory."""

GATE = STEADY_GATE + 3


class Motion(NamedTuple):
    """What is estimated of a body's motion: ``velocity`` (3,) m/s, its ``covariance`` (3, 3), and
    the attitude ``q`` (4,).
    """

    velocity: ca.SX
    covariance: ca.SX
    q: ca.SX


@dataclass(frozen=True)
class Judged:
    """What is kept from sample to sample.

    ``kept`` says whether the window has looked still since the last rest but for moments, 0 or 1;
    ``apart`` s is for how long it has not looked still now, ``moved`` s for how long in all since
    that rest, ``driven`` s how long it looked still and was none; ``calm`` s since when no push was
    seen, and below 0 for how long one lasts; ``fastest`` (3,) m/s is the largest velocity of the
    present drive, 0 without; ``force`` (3,) m/s^2 that of the rest in present axes, ``q`` (4,) its
    attitude.
    """

    kept: ca.SX
    apart: ca.SX
    moved: ca.SX
    driven: ca.SX
    calm: ca.SX
    fastest: ca.SX
    force: ca.SX
    q: ca.SX

    @classmethod
    def unpack(cls, column) -> Judged:
        ends = [sum(SIZES[:i]) for i in range(len(SIZES) + 1)]
        return cls(*ca.vertsplit(column, ends))

    def pack(self) -> ca.SX:
        return ca.densify(ca.vertcat(*vars(self).values()))


def judged(
    memory: Judged, x: Motion, found: Window, looks, told, rate, settings: Settings, h
) -> tuple[ca.SX, ca.SX, Judged]:
    """Whether the body is at rest, and whether it is now seen to drive, 0 or 1, and the memory
    after the sample.

    ``looks`` says whether the window looks still and ``told`` whether a rest was declared, 0 or 1;
    ``rate`` (3,) rad/s is the sample's, without the gyro's bias.
    """
    pushed = _is_pushed(memory, found, settings, h)
    resting = memory.kept * (memory.moved + memory.driven <= 0)
    moves, fastest = (1 - resting) * _moves(memory, x), ca.sumsqr(memory.fastest)
    left = ca.dot(x.velocity, memory.fastest) >= RETURNED * fastest
    gone = (memory.calm < MOMENT) * (1 - left) * (1 - moves)
    drives_on = (fastest > 0) * (memory.apart < APART) * (1 - gone)
    known = ca.fmax(memory.kept, fastest > 0)
    lapsed = ca.fmax(memory.driven > LONGEST, memory.calm < -SETTLED)
    drives = ca.fmax(ca.fmax(drives_on, moves * (memory.moved < RECENT)), known * pushed)
    refused = looks * drives * (1 - lapsed)
    rest = ca.fmax(told, looks * (1 - refused))
    going = 1 - rest
    apart = (1 - looks) * (memory.apart + h)
    begins = rest * ca.fmax(1 - memory.kept, lapsed)
    follow = memory.force + (found.force - memory.force) * h / FOLLOWED
    turned = memory.force - h * (1 - looks) * ca.cross(rate, memory.force)
    faster = refused * moves * (ca.sumsqr(x.velocity) > fastest)
    lasts = going * (apart < APART)
    force = ca.if_else(rest, ca.if_else(begins, found.force, follow), turned)
    after = Judged(
        kept=ca.fmax(rest, memory.kept * (apart < APART)),
        apart=apart,
        moved=going * (memory.moved + (1 - looks) * h),
        driven=lasts * (memory.driven + looks * h),
        calm=looks * ca.if_else(pushed, ca.fmin(memory.calm, 0) - h, ca.fmax(memory.calm, 0) + h),
        fastest=lasts * ca.if_else(faster, x.velocity, memory.fastest),
        force=force,
        q=ca.if_else(rest, x.q, memory.q),
    )
    return rest, refused * moves * (fastest <= 0), after


def _is_pushed(memory: Judged, found: Window, settings: Settings, h):
    """Whether the window's mean force is another than that of the rest, 0 or 1."""
    white = (settings.accel.white * settings.scalar["rest_noise"]) ** 2
    variance = ca.sum1(white) / 3 * reciprocal(h * found.count)
    return ca.sumsqr(found.force - memory.force) > GATE * (FORCE_STAYS**2 + 2 * variance)


def _moves(memory: Judged, x: Motion):
    """Whether the velocity is another than zero, 0 or 1, by its variance in its own direction and
    by how far the accelerometer's error may have changed since the rest.
    """
    square = ca.sumsqr(x.velocity)
    own = ca.dot(x.velocity, x.covariance @ x.velocity)
    chord = 4 * ca.fmax(1 - ca.dot(x.q, memory.q) ** 2, 0)
    time = memory.moved + memory.driven
    unknown = (FORCE_STAYS**2 + FORCE_TURNED**2 * chord) * time**2
    variance = own * reciprocal(ca.fmax(square, 1e-12)) + unknown
    return square > LEAST_SPEED**2 + GATE * variance
