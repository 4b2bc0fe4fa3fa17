"""A heading that arrives late: the rings of past yaws and of their noise, and where in them a
sample of some age stands.

The first ring keeps the yaw of past samples less what headings have corrected since the start: with
the present correction it is the yaw that the filter now believes the body had then. The second
keeps the variance that the gyro's noise and losses have added about the vertical since the start:
the difference to now is what they have added since.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

SLOTS = 64
"""Yaws that are kept; SLOTS - 1 spans make up ``heading_memory``, a span being at least a sample.
"""

NEVER = 1e9
"""A yaw that was not: before the first sample, or of a body that pointed up or down. As a place it
is past a slot's end, so that the first sample starts the first slot."""


ROUNDING = 1e-6
"""Samples by which a span may exceed a whole number and still count as that."""


def samples_per_slot(memory, h):
    """Samples from one kept direction to the next, a whole number."""
    return ca.fmax(1, ca.ceil(memory / ((SLOTS - 1) * h) - ROUNDING))


def following(index, within, memory, h):
    """Slot and place within its span of the sample after that at ``within`` of slot ``index``; a
    slot keeps its last sample.

    The condition is that of ``samples_per_slot``, without rounding it up.
    """
    full = (within + 1 + ROUNDING) * ((SLOTS - 1) * h) >= memory
    index = index + full
    return index - SLOTS * (index >= SLOTS), (1 - full) * (within + 1)


def _wrapped(index):
    return index + SLOTS * (index < 0)


def wrapped(angle):
    """``angle`` in rad within half a turn, which it may exceed by a few turns."""
    return angle - 2 * np.pi * ca.floor(angle / (2 * np.pi) + 0.5)


def oldest(each):
    """Age in samples up to which every sample is kept, whatever stands in the newest slot."""
    return (SLOTS - 1) * each


def place(age, index, within, each):
    """Slots between which the sample lies that is ``age`` >= 1 samples old, and how far towards the
    second.

    Slot ``index`` is one sample old and holds sample ``within`` of its span.
    """
    within = ca.fmin(within, each - 1)
    inside = age - 1 < within + 1
    steps = (age - 1 - (within + 1)) / each
    first = ca.if_else(inside, 0, 1 + ca.floor(steps))
    share = ca.if_else(inside, (age - 1) / (within + 1), steps - ca.floor(steps))
    one = _wrapped(index - first)
    return one, _wrapped(one - 1), share


def picked(state: ca.MX, first: int, age: ca.MX, index: ca.MX, within: ca.MX, each: ca.MX) -> ca.MX:
    """Two neighbouring yaws of the ring that begins at number ``first`` of ``state``, the share of
    the second, and what the second ring, which follows, has for the two.
    """
    one, two, share = place(age, index, within, each)
    return ca.vertcat(
        state.nz[first + one],
        state.nz[first + two],
        share,
        state.nz[first + SLOTS + one],
        state.nz[first + SLOTS + two],
    )


def between(neighbours):
    """The yaw between two by a line, and whether there was one."""
    one, two, share, _, _ = ca.vertsplit(neighbours)
    # A share of zero must not let in what is not there yet.
    there = ca.logic_and(one < NEVER, ca.logic_or(share == 0, two < NEVER))
    return one + ca.if_else(share > 0, share * wrapped(two - one), 0), there


def grown_between(neighbours):
    """Of the second ring what ``between`` gives of the first."""
    _, _, share, one, two = ca.vertsplit(neighbours)
    return one + ca.if_else(share > 0, share * (two - one), 0)
