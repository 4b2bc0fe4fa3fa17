"""Symmetric positive definite systems of a few unknowns.

In loops: Numba takes seconds to compile its calls of LAPACK, and what puts one array into another,
which whoever runs a command for the first time waits for.
"""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(cache=True)
def cholesky(matrix: np.ndarray) -> np.ndarray:
    """The lower triangular root (p, p) of a matrix (p, p).

    A row that the rows above it already say has an infinite diagonal: its unknown is zero.
    """
    p = len(matrix)
    root = np.zeros((p, p))
    for a in range(p):
        for b in range(a + 1):
            left = matrix[a, b]
            for c in range(b):
                left -= root[a, c] * root[b, c]
            if b < a:
                root[a, b] = left / root[b, b]
            else:
                root[a, a] = np.sqrt(left) if left > 0.0 else np.inf
    return root


@njit(cache=True)
def solve(root: np.ndarray, right: np.ndarray) -> None:
    """Put the solution of a system, its ``root`` (p, p), in the place of its right side (p,)."""
    p = len(right)
    for a in range(p):
        for c in range(a):
            right[a] -= root[a, c] * right[c]
        right[a] /= root[a, a]
    for a in range(p - 1, -1, -1):
        for c in range(a + 1, p):
            right[a] -= root[c, a] * right[c]
        right[a] /= root[a, a]
