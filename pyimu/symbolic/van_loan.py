"""Van Loan's method: the covariance of a linear system driven by white noise, as numbers."""

from __future__ import annotations

import numpy as np
from scipy.linalg import expm


def van_loan(f: np.ndarray, density: np.ndarray, h: float) -> np.ndarray:
    """Covariance (m, m) after ``h`` s of x' = f x + w, which starts at zero.

    ``f`` is (m, m), ``density`` (m, m) the two-sided density of the white noise w (Van Loan 1978,
    theorem 1).
    """
    m = len(f)
    e = expm(np.block([[-f, density], [np.zeros_like(f), f.T]]) * h)
    return e[m:, m:].T @ e[:m, m:]
