"""How many rad/s one of a gyro's numbers is, by how gravity turns in the body."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

LIKE = 2.0
"""A slope of the gravity's turning on the rate is that of a unit to this factor."""

SURE = 0.4
"""Least correlation of the gravity's turning with what the rate makes of it. Chosen on BROAD 02, 07
and an MPU-9150 turned by hand; of a car, a pendulum and a board waved by hand it then gave the
right unit, and none of a wand that is swung, of fast shifts by hand and of a log at rest."""

BLOCKS = (0.04, 0.1, 0.2, 0.5, 1.0)
"""s; over so long means the turning of gravity is compared with the rate: fast turns need short
ones, slow turns long ones, and of all that counts in which the two agree best."""

PIECE = 1 << 15
"""Rows that are turned at once: their matrices take nine times the room of a column."""

TRIES = 8
"""Steps of Newton's method to the scale of a gyro, at most."""


def turning_of_gravity(rate: np.ndarray, force: np.ndarray, period: float) -> float | None:
    """How many rad/s one of the rates (n, 3) is by what the forces (n, 3) turn; None where they
    turn with something else, or not at all.
    """
    lengths = [max(round(block / period), 2) for block in BLOCKS]
    found = [(*_turning(rate, force, length, period), length) for length in lengths]
    slope, correlation, length = max(found, key=lambda each: each[1])
    return _whole_turns(rate, force, length, period, slope) if correlation > SURE else None


def _turning(
    rate: np.ndarray, force: np.ndarray, length: int, period: float
) -> tuple[float, float]:
    """Slope and correlation of the change of the force on that which the rate makes.

    Both are means of blocks of ``length`` samples.
    """
    count = min(len(rate), len(force)) // length
    if count < 8:
        return 0.0, 0.0
    w, f = (v[: count * length].reshape(count, length, 3).mean(axis=1) for v in (rate, force))
    between, turn = 0.5 * (f[1:] + f[:-1]), 0.5 * (w[1:] + w[:-1]) * length * period
    made, seen = -np.cross(turn, between), np.diff(f, axis=0)
    size = np.linalg.norm(between, axis=1)
    middle = np.nanmedian(size) if np.isfinite(size).any() else 0.0
    kept = np.all(np.isfinite(made) & np.isfinite(seen), axis=1) & (
        np.abs(size - middle) < 0.2 * middle
    )
    made, seen = made[kept].ravel(), seen[kept].ravel()
    power = float(made @ made) * float(seen @ seen)
    if len(made) < 24 or power <= 0:
        return 0.0, 0.0
    return float(made @ seen) / float(made @ made), float(made @ seen) / np.sqrt(power)


def _whole_turns(
    rate: np.ndarray, force: np.ndarray, length: int, period: float, slope: float
) -> float:
    """The ``slope`` of ``_turning`` for turns of any size: -w x f is the change of small ones, and
    of those of 1 rad between two means it makes it a quarter too large.

    The scale k of the rates is sought at which two neighbouring means agree, each over ``length``
    samples that were turned, by k w, to where the two blocks meet. Where it is none near the slope,
    as of a log that rests but for a moment, the slope counts.
    """
    step, start = 1e-3, slope
    for _ in range(TRIES):
        apart = _apart(rate, force, length, period, slope)
        more = _apart(rate, force, length, period, slope * (1 + step))
        size = np.linalg.norm(apart, axis=1)
        kept = np.isfinite(size) & (size < 3 * np.nanmedian(size))
        change = ((more - apart) / (slope * step))[kept].ravel()
        power = float(change @ change)
        if not power > 0:
            break
        before, slope = slope, slope - float(change @ apart[kept].ravel()) / power
        if abs(slope - before) < step * abs(before) or not slope > 0:
            break
    return slope if 1 / LIKE < slope / start < LIKE else start


def _apart(
    rate: np.ndarray, force: np.ndarray, length: int, period: float, scale: float
) -> np.ndarray:
    """By how much the mean force (m, 3) of a block and that of the block before it differ, in the
    axes that the body has between the two.
    """
    count, few = min(len(rate), len(force)) // length, max(PIECE // length, 1)
    pieces = [slice(k * length, min(k + few, count) * length) for k in range(0, count, few)]
    means = [_means(rate[at], force[at], length, period, scale) for at in pieces]
    at_start, at_end = (np.concatenate(each) for each in zip(*means, strict=True))
    return at_start[1:] - at_end[:-1]


def _means(
    rate: np.ndarray, force: np.ndarray, length: int, period: float, scale: float
) -> tuple[np.ndarray, np.ndarray]:
    """The mean force (m, 3) of each block, in the axes of its start, and in those of its end."""
    count = len(rate) // length
    w, f = (v.reshape(count, length, 3) for v in (rate, force))
    turn = Rotation.from_rotvec(0.5 * scale * period * np.nan_to_num(w).reshape(-1, 3))
    halves = turn.as_matrix().reshape(count, length, 3, 3)
    whole, at_start = np.broadcast_to(np.eye(3), (count, 3, 3)), np.zeros((count, 3))
    for k in range(length):
        middle = whole @ halves[:, k]
        at_start = at_start + np.einsum("nij,nj->ni", middle, f[:, k]) / length
        whole = middle @ halves[:, k]
    return at_start, np.einsum("nji,nj->ni", whole, at_start)
