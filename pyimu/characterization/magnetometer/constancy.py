"""The calibration that makes a field's strength and dip the same in all attitudes.

With w = T (m - b) the field in the accelerometer's axes, u the vertical there, F its strength and D
its dip below the horizon, |w| = F (an ellipsoid for m) and u . w = -F sin D, whatever the yaw is.
The first tells T but for a turn (Vasconcelos, Elkaim, Silvestre, Oliveira and Cardeira 2011), the
second the turn (Kok and Schon 2016). Both residuals are taken with w itself, and not with its
square: these are errors of the field across and along itself, which white noise of variance s^2
moves by s^2 alone, alike in all attitudes, so that it is the strength and not the shape that is
off (the algebraic fit of the ellipsoid is biased in its shape: Markovsky, Kukush and Van Huffel
2004).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

BIAS, SHAPE, DIP, DELAY = slice(0, 3), slice(3, 12), 12, 13
"""Where the unknowns are: b, the rows of T, -sin D, the magnetometer's delay in s."""

UNKNOWNS = 14

DELAY_STD = 0.01
"""s; standard deviation of the delay behind the accelerometer before the log shows it: half a
period at 50 Hz."""

BEFORE = np.array([1.0] * 3 + [0.3] * 9 + [1.0, DELAY_STD])
"""Standard deviations of the unknowns before the log shows them, the first thirteen as shares of
the field: so wide that they tell nothing of what is seen, and keep finite what is not."""

ROUND = 4e-3
"""Share of a field's square by which a sphere is off, as a mean over a hundred attitudes that are
each off by 2 % of the strength, for a bias that is as likely as large as the field."""

FREEDOM = 4.0
"""Degrees of freedom of Student's t, by whose likelihood samples are weighed: one that is 3
standard deviations off counts for a third (Lange, Little and Taylor 1989 find 4 for such data)."""

ROUNDS, SETTLED = 20, 1e-3
"""Rounds of weights at most; change in standard deviations below which they have settled."""

BLOCK = 5.0
"""s; of the blocks of which the covariance is made: twice the time for which a tilt stays off."""

LEAST_BLOCKS, MOST_BLOCKS = 30, 200
"""Blocks at least and at most: of the covariance of 14 unknowns fewer make nothing."""


@dataclass(frozen=True)
class Attitudes:
    """Means over the samples taken in one attitude, a row each, in order of ``time`` (k,) s.

    ``mag`` (k, 3) is of any unit with a median length of 1, ``up`` (k, 3) the vertical in body
    axes, ``passing`` (k, 3) 1/s its change there.
    """

    time: np.ndarray
    mag: np.ndarray
    up: np.ndarray
    passing: np.ndarray

    def __len__(self) -> int:
        return len(self.mag)

    def joined(self, other: Attitudes) -> Attitudes:
        pairs = zip(vars(self).values(), vars(other).values(), strict=True)
        return Attitudes(*(np.concatenate(pair) for pair in pairs))


@dataclass(frozen=True)
class Constancy:
    """The fit: the unknowns ``x`` (14,), their ``covariance``, the robust ``std`` (2,) of the
    residuals along and across the field as shares of it, and the ``blocks`` of the covariance.
    """

    x: np.ndarray
    covariance: np.ndarray
    std: np.ndarray
    blocks: int


def residuals(x: np.ndarray, a: Attitudes) -> tuple[np.ndarray, np.ndarray]:
    """What strength and dip are off (k, 2), and the slope of that (k, 2, 14)."""
    away = a.mag - x[BIAS]
    T = x[SHAPE].reshape(3, 3)
    w = away @ T.T
    size = np.linalg.norm(w, axis=1)
    ahead = w / size[:, None]
    up = a.up - x[DELAY] * a.passing
    dip = np.sum(up * ahead, axis=1)
    off = np.column_stack([size - 1, dip - x[DIP]])
    across = (up - dip[:, None] * ahead) / size[:, None]
    slope = np.zeros((len(a), 2, UNKNOWNS))
    for i, v in enumerate((ahead, across)):
        slope[:, i, BIAS] = -v @ T
        slope[:, i, SHAPE] = (v[:, :, None] * away[:, None, :]).reshape(-1, 9)
    slope[:, 1, DIP] = -1
    slope[:, 1, DELAY] = -np.sum(a.passing * ahead, axis=1)
    return off, slope


