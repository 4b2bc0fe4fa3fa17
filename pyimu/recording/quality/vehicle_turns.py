"""The speed at which a vehicle turns: the force towards the middle of a turn is speed by rate."""

from __future__ import annotations

import numpy as np

WINDOW = 1.0
"""s; over which forces and rates are averaged: turns last longer, an engine's shaking does not."""

LEAST = 60
"""Windows; in fewer there are few turns."""

GOES_WITH = 0.8
"""Least correlation of the force with the rate. Where a vehicle goes at half its speed to twice
that, evenly in logarithms, it is 0.9."""

PUSHES = 0.3
"""m/s^2; least scatter of the force along that direction: below it both may drift together."""


def speed_in_turns(rate: np.ndarray, force: np.ndarray, period: float) -> float | None:
    """m/s; the speed by which forces m/s^2 (n, 3) across the vertical go with the rates rad/s
    (n, 3) about it, None where they do not.

    The vertical is the mean force: the vehicle stays about level.
    """
    rows = max(round(WINDOW / period), 1)
    count = len(rate) // rows
    if count < LEAST:
        return None
    w, f = (v[: count * rows].reshape(count, rows, 3).mean(axis=1) for v in (rate, force))
    known = np.isfinite(w).all(axis=1) & np.isfinite(f).all(axis=1)
    if np.count_nonzero(known) < LEAST:
        return None
    w, f = w[known], f[known]
    mean = f.mean(axis=0)
    up = mean / max(float(np.linalg.norm(mean)), 1e-9)
    about = w @ up - np.median(w @ up)
    across = f - mean - np.outer((f - mean) @ up, up)
    both, power = about @ across / len(about), float(about @ about) / len(about)
    size = float(np.linalg.norm(both))
    if not size > 0 or not power > 0:
        return None
    along = across @ both / size
    scatter = float(np.std(along))
    if scatter < PUSHES or size < GOES_WITH * scatter * np.sqrt(power):
        return None
    return size / power
