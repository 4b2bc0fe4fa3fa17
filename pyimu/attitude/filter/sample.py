"""One row of the inputs: the sensors' errors undone, and which numbers of it can be trusted.

Nearly every row is ordinary: all numbers are finite, inside the sensors' ranges, and not the same
for too long, and no speed is known. One comparison for all of them together finds that out, so that
only the few other rows take the time of being looked at number by number. One row of each turn of
the rings (``pyimu.attitude.filter.late_heading``) is no ordinary one, so that what fades in memory
is looked at long before it is a denormal number.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.memory import HOLD, Memory
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.tolerances import TURN_TIME
from pyimu.attitude.filter.variables import ABSURD, INPUTS, MAG
from pyimu.model.signals import SIGNALS

LARGEST_KEPT = 1e100
"""Largest sum of squares of the sensors' memory; beyond, that memory begins anew."""

GYRO, ACCEL = slice(0, 3), slice(3, 6)
"""Where a measured column has the two triads."""

AXES = slice(2, 8)
"""Where ``Memory.same_for`` has the six axes."""


@dataclass(frozen=True)
class Sample:
    """A row without the sensors' own errors.

    ``held`` is what was measured, in place of a bad number its last good one; ``rate`` (3,) rad/s
    and ``force`` (3,) m/s^2 are compensated. ``sensors`` is the compensation's memory after the
    row, ``same_for`` (8,) and ``lost_for`` (3,) are those of ``Memory``. ``gyro_lost`` (3,) marks
    the axes without a rate, ``force_valid`` whether the force can be used. ``driven`` says that
    the velocity of the body is that of a speed. ``missing``, ``at_limit`` and ``stuck`` make the
    status. With a row that is looked at closely, what has ``faded`` from memory becomes zero.
    What is known beforehand of an ordinary row is a Python value, and costs nothing in the
    generated code.
    """

    held: ca.SX
    rate: ca.SX
    force: ca.SX
    sensors: ca.SX
    same_for: ca.SX
    lost_for: ca.SX
    gyro_lost: ca.SX | bool = False
    force_valid: ca.SX | bool = True
    driven: ca.SX | bool = False
    faded: bool = True
    missing: ca.SX | float = 0
    at_limit: ca.SX | float = 0
    stuck: ca.SX | float = 0


def raw_of(compensation: Compensation, u):
    """What is measured: gyro (3), accel (3), temperature, and further signals of the part."""
    at = len(INPUTS)
    extra = []
    for name in compensation.extra:
        if name == "mag":
            extra.append(u[MAG])
        else:
            extra.append(u[at : at + SIGNALS[name].size])
            at += SIGNALS[name].size
    return ca.vertcat(u[:7], *extra)


def read(
    compensation: Compensation, memory: Memory, u, settings: Settings, h
) -> tuple[Sample, ca.SX]:
    """The sample as if it were ordinary, and whether it is."""
    raw = raw_of(compensation, u)
    sensors, rate, force, gyro_lost, accel_lost = _compensated(
        compensation, memory, raw, settings, h
    )
    same_for = _same_for([raw[i] == memory.held[i] for i in range(6)], memory, h)
    lost = ca.sum1(gyro_lost) + ca.sum1(accel_lost)
    ordinary = (
        (ca.sumsqr(raw) <= ABSURD**2)
        * (ca.sumsqr(rate) <= _fastest(h) ** 2)
        * (ca.sumsqr(force) <= ABSURD**2)
        * (1 - _may_be_stuck(memory, settings, h))
        * (1 - _before_the_first(raw, memory))
        * (memory.speed_for >= HOLD)
        * (ca.sum1(memory.place) > 0)
    )
    if compensation.start:
        ordinary = ordinary * (ca.sumsqr(sensors) <= LARGEST_KEPT)
    if not lost.is_zero():
        ordinary = ordinary * (lost <= 0)
    return Sample(raw, rate, force, sensors, same_for, ca.SX.zeros(3), faded=False), ordinary


