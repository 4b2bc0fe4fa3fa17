"""Whether gravity turns in the body as the gyro says: its unit, its axes, their signs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.special import stdtr

from pyimu.errors import Finding
from pyimu.recording.guess.gravity_turning import turning_of_gravity
from pyimu.recording.guess.numbers import SENSITIVITIES
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.quality.resolution import comb_step
from pyimu.recording.quality.vehicle_turns import speed_in_turns
from pyimu.recording.readings import BY_CHANCE, READINGS, changed, likely, named
from pyimu.recording.recording import Recording
from pyimu.recording.turning import carried, turning_spans
from pyimu.units import STANDARD_GRAVITY

DEGREE = 180 / np.pi

UNITS = (1.0, DEGREE, 1 / DEGREE)
"""By how much the numbers of a gyro may be too large: as stated, degrees a second under a header of
radians, and the other way round."""

LIKE = 2.0
"""A factor is that of a unit to this one."""

SIZE_OFF = 0.5
"""m/s^2; by which gravity has another size by an accelerometer that nobody calibrated (50 mg)."""

LEANS = np.pi / 6
"""rad; gravity turns so far in a body that is turned. The forces of one that only speeds up and
brakes, and pitches a little by it, turn less, and as rates do that are far too small."""

TWICE_TURNED = tuple(float(np.radians(np.radians(1 / lsb))) for lsb in SENSITIVITIES)
"""rad/s; one count of known gyros whose size in rad/s was taken for deg/s."""

SAME_STEP = 3e-4
"""Relative difference of two steps that are one: of other steps of their size three in a thousand
are so near to one of those."""

STEPS_SEEN = 100_000
"""Rows that are looked at for it."""

FASTEST, FASTER = 150.0, 1500.0
"""m/s; no vehicle on the ground is as fast as the first, which is 57 times 2.6 m/s. Beyond the
second a gyro may show what a force does to it: 0.3 deg/s/g looks like 1,900 m/s."""

CHANGES = np.concatenate([READINGS, [np.eye(3) / unit for unit in UNITS[1:]]])
"""(50, 3, 3), times the stated rates those of a reading."""

COSTS = np.array([*map(changed, READINGS), 0.5, 0.5])
"""Of each: another unit is likelier than axes in disorder."""


def gyro_findings(recording: Recording) -> tuple[Finding, ...]:
    """What gravity, or else a reference, says against the gyro: ``gyro_unit`` or ``gyro_axes``.

    ``gyro_unit`` has the ``factor`` by which its rates are too large, ``gyro_axes`` the ``axes`` as
    they would be right. Gravity tells where the forces, turned back by the gyro to where they were
    at the start of a span, are clearly nearer to one gravity than as they are: it hardly does so of
    a vehicle, and not of a body that stays level. There a reference attitude or rate still tells
    the unit, and else the turning of the forces from moment to moment.
    """
    if recording.gyro is None:
        return ()
    reading = None if recording.accel is None else _by_gravity(recording)
    factor = _factor(recording, reading)
    found = _axes(recording, reading)
    if factor != 1:
        found = (Finding("gyro_unit", "gyro", len(recording), {"factor": factor}), *found)
    return found


def gyro_axes(recording: Recording) -> tuple[Finding, ...]:
    """``gyro_axes`` alone, of what ``gyro_findings`` gives."""
    if recording.gyro is None or recording.accel is None:
        return ()
    return _axes(recording, _by_gravity(recording))


def _axes(recording: Recording, reading: int | None) -> tuple[Finding, ...]:
    if reading is None or not 0 < reading < len(READINGS):
        return ()
    return (Finding("gyro_axes", "gyro", len(recording), {"axes": named(READINGS[reading])}),)


def _factor(recording: Recording, reading: int | None) -> float:
    """Which of ``UNITS`` the rates are too large by, where gravity says the ``reading``.

    The stated one it may say only because no other is clearly better.
    """
    known = _factor_by_reference(recording) if reading is None else None
    if known is not None:
        return known
    if reading is not None and reading >= len(READINGS):
        factor = UNITS[reading - len(READINGS) + 1]
    else:
        factor = 1.0 if reading else _factor_by_turning(recording)
    if factor < 1 and not _leans(recording.accel):
        factor = 1.0
    if factor != 1 or reading:
        return factor
    small = _goes_too_fast(recording) or _has_a_step_in_radians(recording.gyro)
    return 1 / DEGREE if small else 1.0


def _by_gravity(recording: Recording) -> int | None:
    """Which of ``CHANGES`` gravity says, None where it says nothing.

    A force of another size than gravity's is in another unit, or has none in it, and tells nothing.
    """
    turns, force = turning_spans(_within_range(recording), recording.accel)
    if not len(turns):
        return None
    size = float(np.median(np.linalg.norm(force, axis=2)))
    if not 1 / LIKE < size / STANDARD_GRAVITY < LIKE:
        return None
    halves = _in_halves(force)
    without = _off_gravity(halves.sum(axis=1) / _rows(force.shape[1]))
    return next(iter(likely(_off_by_reading(turns, halves), without, COSTS)), None)


def _within_range(recording: Recording) -> Recording:
    """The recording without the rates at a limit of the gyro: how far it turned there is unknown,
    and axes or units by which it turns less, or more, would fit better.
    """
    at_limit = np.column_stack([clipped(column) for column in recording.gyro.T])
    return replace(recording, gyro=np.where(at_limit, np.nan, recording.gyro))


def _rows(count: int) -> np.ndarray:
    """How many (2, 1) of the steps of a span lie in either half of it."""
    return np.array([[count // 2], [count - count // 2]])


def _in_halves(force: np.ndarray) -> np.ndarray:
    """The forces (m, k, 3) as (m, k, 2, 3), either half of a span with zeros in the other."""
    first = np.arange(force.shape[1]) < force.shape[1] // 2
    return force[:, :, None] * np.stack([first, ~first], axis=1)[None, :, :, None]


def _off_by_reading(turns: np.ndarray, halves: np.ndarray) -> np.ndarray:
    """How far (c, m) the halves' mean forces carried along by each of the ``CHANGES`` are off."""
    (m, k, _), c = turns.shape, len(CHANGES)
    each = np.einsum("cij,mkj->kcmi", CHANGES, turns).reshape(k, c * m, 3)
    same = np.broadcast_to(halves.transpose(1, 0, 3, 2)[:, None], (k, c, m, 3, 2))
    _, sums = carried(each, same.reshape(k, c * m, 3, 2), np.full(c * m, k))
    return _off_gravity(sums.transpose(0, 2, 1).reshape(c, m, 2, 3) / _rows(k))


