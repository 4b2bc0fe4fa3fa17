"""The rest at the start of a recording, from which a filter levels itself and learns the turn-on bias."""

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

RATE_MEAN = 0.2
"""rad/s; a mean rate above is no bias."""

DRIFT = 5.0
"""Standard deviations by which the means of a rest's two halves may differ, beside ``RATE_DRIFT`` and ``FORCE_DRIFT``."""

RATE_DRIFT = 2e-3
"""rad/s; difference of the halves' mean rates that a sensor at rest may show."""

FORCE_DRIFT = 0.03
"""m/s^2; the same of the specific force."""


@dataclass(frozen=True)
class Rest:
    """The rows of a rest and its means and scatters, (3,) rad/s and m/s^2.

    ``seen`` is False where no rest was found: the means are then those of the shortest window.
    """

    seen: bool
    rows: slice
    duration: float
    rate: np.ndarray
    force: np.ndarray
    rate_std: np.ndarray
    force_std: np.ndarray
    rate_mean_std: np.ndarray


def find_rest(recording) -> Rest:
    """The longest rest of up to 30 s that a recording starts with; where it has a column ``stationary``, by that.

    A steady slow turn about the vertical looks like a rest with a bias; only ``stationary`` tells the two apart.
    """
    declared = _declared(recording)
    if declared is not None:
        return _rest(recording, max(declared, 2), seen=declared > 1)
    for window in WINDOWS:
        stop = int(np.searchsorted(recording.time, recording.time[0] + window))
        if stop < len(recording.time) and stop > 3 and _still(recording, stop):
            return _rest(recording, stop, seen=True)
    return _rest(recording, max(2, min(stop, len(recording.time))), seen=False)


def _declared(recording) -> int | None:
    """Number of rows that the column ``stationary`` marks at the start, at most those of the longest window."""
    marks = getattr(recording, "stationary", None)
    if marks is None:
        return None
    still = np.concatenate([np.nan_to_num(marks) > 0.5, [False]])
    return min(int(np.argmin(still)), int(np.searchsorted(recording.time, recording.time[0] + WINDOWS[0])))


def _finite(values: np.ndarray | None, stop: int, default: tuple[float, ...]) -> np.ndarray:
    """The finite rows before ``stop``; a row of ``default`` where there is none."""
    rows = np.empty((0, 3)) if values is None else values[:stop][np.isfinite(values[:stop]).all(axis=1)]
    return rows if len(rows) else np.array([default])


def _groups(recording, stop: int) -> tuple[np.ndarray, np.ndarray]:
    return _finite(recording.gyro, stop, (0.0, 0.0, 0.0)), _finite(recording.accel, stop, (0.0, 0.0, STANDARD_GRAVITY))


def _still(recording, stop: int) -> bool:
    rate, force = _groups(recording, stop)
    return bool(_steady(rate, RATE_STD, RATE_DRIFT) and _steady(force, FORCE_STD, FORCE_DRIFT)
                and np.all(np.abs(rate.mean(axis=0)) < RATE_MEAN))


def _steady(values: np.ndarray, scatter: float, drift: float) -> bool:
    """Whether each axis scatters little and its two halves agree."""
    std, half = values.std(axis=0), len(values) // 2
    change = np.abs(values[:half].mean(axis=0) - values[half:].mean(axis=0)) if half else np.zeros(3)
    return bool(np.all(std < scatter) and np.all(change < drift + DRIFT * std * 2 / np.sqrt(len(values))))


def _rest(recording, stop: int, seen: bool) -> Rest:
    rate, force = _groups(recording, stop)
    # From differences of neighbours: white noise, without the motion and drift that a mean would leave in.
    rate_std, force_std = (np.diff(v, axis=0).std(axis=0) / np.sqrt(2) if len(v) > 2 else np.zeros(3) for v in (rate, force))
    return Rest(seen, slice(0, stop), float(recording.time[stop - 1] - recording.time[0]), rate.mean(axis=0),
                force.mean(axis=0), rate_std, force_std, np.hypot(rate.std(axis=0) / np.sqrt(len(rate)), 1e-6))
