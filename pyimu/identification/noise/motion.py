"""Squared innovations in classes of what the axis measures and of its rate."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.noise.cells import Cells
from pyimu.identification.noise.laws import Kind
from pyimu.identification.noise.rows import Rows

CLASSES = 12
"""Classes of equal count by the input, and again by its rate within each."""


def motion_cells(
    logs: Sequence[Rows], noise: RandomWalk, kinds: Sequence[Kind]
) -> tuple[Cells, np.ndarray] | None:
    """Cells of the innovations of an axis whose variance is that of ``noise`` times one number that
    is free, beside what the rounding of a reference adds, and the column (k, c) that each kind
    would add; None where nothing moves.
    """
    made = [_whitened(one.seen(), noise) for one in logs if one.fitted > 1]
    squares, inverse = (np.concatenate(v) for v in zip(*made, strict=True))
    seen = [one.seen() for one in logs if one.fitted > 1]
    each = [np.concatenate([k.in_rows(one) for one in seen]) * inverse for k in kinds]
    x = np.concatenate([np.abs(one.x) for one in seen])
    slope = np.concatenate([np.abs(one.slope) for one in seen])
    if not (len(x) and np.ptp(x) > 1e-9 * max(x.max(), 1e-300)):
        return None
    at = _classes(x, slope)
    count = np.bincount(at).astype(float)
    columns = np.array([np.bincount(at, v) / count for v in each])
    ones = np.ones_like(count)
    rounded = np.bincount(at, np.concatenate([_rounded(one) for one in seen]) * inverse) / count
    base = ones + rounded
    free = Cells(count, np.bincount(at, squares), base, ones[None], np.array([-0.999]))
    return free, columns


def _rounded(one: Rows) -> np.ndarray:
    return np.zeros(len(one.r)) if one.rounded is None else one.rounded


def _whitened(one: Rows, noise: RandomWalk) -> tuple[np.ndarray, np.ndarray]:
    """Squares (n,) of the innovations of unit variance, and one over their variance before."""
    both = np.column_stack([one.r - one.r[0], np.ones(len(one.r))])
    white = noise.whiten(both, one.time, [(0, len(one.r))])
    bias = white[:, 0] @ white[:, 1] / (white[:, 1] @ white[:, 1])
    # The whitening scales by the innovation's deviation: how much, a unit impulse would show; the
    # walk's share of it is small and constant once the filter has settled.
    settled = _innovation_variance(noise, one.h)
    return (white[:, 0] - bias * white[:, 1]) ** 2, np.full(len(one.r), 1.0 / settled)


def _innovation_variance(noise: RandomWalk, h: float) -> float:
    """Of the settled filter: the root of f^2 - (2 r + q) f + r^2 = 0 that is larger than r."""
    half = noise.r + 0.5 * noise.k2 * h
    return half + np.sqrt(max(half**2 - noise.r**2, 0.0))


def _classes(x: np.ndarray, slope: np.ndarray) -> np.ndarray:
    """Number (n,) of the class of each row."""
    outer = (np.argsort(np.argsort(x)) * CLASSES) // len(x)
    order = np.lexsort((slope, outer))
    place = np.empty(len(x), dtype=int)
    place[order] = np.arange(len(x))
    return (place * CLASSES * CLASSES) // len(x)
