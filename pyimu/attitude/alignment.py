"""Alignment: initial attitude, bias and their uncertainty from a recording's first seconds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.columns import (
    extra_column,
    recorded_age,
    recorded_heading,
    temperature_of,
)
from pyimu.attitude.filter.compensation import Compensation, noise_of
from pyimu.attitude.filter.heading_update import LEVEL
from pyimu.attitude.filter.stillness import TURN_STD
from pyimu.attitude.filter.unscented import LARGEST_STD
from pyimu.attitude.filter.variables import ABSURD, EXTRA_INPUTS
from pyimu.attitude.rest import Rest
from pyimu.attitude.underway import BIAS_STD, PUSH_STD, TWICE, Underway
from pyimu.errors import UserError
from pyimu.model.part import Part
from pyimu.model.signals import SIGNALS
from pyimu.recording.recording import Recording
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import EARTH_RATE, earth_rate

TILT_STD = 0.01
"""rad; tilt of an attitude levelled at rest: an accelerometer's turn-on bias of 10 mg."""

MOVING_TILT_STD = 0.3
"""rad; tilt of an attitude levelled while moving, at most."""

YAW_STD = 1e-3
"""rad; yaw starts at the given heading."""

DEFINED_STD = 1e-5
"""rad; yaw starts where it is defined to be zero."""

REUSED = 10.0
"""Factor on the standard deviation of what the filter will take from the same rows once more: of
that information a hundredth counts twice."""


@dataclass(frozen=True)
class Yaw:
    """Yaw of the first sample and its standard deviation in rad.

    ``known`` where it is a heading, not where yaw is defined to be zero.
    """

    angle: float = 0.0
    std: float = DEFINED_STD
    known: bool = False


def initial_values(
    recording: Recording,
    part: Part,
    rest: Rest,
    latitude: float,
    q0,
    yaw: Yaw,
    unseen: np.ndarray | float = BIAS_STD,
) -> dict[str, float]:
    """Start values of the filter by parameter name: ``latitude``, ``q0``, ``bias0``, ``std0``.

    ``q0`` is the given attitude or None; ``unseen`` (3,) rad/s the standard deviation of the bias
    of a gyro that was not seen at rest. Raises UserError where ``q0`` is no attitude.
    """
    rate, force = _compensated(part, rest, recording)
    attitude = _levelled(force, yaw.angle) if q0 is None else given_attitude(q0)
    tilt_std, yaw_std = TILT_STD, YAW_STD
    if q0 is None:
        tilt_std = _tilt_std(rest, force)
        yaw_std = _yaw_std(yaw, attitude, tilt_std)
    axes = attitude.inv().as_matrix()
    attitude_std = np.sqrt(axes**2 @ np.array([tilt_std, tilt_std, yaw_std]) ** 2)
    bias, bias_std = np.zeros(3), np.broadcast_to(unseen, 3)
    if rest.seen:
        oriented, headed = force is not None or q0 is not None, yaw.known or q0 is not None
        earth = _earth(latitude, oriented, headed)
        bias, bias_std = _bias(rate, part, rest, attitude, *earth, levelled=force is not None)
    elif rest.underway is not None and force is not None:
        bias, bias_std = _bias_underway(rate, rest.underway, bias_std)
    named = {
        "q0": attitude.as_quat(scalar_first=True),
        "bias0": bias,
        "std0": np.concatenate([attitude_std, bias_std]),
    }
    pushed = 0.0
    if not rest.seen and force is not None and q0 is None:
        pushed = PUSH_STD if rest.underway is None else rest.underway.push_std
    return {
        "latitude": latitude,
        "push_std": pushed,
        **{f"{n}[{i + 1}]": float(v) for n, array in named.items() for i, v in enumerate(array)},
    }


def given_attitude(q0) -> Rotation:
    """``q0`` (4,) as an attitude.

    Raises UserError for other than four finite numbers, and for zeros alone.
    """
    try:
        numbers = np.asarray(q0, dtype=float)
    except (TypeError, ValueError):
        numbers = np.zeros(0)
    if numbers.shape != (4,) or not np.isfinite(numbers).all() or not np.linalg.norm(numbers) > 0:
        raise UserError(
            f"q0 is {str(q0)[:60]}, expected four finite numbers (w, x, y, z) that are not all zero"
        )
    return Rotation.from_quat(numbers, scalar_first=True)


# Bias


