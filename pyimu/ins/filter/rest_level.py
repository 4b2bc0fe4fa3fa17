"""What the force of a rest is, and whether means over seconds leave it.

A window of tenths of a second shows no push below some hundredths of m/s^2, and no shove that
leaves a speed of centimetres a second. Means over up to ``SLOTS`` parts do, beside the mean force
of the rest before them: what a body gains in speed is the sum of the force less that of the rest.
The error of that is white noise, as much as the means of a rest themselves show, and a force that
does not stay the same.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, NamedTuple

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.filter.kept import Kept
from pyimu.ins.pushes import FOLLOWED, FORCE_STAYS, STEADY_GATE
from pyimu.ins.shoves import SETTLES
from pyimu.symbolic.linear import reciprocal

SLOTS = 16
"""Parts that are kept, each half of a window of rest long."""

LENGTHS = (2, 4, 8, 16)
"""Parts over which means are taken."""

AXES = 6

GATE = STEADY_GATE + 3
"""Squared difference over its variance per axis, beyond which a mean is of another force."""

LEANS = 1e-3
"""rad; a body that is pushed pitches by less on its springs, and one that leans by less changes its
force by less than a push that is seen. Assumed."""

NOISIER = 6.0
"""Of the mean square of a mean's differences, by which a single square counts at most: few of them
are of a push that is not seen yet. Chosen so that a part's flicker of six times the white variance
is learned within seconds, and pushes are not."""

RECENT = 2
"""Parts that show whether what a mean has left the rest's force by still lasts."""

LEAST = 4
"""Parts over which the rest's force must be known for anything to be seen beside it."""


@dataclass(frozen=True)
class Level(Kept):
    """The memory: ``count`` samples of the present part, ``whole`` parts before it, the ``present``
    one's sums (6,) of rate and force, and the means of the ``parts`` before it, the last one first;
    the mean ``force`` (3,) of the rest and the ``age`` s over which it is that; by how much the
    square of a mean's difference exceeds the variance that white noise has, as ``shown`` for each
    of ``LENGTHS``, and over how many s that was ``learned``; the ``push`` (3,) m/s^2 that lasts, 0
    without.
    """

    SIZES: ClassVar = (1, 1, AXES, SLOTS * AXES, 3, 1, len(LENGTHS), 1, 3)

    count: ca.SX
    whole: ca.SX
    present: ca.SX
    parts: ca.SX
    force: ca.SX
    age: ca.SX
    shown: ca.SX
    learned: ca.SX
    push: ca.SX

    def after(self, cleared, pushed: Gain, shoved, near) -> Level:
        """The memory where a rest begins anew (``cleared``, 0 or 1), or where the body is
        ``shoved`` out of one: its force is then that before it was ``pushed``. A push is one beside
        the rest's force while the body is ``near`` that rest, 0 or 1.
        """
        keep = 1 - cleared
        return replace(
            self,
            whole=self.whole * keep,
            count=self.count * keep,
            present=self.present * keep,
            parts=self.parts * keep,
            force=ca.if_else(shoved, pushed.base, self.force),
            age=keep * ca.if_else(shoved, pushed.age, self.age),
            push=keep * near * self.push,
        )


class Gain(NamedTuple):
    """A ``speed`` (3,) m/s in body axes that is gained within some ``seconds``, the ``variance``
    (3,) of it, and the force (3,) of the rest before, over how many s that is known.
    """

    speed: ca.SX
    seconds: ca.SX
    variance: ca.SX
    base: ca.SX
    age: ca.SX


@dataclass(frozen=True)
class Slow:
    """What the means say: whether one has ``left`` the rest's force, and the ``gain`` by the
    longest that has; whether the body is pushed ``now``, and whether it ``leans``, each 0 or 1; how
    much ``faster`` (3,) m/s in body axes a push makes it in this sample; the ``memory`` after it,
    before it is judged.
    """

    left: ca.SX
    gain: Gain
    now: ca.SX
    leans: ca.SX
    faster: ca.SX
    memory: Level


