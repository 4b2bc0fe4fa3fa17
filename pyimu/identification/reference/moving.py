"""The rows of a trial by which a reference is judged: those that move, in the band of the two."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.place import SCALE
from pyimu.identification.fit.sample_noise import without_information
from pyimu.identification.fit.trial import Trial, marked
from pyimu.model.kinds import OWN
from pyimu.recording.reference.band import trusted_band

LEAST_ROWS = 16
"""Moving rows below which a window says nothing."""


def moving_rows(trial: Trial) -> np.ndarray:
    """Rows of the band (m,) on which no clipped or left-out sample has any weight."""
    bad = without_information(trial).astype(float)
    return in_band(trial, bad[:, None])[:, 0] < 1e-6


def in_own_band(trial: Trial) -> Trial:
    """The trial in the band in which its reference, as it stands now, explains the sensor."""
    rate = trial.u[:, OWN[trial.kind]]
    limit = 0.25 / trial.h if trial.band_limit is None else trial.band_limit
    seen = np.where(marked(trial.segments, len(rate))[:, None], rate, np.nan)
    seen = seen[:, list(trial.axes)]
    if trial.place is not None and trial.band_hz is not None:
        # Of its forces the scale's is what two others add up to.
        apart = np.delete(trial.place.forces, SCALE, axis=0)
        seen = np.column_stack([seen, apart.reshape(-1, len(rate)).T])
    band = trusted_band(trial.time, trial.y[:, list(trial.axes)], seen, limit)
    return replace(trial, band_hz=band)


def moving_pair(trial: Trial) -> tuple[np.ndarray, np.ndarray]:
    """What reference and sensor (m, axes) show on the moving rows of the band of the two."""
    trial, axes = in_own_band(trial), list(trial.axes)
    rows = moving_rows(trial)
    x, y = (in_band(trial, v[:, axes])[rows] for v in (trial.u[:, OWN[trial.kind]], trial.y))
    return x, y


def turned_onto(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The rotation (3, 3) with x @ rotation nearest to y, (m, 3) each (Kabsch's algorithm)."""
    left, _, right = np.linalg.svd(x.T @ y)
    return left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
