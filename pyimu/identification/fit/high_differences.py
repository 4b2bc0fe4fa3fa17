"""White noise by the high differences of a signal, which motion hardly has a part in."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache

import numpy as np

from pyimu.identification.fit.noise_floor import QUIET, WINDOW, quiet, windows
from pyimu.identification.fit.sample_noise import CORRELATED, THIRD
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN

WEIGHT = 4 * CORRELATED
"""Rows that say as much of the power of third differences as one by itself would: a quarter of them
is used."""

DRAWN = 1 << 14
"""Windows of white noise that are drawn to know what the quietest of them show, to half a percent.
"""


def white_of_reference(trial: Trial) -> np.ndarray:
    """Variance (3,) of white noise that a reference shows itself, by its high differences."""
    white = white_of(_third_differences(trial, trial.u[:, OWN[trial.kind]]))
    return np.where(np.isin(np.arange(3), trial.axes), white, 0.0)


def white_of(rough: Sequence[np.ndarray]) -> np.ndarray:
    """Variance (3,) of white noise of which third differences by axis, in windows, are."""
    return np.array([quiet(w) / _of_white() if len(w) else 0.0 for w in rough])


@cache
def _of_white() -> float:
    """What the quietest windows of third differences of white noise of variance one show."""
    drawn = np.random.default_rng(1).standard_normal((DRAWN * WINDOW, 1))
    return quiet(windows(np.diff(drawn[:, 0], n=3), [(0, len(drawn) - 3)]))


def roughness(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Root mean square (3,) of third differences of values (n, 3), in their quietest quarter."""
    rough = _third_differences(trial, values)
    return np.nan_to_num([np.sqrt(quiet(w)) if len(w) else 0.0 for w in rough])


def sensor_white(trial: Trial, left: np.ndarray) -> np.ndarray:
    """Variance (3,) of white noise that the sensor shows where a model leaves ``left`` (n, 3).

    High differences of sensor and residual have the sensor's noise in common, and neither the
    motion nor the reference's noise. The windows are those in which the reference is quiet: taken
    by the sensor's own quiet they would be quieter than it is.
    """
    by_reference, seen, rest = (
        _third_differences(trial, v) for v in (trial.u[:, OWN[trial.kind]], trial.y, left)
    )
    each = [
        _common(*pieces) / THIRD if len(pieces[0]) else 0.0
        for pieces in zip(by_reference, seen, rest, strict=True)
    ]
    return np.where(np.isin(np.arange(3), trial.axes), np.maximum(each, 0.0), 0.0)


def _common(by: np.ndarray, one: np.ndarray, other: np.ndarray) -> float:
    """Mean product of two signals' windows (k, m) where a third is quiet."""
    calm = np.argsort(by.var(axis=1))[: max(1, int(len(by) * QUIET))]
    return float(np.mean(one[calm] * other[calm]))


def _third_differences(trial: Trial, values: np.ndarray) -> list[np.ndarray]:
    """Windows of the third differences of values (n, 3), by axis."""
    return differences(values, trial.segments)


def differences(values: np.ndarray, segments: Iterable[tuple[int, int]]) -> list[np.ndarray]:
    """Windows of the third differences of values (n, 3) in ``segments``, by axis."""
    pieces = [np.diff(values[a:b], n=3, axis=0) for a, b in segments]
    none = [np.zeros((0, WINDOW))]
    return [
        np.concatenate(none + [windows(p[:, i], [(0, len(p))]) for p in pieces]) for i in range(3)
    ]
