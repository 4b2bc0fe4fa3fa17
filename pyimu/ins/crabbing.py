"""How far a vehicle crabs: the angle by which it moves askew for seconds, as on a camber or in a
turn.

The constraint of its wheels takes the direction of the motion for that of the body, but for the
mounting, which is constant. Where positions show the one and the forces the other, the path
without the constraint tells their angle: what is left of it beside the mounting and the arm to the
point that does not slip is the crabbing, its size and its time constant those of a Gauss-Markov
process with the angle's covariances at 0 and ``LAG``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.ins.track import Track

SPAN, LAG = 1.0, 3.0
"""s; of the means that are looked at, and between two that are compared."""

KNOWN = 0.03
"""rad; standard deviation of the angle of a mean that is used."""

LEAST = 20
"""Means, of fewer nothing is said."""

TIMES = (SPAN, 60.0)
"""s; between which the time constant is."""


@dataclass(frozen=True)
class Crabbing:
    """The standard deviation ``std`` rad of the crabbing angle and its time constant ``time`` s."""

    std: float
    time: float

    @property
    def settings(self) -> dict[str, float]:
        """Parameters of the filter that follow."""
        return {"crab_std": self.std, "crab_time": self.time}

    @property
    def finding(self) -> Finding:
        return Finding("crabbing", "", 1, {"std": self.std, "time": self.time})


def crabbing(track: Track, rate: np.ndarray) -> Crabbing | None:
    """How a vehicle crabs on the smoothed ``track``, made without its constraint, that turns at the
    ``rate`` (n,) rad/s about its z axis; None where the track does not tell.
    """
    if track.velocity_std is None or track.attitude_std is None:
        return None
    speed = Rotation.from_quat(track.q, scalar_first=True).inv().apply(track.velocity)
    rows = max(1, round(SPAN / float(np.median(np.diff(track.time)))))
    count = len(speed) // rows
    if count < LEAST:
        return None

    def means(values: np.ndarray) -> np.ndarray:
        return values[: count * rows].reshape(count, rows, -1).mean(axis=1)

    moves, turns = means(speed), means(np.nan_to_num(rate)[:, None])[:, 0]
    own = means(track.velocity_std[:, :2]).max(axis=1)
    forward = np.where(np.abs(moves[:, 0]) > 0, moves[:, 0], np.nan)
    variance = (own / forward) ** 2 + means(track.attitude_std[:, 2:])[:, 0] ** 2
    good = variance < KNOWN**2
    if np.count_nonzero(good) < LEAST:
        return None
    angle = np.full(count, np.nan)
    angle[good] = moves[good, 1] / forward[good]
    left = _beside(angle, turns / forward, good, 1 / np.sqrt(variance))
    size = float(np.sum((left**2 - variance)[good] / variance[good]) / np.sum(1 / variance[good]))
    lag = round(LAG / SPAN)
    pairs = good[lag:] & good[:-lag]
    weights = 1 / np.sqrt(variance[lag:] * variance[:-lag])[pairs]
    lasts = float(np.sum(weights * (left[lag:] * left[:-lag])[pairs]) / np.sum(weights))
    if not (size > 0 and lasts > 0):
        return Crabbing(0.0, TIMES[1])
    time = LAG / np.log(size / lasts) if lasts < size else TIMES[1]
    return Crabbing(float(np.sqrt(size)), float(np.clip(time, *TIMES)))


def _beside(
    angle: np.ndarray, arm: np.ndarray, good: np.ndarray, weights: np.ndarray
) -> np.ndarray:
    """The ``angle`` (n,) beside a constant and what goes with ``arm`` (n,), by weighted squares."""
    known = np.column_stack([np.ones(len(angle)), arm])
    scaled = known[good] * weights[good, None]
    found = np.linalg.lstsq(scaled, angle[good] * weights[good], rcond=None)[0]
    return angle - known @ found