def look_closely(compensation: Compensation, memory: Memory, u, settings: Settings, h) -> Sample:
    """The sample, checked number by number.

    The last good value replaces what is not finite, and what is lost is marked.
    """
    raw = raw_of(compensation, u)
    good = ca.fabs(raw) <= ABSURD
    held = ca.if_else(good, raw, memory.held)
    sensors, rate, force, gyro_lost, accel_lost = _compensated(
        compensation, memory, held, settings, h
    )
    # Errors that cannot be undone, of absurd coefficients or at an absurd input, must not get into
    # what is kept.
    rate_good, force_good = ca.fabs(rate) <= ABSURD, ca.fabs(force) <= ABSURD
    rate, force = ca.if_else(rate_good, rate, 0), ca.if_else(force_good, force, 0)
    if compensation.start:
        sensors = ca.if_else(ca.fabs(sensors) <= LARGEST_KEPT, sensors, ca.DM(compensation.start))
    # A missing sample counts as another, although its last good value is held.
    same_for = _same_for([good[i] * (held[i] == memory.held[i]) for i in range(6)], memory, h)
    stuck = _stuck(same_for, settings)
    fastest = _fastest(h)
    beyond = ca.fabs(rate) > fastest
    lost = _any_of(
        ca.logic_not(good[GYRO]), stuck[GYRO], ca.logic_not(rate_good), gyro_lost > 0.5, beyond
    )
    unusable = _any_of(
        ca.logic_not(good[ACCEL]), stuck[ACCEL], ca.logic_not(force_good), accel_lost > 0.5
    )
    # An axis that is found to be stuck has been lost since then.
    since = ca.if_else(stuck[GYRO], ca.fmax(same_for[0], same_for[AXES][GYRO]), 0)
    at_limit = ca.fmax(ca.mmax(gyro_lost), ca.mmax(accel_lost)) > 0.5
    return Sample(
        held,
        ca.fmin(ca.fmax(rate, -fastest), fastest),
        force,
        sensors,
        same_for,
        lost_for=ca.if_else(lost, ca.fmax(memory.lost_for + h, since), 0),
        gyro_lost=lost,
        force_valid=ca.logic_not(ca.logic_or(ca.mmax(unusable), _before_the_first(raw, memory))),
        driven=memory.speed_for < HOLD,
        missing=ca.logic_not(ca.mmin(good)),
        at_limit=ca.logic_or(at_limit, ca.mmax(beyond)),
        stuck=ca.mmax(stuck),
    )


def unknown_turn(before, after):
    """Growth in s^2 of the square of an angle over that of the rate, which nobody knows, about an
    axis that has been lost for ``before`` s, and for ``after`` with the sample.

    For ``TURN_TIME`` it is one number, and the angle grows with the time T. A body that turns to
    and fro has its variance 2 T TURN_TIME later on.
    """
    once, twice = (ca.fmin(t, TURN_TIME) for t in (before, after))
    return twice**2 - once**2 + 2 * TURN_TIME * (after - twice - (before - once))


def _before_the_first(raw, memory: Memory):
    """Whether an accelerometer shows exactly zero and no force has been seen yet.

    That is no sample: a unit in a simulation may show zeros before its first one.
    """
    return (ca.sumsqr(raw[ACCEL]) <= 0) * (memory.mean.span <= 0)


def _fastest(h):
    """Half a turn about an axis within a sample, rad/s; a faster body may have turned anyhow."""
    return ca.pi / h


def _any_of(*flags):
    out = flags[0]
    for flag in flags[1:]:
        out = ca.logic_or(out, flag)
    return out


def _compensated(compensation: Compensation, memory: Memory, raw, settings: Settings, h):
    """``Compensation.apply`` on a measured column, with what the filter itself knows."""
    known = {
        "rate": raw[GYRO],
        "specific_force": raw[ACCEL],
        "temperature": raw[6],
        "attitude": memory.estimate.q,
        "latitude": settings.latitude,
        "latitude_known": settings.known,
    }
    row = 7
    for name in compensation.extra:
        known[name] = raw[row : row + SIGNALS[name].size]
        row += SIGNALS[name].size
    return compensation.apply(memory.sensors, known, settings.gyro_p, settings.accel_p, h)


def _same_for(same: list, memory: Memory, h):
    """How long (8,) s gyro, accelerometer and their six axes have repeated their samples.

    ``same`` (6) says which axes repeat now. Where the whole triad does, as in a log with more rows
    than the sensor has samples, nothing is learnt of its axes.
    """
    triads, axes = [], []
    for i, triad in enumerate((GYRO, ACCEL)):
        every = same[triad][0] * same[triad][1] * same[triad][2]
        triads.append((memory.same_for[i] + h) * every)
        own = h * (1 - every)
        axes += [
            (before + own) * now
            for before, now in zip(
                ca.vertsplit(memory.same_for[AXES][triad]), same[triad], strict=True
            )
        ]
    return ca.vertcat(*triads, *axes)


def _stuck_times(settings: Settings):
    """The settings (8,) s for gyro, accelerometer and their six axes."""
    longest = settings.scalar["stuck_time"]
    axes = [settings.scalar[f"axis_stuck_time[{i + 1}]"] for i in range(6)]
    return ca.vertcat(longest, longest, *axes)


def _beyond(same_for, settings: Settings):
    """Which (8,) have repeated their samples for the settings' time, or have none."""
    return same_for >= _stuck_times(settings)


def _may_be_stuck(memory: Memory, settings: Settings, h):
    """Whether a triad or an axis is stuck, 0 or 1, if this sample repeats the last one.

    What repeats is looked at again where that is so.
    """
    times = _stuck_times(settings)
    least = ca.if_else(times > 0, times - h, ca.inf)
    return ca.sum1(memory.same_for >= least) > 0


def _stuck(same_for, settings: Settings):
    """Which (6,) axes are stuck, by themselves or as part of a triad."""
    stuck = ca.logic_and(_beyond(same_for, settings), _stuck_times(settings) > 0)
    return ca.logic_or(stuck[AXES], ca.vertcat(*[stuck[0]] * 3, *[stuck[1]] * 3))