def followed(memory: Level, rate, force, lost, resting, settings: Settings, h) -> Slow:
    """The means after a sample of a ``rate`` (3,), less its bias, and a ``force`` (3,); one that is
    ``lost`` empties them, and ``resting`` says whether all parts are of a rest, 0 or 1.
    """
    length = ca.fmax(1, ca.floor(settings.scalar["rest_window"] / (2 * h) + 0.5))
    part, there = length * h, 1 - lost
    present, count = memory.present + ca.vertcat(rate, force), memory.count + 1
    full = (count >= length) * there
    mean, oldest = present / length, memory.parts[-AXES:][3:]
    into = full * resting * (memory.whole >= SLOTS)
    age = ca.fmin(memory.age + into * part, FOLLOWED)
    level = memory.force + into * (oldest - memory.force) * part * reciprocal(ca.fmax(age, part))
    after = Level(
        count=ca.if_else(full, 0, count) * there,
        whole=(memory.whole + full * (memory.whole < SLOTS)) * there,
        present=ca.if_else(full, 0, present) * there,
        parts=ca.if_else(full, ca.vertcat(mean, memory.parts[:-AXES]), memory.parts) * there,
        force=level,
        age=age,
        shown=memory.shown,
        learned=ca.fmin(memory.learned + full * resting * part, FOLLOWED),
        push=memory.push,
    )
    return _compared(after, force, full, resting, part, settings, h)


def _compared(memory: Level, force, full, resting, part, settings: Settings, h) -> Slow:
    """The means over all ``LENGTHS`` beside the force of the rest, and the ``force`` (3,) now."""
    table = ca.reshape(memory.parts, AXES, SLOTS)
    recent = ca.sum2(table[3:, :RECENT]) / RECENT
    left, leans, shown = ca.SX(0), ca.SX(0), []
    push, ended, size = ca.SX.zeros(3), ca.SX(0), ca.sumsqr(memory.push)
    found = Gain(ca.SX.zeros(3), ca.SX(0), ca.SX.ones(3), memory.force, memory.age)
    for i, k in enumerate(LENGTHS):
        mean, seconds = ca.sum2(table[3:, :k]) / k, k * part
        base, age = _before(memory, table, k, resting, part)
        variance = _variance(seconds, age, part, settings)
        spread, more = ca.sum1(variance), ca.fmax(memory.shown[i], 1)
        off = ca.sumsqr(mean - base)
        known = (memory.whole >= k) * (age >= seconds) * (age >= LEAST * part)
        limit = GATE * more * spread / 3 + (SETTLES / seconds) ** 2
        beyond = known * off > limit
        power = ca.fmin(off / spread, NOISIER * more)
        share = part * reciprocal(ca.fmax(memory.learned, 4 * seconds))
        shown.append(memory.shown[i] + full * resting * known * share * (power - memory.shown[i]))
        left = ca.fmax(left, beyond)
        since = memory.count * h
        speed = seconds * (mean - base) + h * memory.present[3:] - since * base
        own = Gain(speed, seconds + since, (seconds + since) ** 2 * more * variance, base, age)
        found = Gain(*(ca.if_else(beyond, a, b) for a, b in zip(own, found, strict=True)))
        lasts = beyond * (ca.dot(recent - base, mean - base) > off / 2)
        push = ca.if_else(lasts, mean - base, push)
        sure = ca.fmax(size / 4 > GATE * more * spread / 3, k == SLOTS)
        gone = ca.dot(mean - base, memory.push) < size / 2
        ended = ca.fmax(ended, sure * gone * (memory.whole >= k))
        leans = ca.fmax(leans, known * _leans(ca.sum2(table[:3, :k]) / k, base, seconds, settings))
    # as large as it was: while it comes to its end the means are of a part of it
    larger = ca.fmax(ca.sumsqr(push) > size, ca.dot(push, memory.push) < 0)
    other = ca.fmax(larger, ended * (ca.sumsqr(push) > 0))
    push = ca.if_else(other, push, (1 - ended) * memory.push)
    memory = replace(memory, shown=ca.vertcat(*shown), push=push)
    now, faster = ca.sumsqr(push) > 0, h * (force - memory.force)
    return Slow(full * left, found, now, leans, faster, memory)


def _before(memory: Level, table, k, resting, part) -> tuple:
    """The force (3,) of the rest before the last ``k`` parts, and over how many s."""
    age = memory.age + resting * ca.fmax(memory.whole - k, 0) * part
    base = memory.age * memory.force + resting * part * ca.sum2(table[3:, k:])
    return base * reciprocal(ca.fmax(age, part)), age


def _variance(seconds, age, part, settings: Settings):
    """That (3,) of a mean over some ``seconds`` less one over the ``age``, by white noise and by
    what a force does not stay the same.
    """
    white = (settings.accel.white * settings.scalar["rest_noise"]) ** 2
    return white * (1 / seconds + reciprocal(ca.fmax(age, part))) + (FORCE_STAYS / 3) ** 2


def _leans(rate, base, seconds, settings: Settings):
    """Whether the mean ``rate`` (3,) tips the force ``base`` (3,) of the rest, 0 or 1."""
    aside = ca.cross(seconds * rate, base) / settings.scalar["gravity"]
    of_noise = ca.sum1(settings.gyro.white**2) * seconds
    return ca.sumsqr(aside) > LEANS**2 + GATE * of_noise
