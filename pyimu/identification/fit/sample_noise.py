"""What a trial's samples say by themselves: their white noise, and which of them say nothing."""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.trial import Trial
from pyimu.recording.quality.clipping import clipped


def rest_noise(trial: Trial) -> np.ndarray:
    """Standard deviation (3,) of the white noise of the samples, in the quietest seconds."""
    return (
        trial.reduction.sample_std if trial.reduction is not None else white_noise(trial, trial.y)
    )


def white_noise(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Standard deviation (k,) of the white noise of a trial's values (n, k)."""
    return quiet_noise(values, trial.row_segments, trial.h)


def quiet_noise(values: np.ndarray, segments: list[tuple[int, int]], h: float) -> np.ndarray:
    """Standard deviation (k,) of the white noise of values (n, k), sampled every ``h`` s.

    From the quietest quarter of second-long segments.

    Third differences take out motion up to a tenth of the sample rate; those of white noise have 20
    times its variance.
    """
    length = max(8, round(1.0 / h))
    pieces = [values[k : k + length] for a, b in segments for k in range(a, b - length + 1, length)]
    if not pieces:
        return np.full(values.shape[1], np.nan)
    spreads = np.sqrt(np.mean(np.diff(np.array(pieces), n=3, axis=1) ** 2, axis=1) / 20)
    quiet = np.argsort(spreads.sum(axis=1))[: max(1, len(pieces) // 4)]
    return np.sqrt(np.mean(spreads[quiet] ** 2, axis=0))


def without_information(trial: Trial) -> np.ndarray:
    """Mask (n,) of the samples that are left out, or at a limit."""
    bad = np.any([clipped(trial.y[:, i]) for i in trial.axes], axis=0)
    return bad if trial.left_out is None else bad | trial.left_out
