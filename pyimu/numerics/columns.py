"""Columns of values: at other instants, and beside others."""

from __future__ import annotations

import numpy as np


def columns_at(
    instants: np.ndarray, time: np.ndarray, values: np.ndarray, beyond: float | None = None
) -> np.ndarray:
    """Values (n, k) at ``time`` (n,), which rises, brought to ``instants`` (m,) on lines: (m, k).

    Outside of ``time`` they are ``beyond``, or without that the first and the last.
    """
    return np.column_stack([np.interp(instants, time, v, beyond, beyond) for v in values.T])


def unexplained(basis: np.ndarray, values: np.ndarray) -> np.ndarray:
    """What of values (m,) or (m, k) an orthonormal ``basis`` (m, j) does not explain."""
    return values - basis @ (basis.T @ values)
