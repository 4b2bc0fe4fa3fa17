"""What the rounding of a reference's numbers may look like.

A reference that stands on a digit is off by the same there each time, and what it is off by looks
like anything that depends on what it measures, or changes between two of its stands.
"""

from __future__ import annotations

import numpy as np

CHANCE = 5.0
"""Standard errors by which errors of rounding, each even over a step and independent of those of
other digits, add up to an effect at most."""

LITTLE = 0.01
"""Share of what is different on an axis that may be different on others beside it."""


def may_be_rounding(apart: np.ndarray, x: np.ndarray, digits: tuple[float, ...]) -> bool:
    """Whether on no axis more is ``apart`` (n, 3) than the rounding of a reference ``x`` (n, 3) to
    ``digits`` (3,) may make, by the root mean square of the rows in which it is not zero.
    """
    if not any(digits):
        return False
    both = [_beside(*each) for each in zip(apart.T, x.T, digits, strict=True)]
    most = max(rms for rms, _ in both)
    return all(rms <= may for rms, may in both if rms > LITTLE * most)


def _beside(apart: np.ndarray, x: np.ndarray, step: float) -> tuple[float, float]:
    """The root mean square that is ``apart`` (n,) where ``x`` (n,) is not zero, and what rounding
    to a ``step`` may make of it: of each digit one error, half a step at most.
    """
    if not step:
        return float(apart.std()), 0.0
    digits = np.rint(x / step)
    moves = digits != 0.0
    if not moves.any():
        return 0.0, 0.0
    rows = np.unique(digits[moves], return_counts=True)[1].astype(float)
    independent = rows.sum() ** 2 / np.sum(rows**2)
    may = min(0.5 * step, CHANCE * step / np.sqrt(12.0 * independent))
    return float(apart[moves].std()), may
