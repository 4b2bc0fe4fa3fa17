"""A direction of the world as a body that turns sees it."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(cache=True)
def followed(time, gyro, first, toward, pull):
    """The direction (n, 3) that is ``first`` (3,) at first and stands still while the body turns by
    ``gyro`` (n, 3) rad/s, drawn to ``toward`` (n, 3) at the rates ``pull`` (n,) 1/s.
    """
    out = np.empty_like(gyro)
    u = first.copy()
    for k in range(len(time)):
        out[k] = u
        if k + 1 == len(time):
            break
        h = time[k + 1] - time[k]
        back = 1.0 - np.exp(-pull[k] * h)
        u = u - np.cross(gyro[k] * h, u) + back * (toward[k] - u)
        u = u / np.sqrt(np.sum(u * u))
    return out