def _off_gravity(means: np.ndarray) -> np.ndarray:
    """Squared distance (...) of the mean forces (..., 2, 3) of the halves of spans from one vector
    of gravity's size.

    What a body is pushed averages out, as its velocity stays bounded, and is left out so. A mean
    beyond gravity would be a speed that comes up in every span: a foot swings forwards when its
    toes go down, and carried along by the rates of a mirrored pitch its forces scatter less than by
    the true ones, about a mean that is too large.
    """
    both = means.mean(axis=-2)
    apart = np.sum((means[..., 0, :] - both) ** 2, axis=-1)
    off = np.abs(np.linalg.norm(both, axis=-1) - STANDARD_GRAVITY)
    return apart + np.maximum(off - SIZE_OFF, 0) ** 2


# From moment to moment


def _factor_by_turning(recording: Recording) -> float:
    """Which of ``UNITS`` the rates are too large by, as the change of the forces goes with them.

    It goes so in many short moments of a log in which few spans hold as many pushes to as fro; of
    axes, and of a factor that is no unit's, it says nothing. 1 where it does not go with them.
    """
    if recording.accel is None:
        return 1.0
    rate, force = _within_range(recording).gyro, recording.accel
    size = np.linalg.norm(force, axis=1)
    middle = np.nanmedian(size) if np.isfinite(size).any() else 0.0
    if not 1 / LIKE < middle / STANDARD_GRAVITY < LIKE:
        return 1.0
    slope = turning_of_gravity(rate, force, recording.sample_period)
    if slope is None or not slope > 0:
        return 1.0
    return next((u for u in UNITS if 1 / LIKE < 1 / slope / u < LIKE), 1.0)


