"""Temperature and supply without their own sensors' noise and steps.

A coefficient times the noise of a thermometer is a noise of the model that the sensor never had; it
meets the same noise in the thermal columns, and chance grows to an effect.
"""

from __future__ import annotations

import numpy as np

from pyimu.characterization.temperature.averages import Averages
from pyimu.characterization.temperature.thermometer import smoothed
from pyimu.recording.recording import Recording

INTERVAL = 1.0
"""s; means over so long are smoothed: surroundings change in seconds, not in samples."""

LEAST = 8
"""Intervals below which there is nothing to tell noise from change by."""


def without_noise(recording: Recording, values: np.ndarray) -> np.ndarray:
    """The slow signal behind ``values`` (n,), which have no gap, at the recording's rows.

    It is the expected value given all readings, of the interval means by their likeliest smoothing;
    between the middles of intervals it is a line.
    """
    out = np.array(values)
    for a, b in recording.segments:
        out[a:b] = _smoothed(recording.time[a:b], values[a:b], recording.sample_period)
    return out


def _smoothed(time: np.ndarray, values: np.ndarray, period: float) -> np.ndarray:
    if not len(values) or np.ptp(values) == 0.0:
        return values
    interval = ((time - time[0] + 0.5 * period) / max(INTERVAL, period)).astype(int)
    present, number = np.unique(interval, return_inverse=True)
    if len(present) < LEAST:
        return values
    count = np.bincount(number).astype(float)
    middle, mean = (np.bincount(number, weights=v) / count for v in (time, values))
    level = smoothed(Averages(middle, mean, np.zeros((len(mean), 0)), count, period))
    return _between(middle, level, time)


def _between(middle: np.ndarray, level: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Lines between the levels, which go on at both ends."""
    left = np.clip(np.searchsorted(middle, time) - 1, 0, len(middle) - 2)
    slope = np.diff(level) / np.diff(middle)
    return level[left] + slope[left] * (time - middle[left])