def _bias(
    rate: np.ndarray,
    part: Part,
    rest: Rest,
    attitude: Rotation,
    earth: np.ndarray,
    unknown: np.ndarray,
    levelled: bool,
) -> tuple[np.ndarray, np.ndarray]:
    """Bias (3,) of a gyro at rest and its standard deviation (3,), rad/s.

    ``earth`` (3,) is what is known of the Earth's rate in world axes, ``unknown`` (3,) the standard
    deviation of the rest. A body that turns steadily about the vertical, no faster than a bias may
    be, measures the same as one at rest and is taken for that, unless the log shows the turn
    (``even``); of one that ``sways`` the bias is unsure by such a turn. Where no gravity confirms
    that the body stays ``levelled``, the standard deviation is at least half the mean rate: a turn
    is two standard deviations away.
    """
    axes = attitude.inv().as_matrix()
    bias = rate - axes @ earth
    variance = mean_bias_std(part, rest) ** 2 + axes**2 @ unknown**2
    if rest.declared or levelled:
        up, unsure = axes[:, 2], np.hypot(rest.sways * TURN_STD, rest.even.std)
        # The zero-rate updates find the same bias in the same rows.
        return bias - rest.even.turn * up, np.hypot(REUSED * np.sqrt(variance), unsure * up)
    return bias, np.sqrt(variance + (bias / 2) ** 2)


