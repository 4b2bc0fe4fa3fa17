"""Two rings that let a heading correct the attitude of the past, to which it belongs.

The first ring keeps the yaw of past samples less what headings have corrected since the start: with
the present correction added, it is the yaw that the filter now believes the body had then. The
second ring keeps the variance that the gyro's noise and losses have added about the vertical since
the start: its difference to the present is what they have added since that sample.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

SLOTS = 64
"""Entries of a ring; SLOTS - 1 spans between them cover ``heading_memory``, and a span is at least
one sample."""

NEVER = 1e9
"""An entry without a yaw: before the first sample, or of a body that pointed up or down. As a place
within a span it is past the end, so that the first sample starts the first slot."""

ROUNDING = 1e-6
"""Samples by which a span may exceed a whole number and still counts as that."""


def empty():
    """Both rings (2 ``SLOTS``,) before the first sample."""
    return ca.vertcat(NEVER * ca.SX.ones(SLOTS), ca.SX.zeros(SLOTS))


def samples_per_slot(memory, h):
    """Samples from one kept yaw to the next, a whole number, for a ``memory`` in s."""
    return ca.fmax(1, ca.ceil(memory / ((SLOTS - 1) * h) - ROUNDING))


def following(index, within, memory, h):
    """Slot and place within its span of the sample that follows ``within`` of slot ``index``.

    A slot keeps the last sample of its span. When a span is full is decided as in
    ``samples_per_slot``, but without rounding up.
    """
    full = (within + 1 + ROUNDING) * ((SLOTS - 1) * h) >= memory
    index = index + full
    return index - SLOTS * (index >= SLOTS), (1 - full) * (within + 1)


def wrapped(angle):
    """``angle`` in rad brought to within half a turn; it may exceed that by a few turns."""
    return angle - 2 * np.pi * ca.floor(angle / (2 * np.pi) + 0.5)


def oldest(each):
    """Age in samples up to which a yaw is always had, wherever the newest slot is filled to.

    ``each`` is the number of samples per slot.
    """
    return (SLOTS - 1) * each


def neighbours(
    state: ca.MX, first: int, age: ca.MX, index: ca.MX, within: ca.MX, each: ca.MX
) -> ca.MX:
    """The entries on either side of the sample that is ``age`` samples old, as a column (5,).

    Two yaws, the share of the second, and the two entries of the second ring.

    The first ring begins at number ``first`` of ``state``, the second follows it. ``index``,
    ``within`` and ``each`` are as for ``_between_slots``.
    """
    one, two, share = _between_slots(age, index, within, each)
    return ca.vertcat(
        state.nz[first + one],
        state.nz[first + two],
        share,
        state.nz[first + SLOTS + one],
        state.nz[first + SLOTS + two],
    )


def _between_slots(age, index, within, each):
    """The two slots on either side of the sample that is ``age`` >= 1 samples old.

    Also how far it lies towards the second.

    Slot ``index`` is one sample old and holds sample ``within`` of its span of ``each`` samples.
    """
    within = ca.fmin(within, each - 1)
    inside = age - 1 < within + 1
    steps = (age - 1 - (within + 1)) / each
    first = ca.if_else(inside, 0, 1 + ca.floor(steps))
    share = ca.if_else(inside, (age - 1) / (within + 1), steps - ca.floor(steps))
    one = _in_ring(index - first)
    return one, _in_ring(one - 1), share


def _in_ring(index):
    return index + SLOTS * (index < 0)


def past_yaw(neighbours):
    """The yaw on a line between two entries of the first ring, and whether both have one."""
    one, two, share, _, _ = ca.vertsplit(neighbours)
    # A share of zero must not let in what is not there yet.
    there = ca.logic_and(one < NEVER, ca.logic_or(share == 0, two < NEVER))
    return one + ca.if_else(share > 0, share * wrapped(two - one), 0), there


def past_noise(neighbours):
    """The variance on the same line between two entries of the second ring."""
    _, _, share, one, two = ca.vertsplit(neighbours)
    return one + ca.if_else(share > 0, share * (two - one), 0)