def _goes_too_fast(recording: Recording) -> bool:
    """Whether the force in a vehicle's turns is that of one 57 times as fast, as where its rates
    are too small.
    """
    if recording.accel is None or _leans(recording.accel):
        return False
    rate = _within_range(recording).gyro
    slope = turning_of_gravity(rate, recording.accel, recording.sample_period)
    if slope is not None and 1 / LIKE < slope < LIKE:
        return False  # a ship that heels in its turns: gravity agrees with the header
    speed = speed_in_turns(rate, recording.accel, recording.sample_period)
    return speed is not None and FASTEST < speed < FASTER


def _has_a_step_in_radians(gyro: np.ndarray) -> bool:
    """Whether the rates rad/s (n, 3) lie on multiples of a gyro's count twice turned from degrees
    to radians: its numbers in rad/s were called deg/s. At rest nothing else tells it.
    """
    for column in gyro[:STEPS_SEEN].T:
        step = comb_step(column)
        if step is None or not any(abs(step / own - 1) < SAME_STEP for own in TWICE_TURNED):
            return False
    return True


def _leans(force: np.ndarray) -> bool:
    """Whether one in twenty of the forces (n, 3) is ``LEANS`` off the direction of their mean."""
    known = force[np.isfinite(force).all(axis=1)]
    mean, size = known.mean(axis=0), np.linalg.norm(known, axis=1)
    along = known @ mean / np.maximum(size * np.linalg.norm(mean), 1e-9)
    return bool(np.quantile(along, 0.05) < np.cos(LEANS))


# By a reference


WINDOW = 0.2
"""s; over which the sizes of the turns of gyro and reference are compared."""


def _factor_by_reference(recording: Recording) -> float | None:
    """Which of ``UNITS`` the turns of ``ref_q`` or ``ref_rate`` say the rates are too large by.

    It is by their size alone, which is the same in all axes. None where they say nothing.
    """
    turns = _reference_turns(recording)
    if turns is None:
        return None
    ours, theirs = turns
    known = np.isfinite(ours) & np.isfinite(theirs)
    x, y = theirs[known], ours[known]
    if len(x) < 3 or not (x.std() > 0 and y.std() > 0):
        return None
    correlation = float(np.corrcoef(x, y)[0, 1])
    t = correlation * np.sqrt((len(x) - 2) / max(1 - correlation**2, 1e-12))
    if stdtr(len(x) - 2, t) < 1 - BY_CHANCE:
        return None
    # Both have errors: the slope of the one on the other is too flat, that of their spreads not.
    factor = float(y.std() / x.std())
    return next((u for u in UNITS if 1 / LIKE < factor / u < LIKE), None)


def _reference_turns(recording: Recording) -> tuple[np.ndarray, np.ndarray] | None:
    """Sizes (m,) rad of the turns in each window by the gyro and by the reference."""
    rows = max(round(WINDOW / recording.sample_period), 1)
    at = np.arange(0, len(recording), rows)
    if recording.ref_q is None and recording.ref_rate is None or len(at) < 4:
        return None
    seconds = rows * recording.sample_period
    ours = np.linalg.norm(np.add.reduceat(recording.gyro, at[:-1])[:-1], axis=1) / rows * seconds
    if recording.ref_rate is not None:
        rate = np.add.reduceat(recording.ref_rate, at[:-1])[:-1]
        return ours, np.linalg.norm(rate, axis=1) / rows * seconds
    q = recording.ref_q[at[:-1]]
    q = q / np.linalg.norm(q, axis=1, keepdims=True)
    cosine = np.abs(np.sum(q[1:] * q[:-1], axis=1))
    return ours, 2 * np.arccos(np.minimum(cosine, 1.0))