def sphere(a: Attitudes) -> np.ndarray:
    """The unknowns (14,) of the sphere through the samples, |m|^2 = 2 b . m + c.

    Where they lie on too little of one to tell it, it is that about zero.
    """
    known = np.column_stack([2 * a.mag, np.ones(len(a))]) / np.sqrt(len(a))
    square = np.sum(a.mag**2, axis=1) / np.sqrt(len(a))
    rows = np.vstack([known, ROUND * np.eye(3, 4)])
    *b, c = np.linalg.lstsq(rows, np.append(square, np.zeros(3)), rcond=None)[0]
    x = np.zeros(UNKNOWNS)
    x[BIAS] = b
    x[SHAPE] = np.eye(3).ravel() / np.sqrt(max(c + np.dot(b, b), 1e-6))
    x[DIP] = np.median(residuals(x, a)[0][:, 1])
    return x


def fit(a: Attitudes) -> Constancy:
    """The most likely unknowns, with errors of Student's t along and across the field.

    The covariance is that of White 1982 by blocks of time, since what is off stays off for a while.
    A log shorter than ``LEAST_BLOCKS`` of them gets shorter ones, and the covariance is too small.

    T and a dip fit as -T and the opposite dip do: the sensor's axes are taken for right-handed.
    """
    start = sphere(a)
    x, weight, std = start, np.ones(len(a)), np.full(2, 0.1)
    for _ in range(ROUNDS):
        before, x = x, _least_squares(x, start, a, weight, std)
        off, slope = residuals(x, a)
        std = np.maximum(_scale(off, weight), 1e-9)
        z = off / std
        weight = (FREEDOM + 2) / (FREEDOM + np.sum(z**2, axis=1))
        change = (x - before) @ _information(slope, z, weight, std) @ (x - before)
        if change < SETTLED**2 * UNKNOWNS:
            break
    if np.linalg.det(x[SHAPE].reshape(3, 3)) < 0:
        x[SHAPE], x[DIP] = -x[SHAPE], -x[DIP]
        off, slope = residuals(x, a)
        z = off / std
    return Constancy(x, *_covariance(a.time, slope, z, weight, std))


def _least_squares(x, start, a: Attitudes, weight, std) -> np.ndarray:
    root = np.sqrt(weight)[:, None] / std

    def off(x):
        return np.append((residuals(x, a)[0] * root).ravel(), (x - start) / BEFORE)

    def slope(x):
        rows = (residuals(x, a)[1] * root[:, :, None]).reshape(-1, UNKNOWNS)
        return np.vstack([rows, np.diag(1 / BEFORE)])

    return least_squares(off, x, jac=slope, method="lm", max_nfev=50).x


def _scale(off: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """The scale (2,) of Student's t by its likelihood."""
    return np.sqrt(np.mean(weight[:, None] * off**2, axis=0))


def _information(slope, z, weight, std) -> np.ndarray:
    """The slope (14, 14) of the score by the unknowns, of which the weights depend on them too."""
    whitened = slope / std[:, None]
    turned = np.einsum("ki,kij->kj", z, whitened)
    found = np.einsum("k,kij,kil->jl", weight, whitened, whitened)
    found -= np.einsum("k,kj,kl->jl", 2 * weight**2 / (FREEDOM + 2), turned, turned)
    return found + np.diag(BEFORE**-2)


def _covariance(time, slope, z, weight, std) -> tuple[np.ndarray, np.ndarray, int]:
    score = np.einsum("k,ki,kij->kj", weight, z, slope / std[:, None])
    blocks = min(max(int(np.ptp(time) / BLOCK), LEAST_BLOCKS), MOST_BLOCKS, len(z))
    sums = np.array([part.sum(axis=0) for part in np.array_split(score, blocks)])
    sums -= sums.mean(axis=0)
    inverse = np.linalg.pinv(_information(slope, z, weight, std), hermitian=True)
    middle = sums.T @ sums * blocks / (blocks - 1)
    # What is known beforehand has its own error.
    middle += np.diag(BEFORE**-2)
    return inverse @ middle @ inverse, std, blocks
