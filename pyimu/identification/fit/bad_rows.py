"""Samples and rows that count for nothing: missing, at a limit, repeated, filled in."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyimu.recording.quality.clipping import clipped
from pyimu.recording.quality.spikes import spikes
from pyimu.recording.reference.filled import filled_in, resolution


def bad_samples(values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
    """Flags (n, k) of samples that are missing, spikes, filled in, or repeat the row before.

    ``segments`` are the row ranges (start, stop) without gap.
    """
    no_samples = repeated(values) | filled_rows(values, segments)
    return missing_or_spikes(values, segments) | no_samples[:, None]


def missing_or_spikes(values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
    missing = ~np.isfinite(values)
    return missing | spikes(np.where(missing, np.nan, values), segments)


def filled_rows(values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
    """Rows (n,) that a program filled in where samples were lost."""
    known, out = np.isfinite(values).all(axis=1), np.zeros(len(values), dtype=bool)
    last_digit = resolution(values[known])
    for a, b in segments:
        rows = a + np.flatnonzero(known[a:b])
        out[rows] = filled_in(values[rows], last_digit)
    return out


def repeated(values: np.ndarray) -> np.ndarray:
    """Rows (n,) that repeat the row before on every axis, where the values are fine enough for that
    not to happen by itself, and not as all axes lie at their limits.
    """
    same = np.concatenate([[False], (np.diff(values, axis=0) == 0).all(axis=1)])
    if same.any():
        same &= ~np.all([clipped(column) for column in values.T], axis=0)
    by_axis = [np.mean(np.diff(column) == 0) for column in values.T]
    return (
        same
        if 0 < same.mean() < 0.2 and same.mean() > 10 * np.prod(by_axis)
        else np.zeros(len(values), dtype=bool)
    )
