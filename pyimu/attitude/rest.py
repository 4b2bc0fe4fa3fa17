"""The rest at the start of a recording, from which a filter levels itself and learns the turn-on
bias.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.units import STANDARD_GRAVITY

WINDOWS = (30.0, 10.0, 5.0, 2.0, 1.0, 0.5)
"""s; lengths that are tried, the longest first."""

RATE_STD = 0.02
"""rad/s; scatter of each gyro axis above which the body moves."""

FORCE_STD = 0.2
"""m/s^2; scatter of each accelerometer axis above which the body moves."""

RATE_MEAN = 0.1
"""rad/s; a mean rate above is no bias: data sheets of consumer gyros allow up to 5 deg/s."""

FORCE_OFF = 2.0
"""m/s^2; a mean force further than that from gravity in its size is not gravity's: no accelerometer
at rest is off by 0.2 g."""

DRIFT = 5.0
"""Standard deviations by which the means of a rest's two halves may differ, beside ``RATE_DRIFT``
and ``FORCE_DRIFT``."""

RATE_DRIFT = 2e-3
"""rad/s; difference of the halves' mean rates that a sensor at rest may show."""

FORCE_DRIFT = 0.03
"""m/s^2; the same of the specific force."""


@dataclass(frozen=True)
class Rest:
    """The rows of a rest and its means and scatters, (3,) rad/s and m/s^2.

    ``seen`` is False where no rest was found: the means are then those of the shortest window.
    ``declared`` says that the recording's own column ``stationary`` marks it. ``force`` is None
    where no accelerometer shows gravity.
    """

    seen: bool
    rows: slice
    duration: float
    rate: np.ndarray
    force: np.ndarray | None
    rate_std: np.ndarray
    force_std: np.ndarray
    rate_mean_std: np.ndarray
    declared: bool = False


def find_rest(recording) -> Rest:
    """The longest rest of up to 30 s that a recording starts with; where it has a column
    ``stationary``, by that.

    A steady turn about the vertical looks like a rest with a bias; only ``stationary`` tells the
    two apart.
    """
    declared = _declared(recording)
    if declared is not None and declared > 1:
        return _rest(recording, declared, seen=True, declared=True)
    for window in WINDOWS:
        stop = int(np.searchsorted(recording.time, recording.time[0] + window))
        if declared is None and stop < len(recording.time) and stop > 3 and _still(recording, stop):
            return _rest(recording, stop, seen=True)
    return _rest(recording, max(2, min(stop, len(recording.time))), seen=False)


def _declared(recording) -> int | None:
    """Number of rows that the column ``stationary`` marks at the start, at most those of the
    longest window.
    """
    marks = getattr(recording, "stationary", None)
    if marks is None:
        return None
    still = np.concatenate([np.nan_to_num(marks) > 0.5, [False]])
    return min(
        int(np.argmin(still)), int(np.searchsorted(recording.time, recording.time[0] + WINDOWS[0]))
    )


def _finite(values: np.ndarray | None, stop: int) -> np.ndarray:
    """The finite rows before ``stop``."""
    return (
        np.empty((0, 3))
        if values is None
        else values[:stop][np.isfinite(values[:stop]).all(axis=1)]
    )


def _shows_gravity(force: np.ndarray, off: float) -> bool:
    return bool(len(force)) and abs(np.linalg.norm(force.mean(axis=0)) - STANDARD_GRAVITY) < off


def _still(recording, stop: int) -> bool:
    rate, force = (_finite(v, stop) for v in (recording.gyro, recording.accel))
    if (
        not len(rate)
        or not _steady(rate, RATE_STD, RATE_DRIFT)
        or np.any(np.abs(rate.mean(axis=0)) >= RATE_MEAN)
    ):
        return False
    return (
        not len(force)
        or not np.any(force)
        or _shows_gravity(force, FORCE_OFF)
        and _steady(force, FORCE_STD, FORCE_DRIFT)
    )


def _steady(values: np.ndarray, scatter: float, drift: float) -> bool:
    """Whether each axis scatters little and its two halves agree."""
    std, half = values.std(axis=0), len(values) // 2
    change = (
        np.abs(values[:half].mean(axis=0) - values[half:].mean(axis=0)) if half else np.zeros(3)
    )
    return bool(
        np.all(std < scatter) and np.all(change < drift + DRIFT * std * 2 / np.sqrt(len(values)))
    )


def _rest(recording, stop: int, seen: bool, declared: bool = False) -> Rest:
    rate, force = (_finite(v, stop) for v in (recording.gyro, recording.accel))
    # From differences of neighbours: white noise, without the motion and drift that a mean would
    # leave in.
    rate_std, force_std = (
        np.diff(v, axis=0).std(axis=0) / np.sqrt(2) if len(v) > 2 else np.zeros(3)
        for v in (rate, force)
    )
    mean, mean_std = (
        (rate.mean(axis=0), rate.std(axis=0) / np.sqrt(len(rate)))
        if len(rate)
        else (np.zeros(3), np.zeros(3))
    )
    # In motion even a force of half gravity's size is a better direction than none.
    usable = _shows_gravity(force, FORCE_OFF if seen else STANDARD_GRAVITY / 2)
    return Rest(
        seen and len(rate) > 1,
        slice(0, stop),
        float(recording.time[stop - 1] - recording.time[0]),
        mean,
        force.mean(axis=0) if usable else None,
        rate_std,
        force_std,
        np.hypot(mean_std, 1e-6),
        declared,
    )
