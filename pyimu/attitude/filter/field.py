"""What the run learns of the magnetic field: its memory, its start, and what a sample shows of it.

Seen through the estimated attitude the field has a horizontal and an upward part. Both depend on
the tilt alone, and not on the yaw: what they are in a place the run learns, and where they differ
from that the field is disturbed. The disturbance is a vector of any direction, so that what is seen
of it in these two parts it also has in the third, which turns the heading.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.variables import ABSURD
from pyimu.symbolic.linear import pack, unpack

PARTS = 2
"""Parts of the field's direction beside the magnetic north: what changes as the body turns, what
lasts."""

DELAY = 0.01
"""s; standard deviation of a magnetometer's delay behind the gyro before the run shows it: half a
period of one at 50 Hz."""

FIELD = 42
"""Numbers of a ``Field``."""

ATTITUDES = 60.0
"""Attitudes, each a turn of ``field_learning.TURN`` from the last, over which strength and dip are
averaged."""

TINY = 1e-30
"""Keeps divisors from zero."""


@dataclass(frozen=True)
class Field:
    """The magnetic field as the run has shown it.

    ``known`` (2,) T is its horizontal and its upward part, the mean over so many attitudes
    (``learnt``; below zero before the first sample: so many stand for what is known of the
    place). ``smooth`` (2,) T is that of now without noise, ``scatter`` T^2 the mean square of
    what each of its numbers is off, ``beside`` rad the heading's innovation without noise. ``late``
    (2,) is the magnetometer's delay in s and its information in 1/s^2. ``other`` (2,) T is the
    field of a disturbance, which has lasted for ``other_for`` s; the known one has been seen for
    ``known_for`` s. ``bent`` rad^2 is the variance by which its direction may be off here for good,
    beside that of every place: another one was seen, or it contradicted the heading. ``turned``
    (2,) rad are the estimated ``PARTS`` of the angle from the magnetic north to the field's
    direction, ``covariance`` (2, 2) their own, ``shared`` (9, 2) that with the error of the
    estimate. ``held`` (3,) T is the last sample, ``since`` s the time since it came. ``off`` says
    whether the last one was disturbed.
    """

    known: ca.SX
    learnt: ca.SX
    smooth: ca.SX
    scatter: ca.SX
    beside: ca.SX
    late: ca.SX
    other: ca.SX
    other_for: ca.SX
    known_for: ca.SX
    bent: ca.SX
    turned: ca.SX
    covariance: ca.SX
    shared: ca.SX
    held: ca.SX
    since: ca.SX
    off: ca.SX

    def pack(self) -> ca.SX:
        """The memory as a column (42,)."""
        flat = {"covariance": pack(self.covariance), "shared": ca.vec(self.shared)}
        return ca.densify(ca.vertcat(*(vars(self) | flat).values()))

    @classmethod
    def unpack(cls, column) -> Field:
        ends = [0, 2, 3, 5, 6, 7, 9, 11, 12, 13, 14, 16, 19, 37, 40, 41, FIELD]
        parts = dict(zip(cls.__dataclass_fields__, ca.vertsplit(column, ends), strict=True))
        covariance, shared = unpack(parts["covariance"], PARTS), parts["shared"]
        matrices = {"covariance": covariance, "shared": ca.reshape(shared, 9, PARTS)}
        return cls(**(parts | matrices))

    @classmethod
    def start(cls, at: dict) -> Field:
        """Before the first sample, with the parameters by name."""
        two, one = ca.SX.zeros(2), ca.SX.zeros(1)
        known, learnt = of_the_place(at)
        return cls(
            known=known,
            learnt=-learnt,
            smooth=two,
            scatter=at["field_turning_std"] ** 2,
            beside=one,
            late=ca.vertcat(0, 1 / DELAY**2),
            other=two,
            other_for=one,
            known_for=one,
            bent=one,
            turned=two,
            covariance=ca.SX.zeros(PARTS, PARTS),
            shared=ca.SX.zeros(9, PARTS),
            held=ca.SX.zeros(3),
            since=one,
            off=one,
        )


def of_the_place(at: dict) -> tuple[ca.SX, ca.SX]:
    """Horizontal and upward part (2,) T of a field that is known beforehand, zeros without one, and
    how many attitudes of samples tell as much.

    A mean over n attitudes is off by the n-th part of the variance of what turns with the body.
    """
    told, dip = at["field_strength"] > 0, at["field_dip"]
    parts = at["field_strength"] * ca.vertcat(ca.cos(dip), -ca.sin(dip))
    variance = ca.fmax(at["field_strength_std"] ** 2, TINY)
    looks = ca.fmin(ca.fmax(at["field_turning_std"] ** 2, TINY) / variance, ATTITUDES)
    return told * parts, told * looks


def is_magnetometer(mag, settings):
    """Whether ``mag`` (3,) T is a sample of a magnetometer that is to be used, 0 or 1."""
    size = ca.sumsqr(mag)
    return (size > 0) * (size <= ABSURD**2) * (settings.scalar["field_tolerance"] > 0)
