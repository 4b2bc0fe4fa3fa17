"""References that are the output of the sensor itself: its columns twice, rounded once more, or
calibrated.

Two instruments have nothing in common but the motion. That what one shows at its highest
frequencies follows from the other, noise and all, to less than any sensor's noise, shows that they
are one. Vibration is in both of two instruments, too, but there each has its own noise beside it.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pyimu.identification.fit.sample_noise import THIRD
from pyimu.recording.recording import Recording
from pyimu.report.findings import SENSORS

REFERENCE = {"gyro": "ref_rate", "accel": "ref_force"}
"""The measured reference of each sensor."""

LEAST = {"gyro": 5e-7, "accel": 1e-6}
"""rad/sqrt(s) and m/s^2*sqrt(s), two-sided: 0.0017 deg/sqrt(h) and 0.1 ug/sqrt(Hz), the noise of
ring lasers and of servo accelerometers; no sensor beside another shows less."""

EXPLAINED = 0.1
"""Part of the noise that may be left of it where the reference is linear in the sensor's samples:
what is less is arithmetic's."""

LAGS = 2
"""Samples to either side of which a reference may be made."""

WHITE = -0.5
"""Correlation of a third difference with the next below which it is of noise, for white noise
-0.75; a smooth motion's is near 1, and tells nothing."""

SELDOM = 0.1
"""Part of its standard deviation below which the median of a third difference is that of jumps in a
signal without noise; of noise it is 0.67."""

WINDOWS, SHARE, LENGTH = 64, 4, 32
"""Windows of so many samples that there must be, of which one in ``SHARE`` is looked at: the
quietest."""

WITHIN, ROUNDED = 1.05, 0.99
"""Halves of a step by which rounded values are off at most, and share of the rows that must be so
(a logger loses some). Of two instruments of which the one is rounded, and the other has a tenth of
the step as noise, a twentieth of the rows is farther off."""

SAME = 1e-9
"""Share of the largest value of a reference below which two values of it are one: arithmetic parts
them. The least distance of others is the step, or less of one that is not rounded."""

FINE = 1.7
"""Times the noise that a step is at most: of a coarser one the noise is lost."""


def own_output(logs: Iterable[Recording], kind: str) -> str:
    """Why the reference of one of the logs tells nothing of a sensor: it is the sensor's own
    output. Nothing where none is.
    """
    for log in logs:
        values, reference = getattr(log, kind), getattr(log, REFERENCE[kind])
        if values is None or reference is None:
            continue
        if is_own_output(values, reference, log, LEAST[kind]):
            return (
                f"the {REFERENCE[kind]} of {log.name} is the {SENSORS[kind]}'s own output: it has "
                "the same noise, sample by sample, and tells nothing of its errors; another "
                "instrument would"
            )
    return ""


def is_own_output(values: np.ndarray, reference: np.ndarray, log: Recording, least: float) -> bool:
    """Whether samples (n, 3) and their reference (n, 3) are one output, on each axis that has both.

    ``least`` is the least noise of a sensor.
    """
    known = np.isfinite(values).any(axis=0) & np.isfinite(reference).any(axis=0)
    values, reference = values[:, known], reference[:, known]
    rows = _quiet_rows(values, reference, log)
    if not len(rows):
        return False
    y, following = _third(values, rows, 0), _third(values, rows, 1)
    noise = y.std(axis=0)
    if not np.all(np.median(np.abs(y), axis=0) > SELDOM * noise):
        return False
    if np.any(np.mean(y * following, axis=0) > WHITE * noise**2):
        return False
    x = np.hstack([_third(reference, rows, k) for k in range(-LAGS, LAGS + 1)])
    left = (y - x @ np.linalg.lstsq(x, y, rcond=None)[0]).std(axis=0)
    none = least * np.sqrt(THIRD / log.sample_period)
    if np.all((left < EXPLAINED * noise) & (left < none)):
        return True
    white = noise / np.sqrt(THIRD)
    return all(map(_is_rounded, values.T, reference.T, white))


def _is_rounded(values: np.ndarray, reference: np.ndarray, noise: float) -> bool:
    """Whether a reference (n,) is the values (n,) rounded to a step below their noise."""
    gaps = np.diff(np.unique(reference[np.isfinite(reference)]))
    step = np.min(gaps, where=gaps > SAME * np.nanmax(np.abs(reference)), initial=np.inf)
    if step > FINE * noise:
        return False
    off = values - reference
    off = off[np.isfinite(off)]
    return float(np.mean(np.abs(off - np.median(off)) < WITHIN * step / 2)) > ROUNDED


def _third(values: np.ndarray, rows: np.ndarray, lag: int) -> np.ndarray:
    """Third differences (m, k) of values (n, k) at rows, some samples later: motion is left out."""
    v = [values[rows + lag + k] for k in range(4)]
    return v[3] - 3 * v[2] + 3 * v[1] - v[0]


def _quiet_rows(values: np.ndarray, reference: np.ndarray, log: Recording) -> np.ndarray:
    """Rows (m,) of the quietest windows in which nothing is missing."""
    seen = np.isfinite(values).all(axis=1) & np.isfinite(reference).all(axis=1)
    around = LENGTH + LAGS + 4
    first = [np.arange(a + LAGS, b - around, LENGTH) for a, b in log.segments]
    starts = np.concatenate([np.empty(0, dtype=int), *first])
    rows = starts[:, None] + np.arange(-LAGS, around)
    starts = starts[seen[rows].all(axis=1)]
    if len(starts) < WINDOWS or not values.shape[1]:
        return np.empty(0, dtype=int)
    inside = np.arange(LENGTH)
    spread = values[starts[:, None] + inside].std(axis=1).sum(axis=1)
    quiet = starts[np.argsort(spread)[: len(starts) // SHARE]]
    return (quiet[:, None] + inside).ravel()