def _bias_underway(
    rate: np.ndarray, found: Underway, unseen: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Bias (3,) of a gyro in motion, whose compensated bias is ``rate``, and its standard deviation
    (3,), rad/s. None on an axis where less is known than the standard deviation ``unseen`` (3,)
    says of a gyro that was not looked at.
    """
    std = np.hypot(TWICE * found.bias_std, EARTH_RATE)
    told = std < unseen
    return np.where(told, rate, 0.0), np.where(told, std, unseen)


def _earth(latitude: float, oriented: bool, headed: bool) -> tuple[np.ndarray, np.ndarray]:
    """The Earth's rate (3,) in world axes at the start, and its standard deviation (3,), rad/s.

    The rate is what is known of it, the standard deviation that of what is not known.

    Without a heading (not ``headed``) the direction of its horizontal part is not known.
    """
    if not (abs(latitude) <= np.pi / 2 and oriented):
        return np.zeros(3), np.full(3, EARTH_RATE)
    earth = np.array(earth_rate(ca.DM(latitude))).ravel()
    if headed:
        return earth, np.zeros(3)
    return earth * [0, 0, 1], np.array([1, 1, 0]) * np.hypot(*earth[:2])


def mean_bias_std(part: Part, rest: Rest) -> np.ndarray:
    """Standard deviation (3,) rad/s of a gyro's mean over a rest as its bias at the rest's start.

    Over T s that is the white noise, N^2/T, and what walks meanwhile, K^2 T/3, each with what
    stands for flicker and Gauss-Markov noise of the part in the filter.
    """
    noise = noise_of(part.gyro, ca.SX(ca.DM(part.gyro.p)), 1 / part.sample_rate)
    duration = max(rest.duration, 1e-9)
    white, walk = (np.array(ca.evalf(v), dtype=float).ravel() for v in (noise.white, noise.walk))
    mean_std = np.maximum(rest.rate_mean_std, white / np.sqrt(duration))
    return np.sqrt(mean_std**2 + walk**2 * duration / 3)


def _compensated(
    part: Part, rest: Rest, recording: Recording
) -> tuple[np.ndarray, np.ndarray | None]:
    """Mean rate (3,) and specific force (3,) of the rest, compensated for the part's own errors.

    They are as after a long time at rest; the force is None where it is not gravity.
    """
    force = np.array([0, 0, rest.gravity]) if rest.force is None else rest.force
    rate = rest.rate if rest.underway is None else rest.underway.bias
    rate, force = compensated_means(part, recording, rest.rows, rate, force)
    return rate, None if rest.force is None else force


def compensated_means(
    part: Part, recording: Recording, rows: slice, rate: np.ndarray, force: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The mean ``rate`` (3,) rad/s and ``force`` (3,) m/s^2 of rows of a body at rest, compensated
    for the part's own errors, as after a long time.
    """
    known = {
        "rate": rate,
        "specific_force": force,
        "temperature": _mean(temperature_of(recording, part), rows, 25.0),
    }
    for signal in EXTRA_INPUTS:
        if signal in part.signals:
            column, start = extra_column(recording, part, signal), SIGNALS[signal].start
            known[signal] = _mean(column, rows, start)
    compensation, h = Compensation(part), ca.SX(recording.sample_period)
    values = {n: ca.SX(ca.DM(v)) for n, v in known.items()} | {"latitude_known": ca.SX(0)}
    _, rate, force, *_ = compensation.apply(
        ca.SX(ca.DM(compensation.start)),
        values,
        ca.SX(ca.DM(part.gyro.p)),
        ca.SX(ca.DM(part.accel.p)),
        h,
    )
    rate, force = (np.array(ca.evalf(v), dtype=float).ravel() for v in (rate, force))
    return rate, force


def _mean(column, rows: slice, otherwise) -> np.ndarray:
    """Mean of a signal (n, ...) over the rows, ``otherwise`` where it is missing there.

    A constant stays as it is.
    """
    if np.ndim(column) == 0:
        return np.atleast_1d(column)
    known = column[rows]
    known = known[np.isfinite(known).reshape(len(known), -1).all(axis=1)]
    return np.atleast_1d(known.mean(axis=0) if len(known) else otherwise)


# Attitude


@dataclass(frozen=True)
class MagneticNorth:
    """The ``declination`` in rad and the ``std`` in T of a field across the magnetic north.

    ``parts`` (2,) T are the horizontal and the upward part of the place's field where it is known.
    """

    declination: float
    std: float
    parts: np.ndarray | None = None

    def across(self, level: float, up: float) -> float:
        """T; the standard deviation where these are seen.

        A disturbance has any direction: across it has as much as in either part.
        """
        if self.parts is None:
            return self.std
        off = np.linalg.norm(self.parts - [level, up]) / np.sqrt(2)
        return float(np.hypot(self.std, off))


def initial_yaw(
    recording: Recording,
    rest: Rest,
    heading0: float | None,
    turned: Callable[[int], float],
    north: MagneticNorth | None = None,
) -> Yaw:
    """The yaw to start with.

    It is ``heading0`` in rad, else by the first recorded heading, else by the magnetometer where
    the magnetic ``north`` is given, else zero.

    A heading during the rest, or of the first sample, is that of the start. Before a later one the
    body has turned by ``turned(row)`` rad, as the gyro measures: the filter starts so that this
    heading will hardly contradict it, and with a yaw that is not known until then.
    """
    if heading0 is not None:
        return Yaw(heading0, YAW_STD, known=True)
    heading, std = recorded_heading(recording)
    rows = np.flatnonzero((np.abs(heading) <= ABSURD) & (np.abs(std) <= ABSURD) & (std != 0))
    if not len(rows):
        return Yaw() if north is None else _magnetic_yaw(recording, rest, north)
    seen = float(heading[rows[0]])
    true_at = recording.time[rows[0]] - recorded_age(recording)[rows[0]]
    first = int(np.searchsorted(recording.time, true_at))
    if first == 0 or rest.seen and first < rest.rows.stop:
        return Yaw(seen, REUSED * max(float(std[rows[0]]), YAW_STD), known=True)
    return Yaw(seen - turned(first), LARGEST_STD)


def _magnetic_yaw(recording: Recording, rest: Rest, north: MagneticNorth) -> Yaw:
    """The yaw at which the mean field of the rest, levelled, points to the magnetic north.

    The filter takes the same samples again.
    """
    rows = recording.mag[rest.rows]
    rows = rows[np.isfinite(rows).all(axis=1) & np.any(rows != 0, axis=1)]
    if not len(rows):
        return Yaw(0.0, LARGEST_STD)
    east, ahead, up = _levelled(rest.force, 0.0).apply(rows.mean(axis=0))
    level = max(float(np.hypot(east, ahead)), 1e-12)
    angle = np.pi / 2 - north.declination - np.arctan2(ahead, east)
    tilt_std = _tilt_std(rest, rest.force)
    std = np.hypot(north.across(level, up), tilt_std * up) / level
    return Yaw(float(angle), min(REUSED * max(std, YAW_STD), LARGEST_STD), known=True)


def _tilt_std(rest: Rest, force: np.ndarray | None) -> float:
    """Standard deviation of the tilt of an attitude levelled by ``force``, rad."""
    if force is None:
        return LARGEST_STD
    if rest.seen:
        return TILT_STD
    most = MOVING_TILT_STD
    return most if rest.underway is None else min(TWICE * rest.underway.tilt_std, most)


def _yaw_std(yaw: Yaw, attitude: Rotation, tilt_std: float) -> float:
    """Standard deviation of the attitude about the vertical, rad.

    A tilt error p turns the heading of a pitched body by p tan(pitch), and to second order it has a
    part about the vertical. Where the forward axis points up or down it has no heading, and the
    filter uses none.
    """
    std = np.hypot(yaw.std, tilt_std**2 / 2)
    if yaw.known:
        east, north, up = attitude.apply([1, 0, 0])
        level = np.hypot(east, north)
        std = np.hypot(std, tilt_std * up / level) if level > LEVEL else LARGEST_STD
    return float(min(std, LARGEST_STD))


def _levelled(force: np.ndarray | None, yaw: float) -> Rotation:
    """The attitude at ``yaw`` rad in which ``force`` (3,) points up; level without a force."""
    roll, pitch = (0.0, 0.0) if force is None else tilt_of(force)
    q = quaternion.from_euler(ca.DM(roll), ca.DM(pitch), ca.DM(yaw))
    return Rotation.from_quat(np.array(q).ravel(), scalar_first=True)


def tilt_of(force: np.ndarray) -> tuple[float, float]:
    """Roll and pitch [rad] of a body whose ``force`` (3,) points up, by Groves 2013, eqs. 5.101."""
    x, y, z = force
    return float(np.arctan2(y, z)), float(np.arctan2(-x, np.hypot(y, z)))
