"""The levels at which a number may switch something."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SHARES = np.linspace(0.05, 0.95, 19)
"""Where in ``Levels`` a switch is tried first."""

BINS, TAIL = 1000, 1e-3
"""Parts of the range of a number, and share of its rows beyond either end of that."""

ROUNDING = 1e-9
"""Range over the size of a number that does not change."""


@dataclass(frozen=True)
class Levels:
    """The values (k,) of a number against the ``shares`` (k,) of what there is to tell of it below
    each of them.

    That is neither the share of its rows, as a body that mostly rests has nearly all of them at one
    value, nor that of its range, most of which a fast body hardly ever sees: each part of the range
    counts as the root of its rows, by which the error of a mean over them falls.
    """

    values: np.ndarray
    shares: np.ndarray

    @classmethod
    def of(cls, values: np.ndarray) -> Levels:
        """The levels of the ``values`` (n,) that a number takes."""
        ends = np.quantile(values, [TAIL, 1.0 - TAIL])
        if ends[1] - ends[0] <= ROUNDING * np.abs(ends).max():
            return cls(ends, np.array([0.0, 1.0]))
        counts, edges = np.histogram(values, BINS, (ends[0], ends[1]))
        below = np.concatenate([[0.0], np.cumsum(np.sqrt(counts))])
        return cls(edges, below / below[-1])

    def at(self, shares: np.ndarray) -> np.ndarray:
        return np.interp(shares, self.shares, self.values)

    def share(self, level: float) -> float:
        return float(np.interp(level, self.values, self.shares))
