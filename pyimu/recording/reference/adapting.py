"""A low-pass filter that adapts, as those over hands, headsets and markers do: its cut-off rises
with the rate at which what it shows turns (Casiez, Roussel and Vogel 2012, "1 EUR filter", CHI,
equations 1 to 4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from pyimu.recording.reference.filters import low_passed, seen_through

SPEED = 1.0
"""Hz; cut-off of the low-pass filter behind which the filter knows the rate (section "Tuning" of
the same)."""

SETTLED = 8.0
"""Time constants after which what was before the first row is forgotten, to 0.03 %."""


@dataclass(frozen=True)
class Adapting:
    """A low-pass filter of first order whose time constant is ``size`` s where nothing turns, and
    half as long at ``halves`` rad/s.
    """

    size: float
    halves: float

    def constants(self, rate: np.ndarray, h: float) -> np.ndarray:
        """Time constants (n,) s where it shows a ``rate`` (n, 3) rad/s, ``h`` s apart."""
        slow = low_passed(rate, 1.0 / (2.0 * np.pi * SPEED * h))
        return self.size / (1.0 + np.linalg.norm(slow, axis=1) / self.halves)

    def seen(self, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
        """What is seen of a ``rate`` (n, 3) rad/s behind the filter, or of attitudes (n, 4) behind
        it, by which the body has ``turned``.
        """
        rows = self.constants(rate, h) / h
        return seen_through(lambda values: _behind(values, rows), rate, h, turned)

    def reach(self, h: float) -> int:
        """Rows at either end that are not as they would be between others."""
        return int(np.ceil(SETTLED * self.size / h))


@njit(cache=True)
def _behind(values, rows):
    """Values (n, k) behind a low-pass filter with time constants of so many ``rows`` (n,); what
    came before the first was like it.
    """
    out = np.empty_like(values)
    out[0] = values[0]
    for i in range(1, len(values)):
        # Of a line from row to row, as that of a filter which does not adapt.
        kept = np.exp(-1.0 / rows[i])
        mean = rows[i] * (1.0 - kept)
        for k in range(values.shape[1]):
            driven = (1.0 - mean) * values[i, k] + (mean - kept) * values[i - 1, k]
            out[i, k] = kept * out[i - 1, k] + driven
    return out
