"""The standard error of what may be distributed in one of several ways."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from pyimu.numerics.laws import norm

LEVEL = 0.95
"""Probability of the intervals."""

REACH = float(norm.isf((1.0 - LEVEL) / 2))
"""Standard errors from a value to either end of its interval."""


def standard_error(weights: np.ndarray, at: np.ndarray, std: np.ndarray) -> float:
    """The standard error whose interval about zero has its probability in a mixture of normal
    distributions with ``weights`` (k,) that add up to 1, means ``at`` (k,) and deviations ``std``
    (k,).
    """

    def outside(reach: float) -> float:
        both = norm.sf((reach - at) / std) + norm.sf((reach + at) / std)
        return float(weights @ both) - (1.0 - LEVEL)

    most = float(np.max(np.abs(at) + 10.0 * std))
    return float(brentq(outside, 0.0, most)) / REACH
