"""The residual of an axis as cells of frequency.

The differences of a residual of white noise and random walk are correlated from one to the next
alone. The sine transform makes such values independent, exactly (the eigenvectors of a tridiagonal
Toeplitz matrix): of variance 4 sin^2(w / 2) S(w), w = pi j / n, with S the density per sample. Of
other noises it does so up to terms of their correlation time over the log (Whittle 1953). The bias
of the log is gone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.fft import dst

from pyimu.identification.noise.rows import Rows

SINGLE = 16
"""The lowest frequencies, each a cell of its own."""

WIDER = 1.12
"""Ratio of the ends of the cells above them."""


@dataclass(frozen=True)
class Bands:
    """Cells of frequency: ``count`` (c,), ``squares`` (c,) and ``turn`` (c,), 4 sin^2(w / 2)."""

    count: np.ndarray
    squares: np.ndarray
    turn: np.ndarray
    h: float

    def density(self, white: float, walk: float, markov: Sequence, rounding: float) -> np.ndarray:
        """Variance (c,) that a noise has in the cells: white and walk as densities, pairs of
        variance and time of Gauss-Markov processes, and the error of a rounded integral.
        """
        turn, h = self.turn, self.h
        out = turn * (white / h) + walk * h + turn**2 * (rounding / h) ** 2
        for variance, tau in markov:
            kept, lost = np.exp(-h / tau), -np.expm1(-h / tau)
            # 1 - 2 a cos w + a^2 = (1 - a)^2 + a 4 sin^2(w / 2)
            out = out + turn * variance * lost * (1 + kept) / (lost**2 + kept * turn)
        return out


def bands(logs: Sequence[Rows]) -> Bands | None:
    """The cells of all stretches of all logs of an axis; None where none is long enough."""
    made = [_of(v) for one in logs for v in one.seen().stretches()]
    if not made:
        return None
    count, squares, turn = (np.concatenate(v) for v in zip(*made, strict=True))
    return Bands(count, squares, turn, logs[0].h)


def _of(values: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    powers = dst(np.diff(values), type=1, norm="ortho") ** 2
    n = len(powers)
    edges = [*range(SINGLE), SINGLE]
    while edges[-1] < n:
        edges.append(min(n, max(edges[-1] + 1, round(edges[-1] * WIDER))))
    first = np.array(edges[:-1])
    count = np.diff(edges).astype(float)
    turn = 4 * np.sin(np.pi * np.arange(1, n + 1) / (2 * (n + 1))) ** 2
    return count, np.add.reduceat(powers, first), np.add.reduceat(turn, first) / count
