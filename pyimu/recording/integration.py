"""Attitude by integration of rates alone."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial.transform import Rotation


def integrated(rate: np.ndarray, sample_period: float, start: Rotation) -> Rotation:
    """Attitudes (n,) of a body that is at ``start`` at the first sample and turns at ``rate``.

    ``rate`` (n, 3) rad/s is that of the period that ends with its sample. The product of many turns
    is taken in stretches side by side and then from stretch to stretch.
    """
    n = len(rate)
    length = math.isqrt(n - 1) + 1
    turns = np.zeros((length * length, 3))
    turns[1:n] = rate[1:] * sample_period
    columns = turns.reshape(length, length, 3)
    within = [Rotation.from_rotvec(columns[:, 0])]
    for k in range(1, length):
        within.append(within[-1] * Rotation.from_rotvec(columns[:, k]))
    done, before = start, []
    for k in range(length):
        before.append(done)
        done = done * within[-1][k]
    whole = Rotation.concatenate(before)
    q = np.stack([(whole * w).as_quat() for w in within], axis=1)
    return Rotation.from_quat(q.reshape(-1, 4)[:n])
