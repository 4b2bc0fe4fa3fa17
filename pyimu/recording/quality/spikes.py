"""Isolated samples that are off."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.ndimage import maximum_filter1d

from pyimu.recording.quality.scatter import WINDOW, medians
from pyimu.recording.recording import filled

SPIKE_SIGMA = 6.0
"""A spike exceeds so many robust standard deviations of its neighbourhood."""


SPIKE_ISOLATION = 3.0
"""A spike exceeds everything near it by this factor."""


SPIKE_TAIL = 3.0
"""A spike's residual exceeds the 99 % quantile of its column by this factor, where the four that a
spike raises beside its own count as none: one sample in 100 may be a spike, not one in 500."""


ROUNDS = 8
"""Each round finds the largest of what is left: from one to the next they halve or better."""


TOGETHER = 3
"""So many spikes may be near each other: of one sample in 200, four are within a window in one of
2000 cases."""


CORRUPT_ISOLATION = 12.0
"""The same where other columns are off at the same time: a corrupt row is alone, a shock rings."""


def spikes(values: np.ndarray, segments: Sequence[tuple[int, int]] = ()) -> np.ndarray:
    """Mask of the isolated samples of ``values`` (n, columns) that are off.

    ``segments`` are the row ranges (start, stop) without gap, where there are gaps: two samples on
    each side of one have no neighbours to be judged by, nor have those beside a missing value.

    The residual of a sample against the cubic through its four neighbours vanishes for motion that
    the sampling resolves. A spike's exceeds ``SPIKE_SIGMA`` robust standard deviations of the
    residuals near it, those that are near but not caused by itself by ``SPIKE_ISOLATION``, and the
    column's 99 % quantile by ``SPIKE_TAIL``. A shock moves several axes and rings: where another
    column is off at the same time, the isolation must be ``CORRUPT_ISOLATION``.
    """
    starts = [start for start, _ in segments[1:]]
    if not starts:
        return _rounds(values)
    apart = np.insert(values, starts, np.nan, axis=0)
    return np.delete(_rounds(apart), np.add(starts, np.arange(len(starts))), axis=0)


def _rounds(values: np.ndarray) -> np.ndarray:
    """Mask of the spikes of ``values`` (n, columns), of which some may be missing.

    Spikes hide each other: where some are found, they are replaced by the line between their
    neighbours, and it is looked for more, ``ROUNDS`` times at most.
    """
    mask = np.zeros(values.shape, bool)
    if len(values) < 4 * WINDOW:
        return mask
    healed, missing = values, np.isnan(values)
    for _ in range(ROUNDS):
        new = _alone(healed) & ~mask
        if not new.any():
            break
        mask |= new
        healed = filled(np.arange(len(values)), np.where(mask, np.nan, values))
        healed[missing] = np.nan
    return mask


def _alone(values: np.ndarray) -> np.ndarray:
    """Mask of the spikes that the others do not hide."""
    mask = np.zeros(values.shape, bool)
    off = _residuals(values)
    sigma = _local_sigma(off)
    loud = off > SPIKE_SIGMA * sigma
    for column in np.flatnonzero(loud.any(axis=0)):
        loud[:, column] &= off[:, column] > SPIKE_TAIL * _tail(off[:, column])
    if not loud.any():
        return mask
    several = np.count_nonzero(widened(off > 4 * sigma), axis=1) > 1
    for k, column in np.argwhere(loud):
        factor = CORRUPT_ISOLATION if several[k] else SPIKE_ISOLATION
        if _isolated(off[:, column], k, factor):
            mask[k, column] = True
        else:
            mask[_together(values[:, column], off[:, column], k, factor), column] = True
    return mask


def _residuals(v: np.ndarray) -> np.ndarray:
    """The residual of each sample against the cubic through its four neighbours.

    |v_k - (4 (v_k-1 + v_k+1) - v_k-2 - v_k+2) / 6|, zero at the ends and where a value is missing.
    """
    off = np.zeros(v.shape)
    off[2:-2] = np.abs(v[2:-2] - (4 * (v[1:-3] + v[3:-1]) - v[:-4] - v[4:]) / 6)
    return np.nan_to_num(off)


def _local_sigma(off: np.ndarray) -> np.ndarray:
    """Robust standard deviation of the residuals near each, at least a quarter of the column's."""
    windows = 1.4826 * medians(sliding_window_view(off, 2 * WINDOW, axis=0)[::WINDOW])
    rows = np.minimum(np.arange(len(off)) // WINDOW, len(windows) - 1)
    return np.maximum(windows, np.median(windows, axis=0) / 4)[rows]


def _tail(off: np.ndarray) -> float:
    """The 99 % quantile of the residuals (n,), where the largest of five stands for all five."""
    return float(np.quantile(np.where(off == maximum_filter1d(off, 5), off, 0.0), 0.99))


def widened(mask: np.ndarray) -> np.ndarray:
    """``mask`` and the samples before and after."""
    wide = mask.copy()
    wide[1:] |= mask[:-1]
    wide[:-1] |= mask[1:]
    return wide


def _isolated(off: np.ndarray, k: int, factor: float) -> bool:
    """Whether residual ``k`` exceeds those near it by ``factor``.

    The four residuals that share samples with it are left out.
    """
    before, after = off[max(k - WINDOW // 2, 0) : max(k - 2, 0)], off[k + 3 : k + 1 + WINDOW // 2]
    others = max(before.max(initial=0.0), after.max(initial=0.0))
    return bool(off[k] == off[max(k - 2, 0) : k + 3].max() and off[k] > factor * others)


def _together(v: np.ndarray, off: np.ndarray, k: int, factor: float) -> np.ndarray:
    """Rows near each other, ``k`` among them, whose samples are off by ``factor`` more than all
    near them is without these; none where more than ``TOGETHER`` would have to go.

    A shock that rings has more.
    """
    first = max(k - WINDOW // 2 - 6, 0)
    near, rows = v[first : k + WINDOW // 2 + 7], [k - first]
    inner = np.abs(np.arange(len(near)) - rows[0]) <= WINDOW // 2
    while off[k] == off[max(k - 2, 0) : k + 3].max() and len(rows) < TOGETHER:
        rest = _residuals(_without(near, rows)[:, None])[:, 0]
        # A spike raises the residuals beside its own: what is largest inside may be of one outside.
        peak = int(np.argmax(np.where(inner, rest, 0.0)))
        begin = max(peak - 2, 0)
        rows.append(begin + int(np.argmax(rest[begin : peak + 3])))
        left = _without(near, rows)
        size, rest = np.abs(near - left)[rows], _residuals(left[:, None])[inner, 0]
        if size.min() > factor * rest.max():
            return np.array(rows) + first
    return np.zeros(0, dtype=int)


def _without(v: np.ndarray, rows: list[int]) -> np.ndarray:
    """Values (m,) with those of some rows on the line between their neighbours."""
    kept = np.ones(len(v), bool)
    kept[rows] = False
    out = v.copy()
    out[rows] = np.interp(rows, np.flatnonzero(kept), v[kept])
    return out
